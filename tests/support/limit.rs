//! An end to waiting for another process that never answers.
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Kills a process that is being waited for, unless it is dropped in time: whoever waits gets an error then, and what was done last
/// is told.
pub struct Limit {
    doing: Arc<Mutex<String>>,
    _running: Sender<()>,
}

impl Limit {
    /// On the process `id`, which is a child of this one.
    pub fn new(id: u32, time: Duration) -> Self {
        let (running, ended) = channel();
        let doing = Arc::new(Mutex::new("the beginning".to_owned()));
        let told = Arc::clone(&doing);
        std::thread::spawn(move || {
            if ended.recv_timeout(time) == Err(RecvTimeoutError::Timeout) {
                eprintln!("for {time:?} no further than: {}", told.lock().unwrap());
                kill(Pid::from_raw(id.try_into().unwrap()), Signal::SIGKILL).unwrap();
            }
        });
        Self { doing, _running: running }
    }

    /// Notes what comes next.
    pub fn now(&self, doing: &str) {
        doing.clone_into(&mut self.doing.lock().unwrap());
    }
}
