//! An X server without a screen, and the hands of who sits before it: windows are found, moved about, closed and typed
//! into, and what the screen shows is a picture. There is no window manager: this plays its part where one is missed.
use super::picture::Picture;
use std::fs;
use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{
    self, Atom, AtomEnum, ClientMessageEvent, ConfigureWindowAux, ConnectionExt as _, EventMask, InputFocus,
    MapState, PropMode,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

/// Long, for a busy machine: nobody waits for it unless something is wrong.
const PATIENCE: Duration = Duration::from_secs(60);

/// A running server; dropping it kills it, and with it the connections of its clients.
pub struct Xvfb {
    server: Child,
    folder: TempDir,
    display: String,
    connection: RustConnection,
    root: xproto::Window,
}

impl Xvfb {
    /// On a display of its own, with one screen of this many pixels, black.
    pub fn start([width, height]: [u32; 2]) -> Self {
        let folder = TempDir::with_prefix("swell-x11-").unwrap();
        // It chooses a free display and says so on file descriptor 1, its standard output.
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", &format!("{width}x{height}x24"), "-noreset", "-fbdir"])
            .arg(folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(fs::File::create(folder.path().join("log")).unwrap())
            .spawn()
            .expect("no Xvfb: run tests with ./x test, which says how to get it");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        assert!(display.len() > 1, "{}", fs::read_to_string(folder.path().join("log")).unwrap());
        let (connection, screen) = x11rb::connect(Some(&display)).unwrap();
        let root = connection.setup().roots[screen].root;
        Self { server, folder, display, connection, root }
    }

    /// The server's process.
    pub fn id(&self) -> u32 {
        self.server.id()
    }

    /// What `DISPLAY` is to be for its clients.
    pub fn display(&self) -> &str {
        &self.display
    }

    /// Makes `command` a client.
    pub fn show<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command.env("DISPLAY", &self.display).env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET")
    }

    /// What the screen shows now.
    pub fn screenshot(&self) -> Picture {
        // Replies come when what was asked before is done.
        self.connection.sync().unwrap();
        read_xwd(&fs::read(self.folder.path().join("Xvfb_screen0")).unwrap())
    }

    /// Waits until the screen shows something that `is_right`; the last picture is left for people where none is.
    pub fn screenshot_when(&self, is_right: impl Fn(&Picture) -> bool) -> Picture {
        let started = Instant::now();
        loop {
            let picture = self.screenshot();
            if is_right(&picture) {
                return picture;
            }
            if started.elapsed() > PATIENCE {
                let left = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("screen.png");
                picture.save(&left);
                panic!("the screen never shows what it should; see {}", left.display());
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Waits for a window whose title contains `title` to be shown.
    pub fn window(&self, title: &str) -> Window<'_> {
        let started = Instant::now();
        loop {
            if let Some(id) = self.find(self.root, title) {
                let window = Window { screen: self, id };
                if window.is_shown() {
                    return window;
                }
            }
            assert!(started.elapsed() < PATIENCE, "no window {title:?} comes; titles: {:?}", self.titles());
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Titles of the windows there are.
    pub fn titles(&self) -> Vec<String> {
        let children = self.connection.query_tree(self.root).unwrap().reply().unwrap().children;
        children
            .into_iter()
            .filter_map(|window| self.title(window))
            .filter(|title| !title.is_empty())
            .collect()
    }

    fn find(&self, parent: xproto::Window, title: &str) -> Option<xproto::Window> {
        let children = self.connection.query_tree(parent).unwrap().reply().ok()?.children;
        children.into_iter().find_map(|window| {
            let found = self.title(window).is_some_and(|own| own.contains(title));
            if found { Some(window) } else { self.find(window, title) }
        })
    }

    /// None where the window is gone.
    fn title(&self, window: xproto::Window) -> Option<String> {
        for name in [self.atom("_NET_WM_NAME"), AtomEnum::WM_NAME.into()] {
            let ask = self.connection.get_property(false, window, name, AtomEnum::ANY, 0, 256).unwrap();
            let value = ask.reply().ok()?.value;
            if !value.is_empty() {
                return Some(String::from_utf8_lossy(&value).into_owned());
            }
        }
        Some(String::new())
    }

    fn atom(&self, name: &str) -> Atom {
        self.connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom
    }

    /// The pointer goes to (x, y) in pixels from the screen's upper left corner.
    pub fn point(&self, x: i16, y: i16) {
        self.fake(xproto::MOTION_NOTIFY_EVENT, 0, x, y);
    }

    /// A button of the mouse, 1 the left one, goes down or up.
    pub fn button(&self, button: u8, down: bool) {
        let kind = if down { xproto::BUTTON_PRESS_EVENT } else { xproto::BUTTON_RELEASE_EVENT };
        self.fake(kind, button, 0, 0);
    }

    /// The pointer goes to `from`, the left button goes down, the pointer goes to `to`, the button comes up: all of it at once, so
    /// that a client finds it between two of its frames.
    pub fn pull(&self, from: [i16; 2], to: [i16; 2]) {
        use xproto::{BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, MOTION_NOTIFY_EVENT};
        let steps =
            (0..=4_i16).map(|step| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) / 4 * step));
        let mut motions = steps.map(|at| (MOTION_NOTIFY_EVENT, 0, at));
        let begin = motions.next().into_iter().chain([(BUTTON_PRESS_EVENT, 1, [0, 0])]);
        for (kind, detail, [x, y]) in begin.chain(motions).chain([(BUTTON_RELEASE_EVENT, 1, [0, 0])]) {
            // Kept back until they are all there.
            let now = x11rb::CURRENT_TIME;
            self.connection.xtest_fake_input(kind, detail, now, self.root, x, y, 0).unwrap();
        }
        self.connection.sync().unwrap();
    }

    /// A key goes down or up, by its keysym: ASCII for letters and digits, else as in X's `keysymdef.h`.
    pub fn key(&self, keysym: u32, down: bool) {
        let setup = self.connection.setup();
        let (first, last) = (setup.min_keycode, setup.max_keycode);
        let map = self.connection.get_keyboard_mapping(first, last - first + 1).unwrap().reply().unwrap();
        let per_key = usize::from(map.keysyms_per_keycode);
        let index = map.keysyms.chunks(per_key).position(|symbols| symbols.contains(&keysym));
        let code = first + u8::try_from(index.expect("no key has this symbol")).unwrap();
        let kind = if down { xproto::KEY_PRESS_EVENT } else { xproto::KEY_RELEASE_EVENT };
        self.fake(kind, code, 0, 0);
    }

    fn fake(&self, kind: u8, detail: u8, x: i16, y: i16) {
        self.connection.xtest_fake_input(kind, detail, x11rb::CURRENT_TIME, self.root, x, y, 0).unwrap();
        self.connection.sync().unwrap();
    }
}

impl Drop for Xvfb {
    fn drop(&mut self) {
        // Asked to end, it takes its socket and its lock with it.
        let id = nix::unistd::Pid::from_raw(self.server.id().try_into().unwrap());
        let _ = nix::sys::signal::kill(id, nix::sys::signal::Signal::SIGTERM);
        let started = Instant::now();
        while matches!(self.server.try_wait(), Ok(None)) {
            if started.elapsed() > PATIENCE {
                let _ = self.server.kill();
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Keysyms of keys that have no character.
pub const ESCAPE: u32 = 0xff1b;
pub const F1: u32 = 0xffbe;

/// A client's window.
#[derive(Clone, Copy)]
pub struct Window<'a> {
    screen: &'a Xvfb,
    id: xproto::Window,
}

impl Window<'_> {
    fn connection(&self) -> &RustConnection {
        &self.screen.connection
    }

    /// Place on the screen and size, pixels.
    pub fn frame(&self) -> ([i16; 2], [u32; 2]) {
        let frame = self.connection().get_geometry(self.id).unwrap().reply().unwrap();
        ([frame.x, frame.y], [frame.width.into(), frame.height.into()])
    }

    pub fn is_shown(&self) -> bool {
        let attributes = self.connection().get_window_attributes(self.id).unwrap().reply();
        attributes.is_ok_and(|attributes| attributes.map_state == MapState::VIEWABLE)
    }

    pub fn is_there(&self) -> bool {
        self.connection().get_window_attributes(self.id).unwrap().reply().is_ok()
    }

    /// Its part of the screen; it has to be on it as a whole.
    pub fn picture(&self) -> Picture {
        let ([x, y], size) = self.frame();
        crop(&self.screen.screenshot(), [x, y].map(|place| u32::try_from(place).unwrap()), size)
    }

    pub fn resize(&self, [width, height]: [u32; 2]) {
        let change = ConfigureWindowAux::new().width(width).height(height);
        self.connection().configure_window(self.id, &change).unwrap();
        self.connection().sync().unwrap();
    }

    /// What is typed goes to it.
    pub fn focus(&self) {
        let connection = self.connection();
        connection.set_input_focus(InputFocus::PARENT, self.id, x11rb::CURRENT_TIME).unwrap();
        connection.sync().unwrap();
    }

    /// As a window manager makes a window an icon: gone from the screen, and told so.
    pub fn minimise(&self) {
        self.set_state(3, &[self.screen.atom("_NET_WM_STATE_HIDDEN")]);
        self.connection().unmap_window(self.id).unwrap();
        self.connection().sync().unwrap();
    }

    /// Back on the screen.
    pub fn restore(&self) {
        self.set_state(1, &[]);
        self.connection().map_window(self.id).unwrap();
        self.connection().sync().unwrap();
    }

    /// `WM_STATE`, normal 1 or iconic 3, and `_NET_WM_STATE`.
    fn set_state(&self, state: u32, more: &[Atom]) {
        let (name, net_name) = (self.screen.atom("WM_STATE"), self.screen.atom("_NET_WM_STATE"));
        let connection = self.connection();
        connection.change_property32(PropMode::REPLACE, self.id, name, name, &[state, 0]).unwrap();
        connection.change_property32(PropMode::REPLACE, self.id, net_name, AtomEnum::ATOM, more).unwrap();
    }

    /// As its close button does: asks it to go.
    pub fn close(&self) {
        let [protocols, delete] = ["WM_PROTOCOLS", "WM_DELETE_WINDOW"].map(|name| self.screen.atom(name));
        let connection = self.connection();
        let ask = connection.get_property(false, self.id, protocols, AtomEnum::ATOM, 0, 64).unwrap();
        let known = ask.reply().unwrap();
        assert!(
            known.value32().is_some_and(|mut known| known.any(|atom| atom == delete)),
            "it cannot be asked"
        );
        let message = ClientMessageEvent::new(32, self.id, protocols, [delete, x11rb::CURRENT_TIME, 0, 0, 0]);
        connection.send_event(false, self.id, EventMask::NO_EVENT, message).unwrap();
        connection.sync().unwrap();
    }
}

fn crop(picture: &Picture, [x, y]: [u32; 2], size: [u32; 2]) -> Picture {
    assert!(
        x + size[0] <= picture.size[0] && y + size[1] <= picture.size[1],
        "{size:?} at {x}, {y} is not on screen"
    );
    let row = |y: u32| {
        let start = 3 * (y * picture.size[0] + x) as usize;
        &picture.rgb[start..start + 3 * size[0] as usize]
    };
    Picture { size, rgb: (y..y + size[1]).flat_map(|y| row(y).iter().copied()).collect() }
}

/// A file in X's window dump format (`XWDFile.h`), as far as Xvfb writes it: 32 bits a pixel, blue first.
fn read_xwd(file: &[u8]) -> Picture {
    let word = |index: usize| u32::from_be_bytes(file[4 * index..4 * index + 4].try_into().unwrap());
    let [header, width, height, bits, row, colours] = [0, 4, 5, 11, 12, 19].map(|index| word(index) as usize);
    let (least_significant_first, red) = (word(7) == 0, word(14));
    assert!(bits == 32 && least_significant_first && red == 0xff_0000, "{bits} bits a pixel, red {red:x}");
    let pixels = &file[header + 12 * colours..];
    let rgb = pixels
        .chunks(row)
        .take(height)
        .flat_map(|row| row[..4 * width].chunks_exact(4).flat_map(|pixel| [pixel[2], pixel[1], pixel[0]]));
    Picture { size: [width as u32, height as u32], rgb: rgb.collect() }
}
