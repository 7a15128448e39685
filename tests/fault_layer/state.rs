//! What the layer remembers: for a process, for its instance, for its session.
use crate::events::Event;
use crate::next::Next;
use crate::plan::{Fault, Plan};
use openxr::sys::{self, Handle as _, pfn};
use std::collections::{BTreeMap, VecDeque};
use std::fs::File;
use std::io::Write as _;
use std::sync::Mutex;

static STATE: Mutex<Option<State>> = Mutex::new(None);

/// The state, made on first use. Not to be held while the runtime works: `xrWaitFrame` waits, and others call meanwhile.
pub fn with<R>(use_it: impl FnOnce(&mut State) -> R) -> R {
    let mut state = STATE.lock().expect("a call panicked before");
    use_it(state.get_or_insert_with(State::from_environment))
}

pub struct State {
    plan: Plan,
    log: Option<File>,
    calls: BTreeMap<&'static str, u32>,
    next: Option<Next>,
    instance: sys::Instance,
    session: sys::Session,
    instance_lost: bool,
    loss_announced: bool,
    session_lost: bool,
    /// What is below this layer's function, where the extension is enabled.
    pub visibility_mask: Option<pfn::GetVisibilityMaskKHR>,
    /// Told before whatever the runtime has to tell.
    pub pending: VecDeque<Event>,
    /// When the last frame that was waited for will be seen.
    pub display_time: sys::Time,
}

impl State {
    /// A wrong plan or log ends the process: a test that asks for a fault and gets none proves nothing.
    fn from_environment() -> Self {
        let plan = Plan::parse(&std::env::var("SWELL_FAULTS").unwrap_or_default());
        let log = std::env::var_os("SWELL_FAULT_LOG").map(|file| {
            File::options()
                .create(true)
                .append(true)
                .open(file)
                .expect("SWELL_FAULT_LOG names no writable file")
        });
        Self {
            plan: plan.unwrap_or_else(|wrong| panic!("{wrong}")),
            log,
            calls: BTreeMap::new(),
            next: None,
            instance: sys::Instance::NULL,
            session: sys::Session::NULL,
            instance_lost: false,
            loss_announced: false,
            session_lost: false,
            visibility_mask: None,
            pending: VecDeque::new(),
            display_time: sys::Time::from_nanos(0),
        }
    }

    /// The functions below; whoever calls this layer has an instance.
    pub fn next(&self) -> Next {
        self.next.expect("no instance was made through this layer")
    }

    pub fn instance(&self) -> sys::Instance {
        self.instance
    }

    pub fn session(&self) -> sys::Session {
        self.session
    }

    /// A line of the log, written at once: a program that dies has said it.
    pub fn say(&mut self, line: &str) {
        if let Some(log) = &mut self.log {
            log.write_all(format!("{line}\n").as_bytes()).expect("cannot write SWELL_FAULT_LOG");
        }
    }

    /// The same for a call: its error, if there is one, at the end.
    pub fn say_call(&mut self, line: &str, result: sys::Result) {
        match result {
            sys::Result::SUCCESS => self.say(line),
            _ => self.say(&format!("{line} -> {result:?}")),
        }
    }

    /// The number of this call of `function`, from 1.
    pub fn count(&mut self, function: &'static str) -> u32 {
        let calls = self.calls.entry(function).or_default();
        *calls += 1;
        *calls
    }

    pub fn strikes(&mut self, fault: Fault, call: u32) -> bool {
        let strikes = self.plan.strikes(fault, call);
        if strikes {
            self.say(&format!("fault {} {call}", fault.name()));
        }
        strikes
    }

    /// `error` where `fault` strikes.
    pub fn fails(&mut self, fault: Fault, call: u32, error: sys::Result) -> Option<sys::Result> {
        self.strikes(fault, call).then_some(error)
    }

    pub fn lose_instance(&mut self) {
        self.instance_lost = true;
    }

    /// The instance will be lost when the program has read all events.
    pub fn announce_loss(&mut self) {
        self.loss_announced = true;
    }

    pub fn all_events_read(&mut self) {
        self.instance_lost |= self.loss_announced;
    }

    pub fn lose_session(&mut self) {
        self.session_lost = true;
    }

    /// What every call that needs the instance has to return.
    pub fn instance_error(&self) -> Option<sys::Result> {
        self.instance_lost.then_some(sys::Result::ERROR_INSTANCE_LOST)
    }

    /// What every call that needs the session has to return.
    pub fn session_error(&self) -> Option<sys::Result> {
        self.instance_error().or(self.session_lost.then_some(sys::Result::ERROR_SESSION_LOST))
    }

    pub fn instance_made(&mut self, instance: sys::Instance, next: Next) {
        self.instance = instance;
        self.next = Some(next);
    }

    pub fn instance_gone(&mut self) {
        self.session_gone();
        self.instance = sys::Instance::NULL;
        self.instance_lost = false;
        self.loss_announced = false;
    }

    pub fn session_made(&mut self, session: sys::Session) {
        self.session = session;
    }

    pub fn session_gone(&mut self) {
        self.session = sys::Session::NULL;
        self.session_lost = false;
        self.pending.clear();
    }
}
