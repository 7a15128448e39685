//! Monado with a simulated headset: a service of its own for every test, in a folder of its own.
use super::program;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Where the headset's pictures go.
#[derive(Clone, Debug)]
pub enum Compositor {
    /// Nowhere, at 20 frames a second.
    Null,
    /// Both eyes in a window of this X display, at 60 frames a second or what `Settings::hertz` says.
    Window { display: String },
}

/// What tells where head and hands are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Devices {
    /// A head that moves by itself and two controllers (`khr/simple_controller`) that lie still.
    Simulated,
    /// The same head, nothing in the hands.
    HeadOnly,
    /// What `Remote` sends; the controllers are `oculus/touch_controller`.
    Remote,
}

#[derive(Clone, Debug)]
pub struct Settings {
    pub compositor: Compositor,
    pub devices: Devices,
    /// Frames a second of a window.
    pub hertz: Option<u32>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { compositor: Compositor::Null, devices: Devices::Simulated, hertz: None }
    }
}

/// A running service; dropping it kills it.
pub struct Service {
    folder: TempDir,
    settings: Settings,
    port: u16,
    child: Option<Child>,
}

/// Long, for a busy machine: nobody waits for it unless something is wrong.
const PATIENCE: Duration = Duration::from_secs(60);

impl Service {
    pub fn start(settings: Settings) -> Self {
        // Sockets have short paths (108 bytes), so this is not in the target folder.
        let folder = TempDir::with_prefix("swell-xr-").unwrap();
        // Nobody else may open the socket; libraries ask for it.
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o700)).unwrap();
        // Free now. Every test that asks gets another one, since the kernel goes through them in turn.
        let port = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let config = folder.path().join("config/monado");
        fs::create_dir_all(&config).unwrap();
        if settings.devices == Devices::Remote {
            let remote = serde_json::json!({"version": 0, "port": port, "view_count": 2});
            let all = serde_json::json!({"active": "remote", "remote": remote});
            fs::write(config.join("config_v0.json"), all.to_string()).unwrap();
        }
        let mut service = Self { folder, settings, port, child: None };
        service.restart();
        service
    }

    /// Starts it again after `kill` or `stop`; returns when clients can connect.
    pub fn restart(&mut self) {
        assert!(self.child.is_none(), "the service runs");
        let program = std::env::var_os("SWELL_MONADO")
            .expect("SWELL_MONADO is not set: run tests with ./x test, which brings Monado");
        // A killed service leaves its socket, which would look like a service.
        for left in ["monado_comp_ipc", "monado.pid"] {
            let _ = fs::remove_file(self.folder.path().join(left));
        }
        let mut command = self.command(program);
        // Without the first it reads standard input, and ends where that does.
        command.env("XRT_NO_STDIN", "1").env_remove("XR_ENABLE_API_LAYERS");
        match &self.settings.compositor {
            Compositor::Null => command.env("XRT_COMPOSITOR_NULL", "1").env_remove("DISPLAY"),
            Compositor::Window { display } => {
                command.env("XRT_COMPOSITOR_FORCE_XCB", "1").env("DISPLAY", display)
            }
        };
        command.env_remove("WAYLAND_DISPLAY");
        if let Some(hertz) = self.settings.hertz {
            command.env("XRT_COMPOSITOR_DEFAULT_FRAMERATE", hertz.to_string());
        }
        match self.settings.devices {
            Devices::Simulated => command
                .env("SIMULATED_ENABLE", "1")
                .env("SIMULATED_LEFT", "simple")
                .env("SIMULATED_RIGHT", "simple"),
            Devices::HeadOnly => command.env("SIMULATED_ENABLE", "1"),
            Devices::Remote => command.env("SIMULATED_ENABLE", "0").env("P_OVERRIDE_ACTIVE_CONFIG", "remote"),
        };
        let log = File::options().create(true).append(true).open(self.log_file()).unwrap();
        command.stdout(log.try_clone().unwrap()).stderr(log);
        self.child = Some(command.spawn().unwrap());
        let socket = self.folder.path().join("monado_comp_ipc");
        let started = Instant::now();
        while !socket.exists() {
            let ended = self.child.as_mut().unwrap().try_wait().unwrap();
            assert!(ended.is_none(), "Monado ended ({ended:?}); its log:\n{}", self.log());
            assert!(started.elapsed() < PATIENCE, "Monado does not start; its log:\n{}", self.log());
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// `SIGKILL`: clients find their connection broken.
    pub fn kill(&mut self) {
        let mut child = self.child.take().expect("the service does not run");
        child.kill().unwrap();
        child.wait().unwrap();
    }

    /// Stops the service in its tracks, and lets it go on.
    pub fn signal(&self, signal: nix::sys::signal::Signal) {
        let id = self.child.as_ref().expect("the service does not run").id();
        nix::sys::signal::kill(nix::unistd::Pid::from_raw(id.try_into().unwrap()), signal).unwrap();
    }

    /// Asks it to end, as a person would.
    pub fn stop(&mut self) {
        let mut child = self.child.take().expect("the service does not run");
        let id = nix::unistd::Pid::from_raw(child.id().try_into().unwrap());
        nix::sys::signal::kill(id, nix::sys::signal::Signal::SIGTERM).unwrap();
        let started = Instant::now();
        while child.try_wait().unwrap().is_none() {
            if started.elapsed() > PATIENCE {
                child.kill().unwrap();
                child.wait().unwrap();
                panic!("Monado does not end; its log:\n{}", self.log());
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Where the remote driver listens.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// The service's own folder, where a test may leave files too.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    fn log_file(&self) -> PathBuf {
        self.folder.path().join("monado.log")
    }

    /// What the service has said.
    pub fn log(&self) -> String {
        String::from_utf8_lossy(&fs::read(self.log_file()).unwrap_or_default()).into_owned()
    }

    /// `program` on Vulkan and on this service.
    pub fn command(&self, program: impl AsRef<OsStr>) -> Command {
        let mut command = program::on_vulkan(program);
        self.prepare(&mut command);
        command
    }

    /// `swell` on this service.
    pub fn swell(&self) -> Command {
        let mut command = program::swell();
        self.prepare(&mut command);
        command
    }

    /// The ignored test `name` of the running test program, in a process of its own on this service. A loader and a
    /// runtime keep what they once read from the environment, and a lost instance may end the process it is in.
    pub fn reexec(&self, name: &str) -> Command {
        // Not `current_exe`, which is the dynamic loader under the runner.
        let program = std::env::args_os().next().unwrap();
        let mut command = self.command(program);
        command.args([name, "--exact", "--ignored", "--nocapture", "--test-threads=1"]);
        command
    }

    fn prepare(&self, command: &mut Command) {
        command
            .env("SWELL_XR", "monado")
            .env("XDG_RUNTIME_DIR", self.folder.path())
            .env("XDG_CONFIG_HOME", self.folder.path().join("config"))
            // In a program Monado talks to standard error about everything.
            .env("OXR_NO_PRINTING", "1")
            .stdin(Stdio::null());
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        if self.child.is_some() {
            self.kill();
        }
        if std::thread::panicking() {
            eprintln!("Monado's log:\n{}", self.log());
        }
    }
}
