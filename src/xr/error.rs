//! What can go wrong between Swell and an OpenXR runtime, in words that say what to do next.

use openxr::sys;

/// What to do where there is no loader.
const LOADER: &str = if cfg!(target_os = "android") {
    "put libopenxr_loader.so beside libmain.so in the APK"
} else {
    "install it (Debian: apt-get install libopenxr-loader1)"
};

/// A failure of the XR layer.
#[derive(Debug, thiserror::Error)]
pub enum XrError {
    /// No OpenXR loader on this machine.
    #[error("no OpenXR loader: {0}; {LOADER}")]
    NoLoader(String),
    /// The loader found no runtime, or the one it found does not answer.
    #[error("{}; start one (Monado: monado-service), or wait for it with --xr-wait", self.what())]
    NoRuntime(sys::Result),
    /// The runtime is there and the headset is not.
    #[error("{}; connect it, or wait for it with --xr-wait", self.what())]
    NoHeadset {
        /// The runtime's name.
        runtime: String,
    },
    /// The runtime or its headset cannot do something that Swell needs.
    #[error("the OpenXR runtime {runtime} lacks {what}")]
    Missing {
        /// The runtime's name.
        runtime: String,
        /// What it lacks.
        what: String,
    },
    /// Validation was asked for and the layer is not installed.
    #[error(
        "the OpenXR validation layer XR_APILAYER_LUNARG_core_validation is not installed (Debian: apt-get install openxr-layer-corevalidation)"
    )]
    NoValidation,
    /// The runtime has gone: everything made from it is dead.
    #[error("{}; start it again, or wait for it with --xr-wait", self.what())]
    InstanceLost {
        /// What was being done.
        doing: &'static str,
    },
    /// The session has gone; another may be begun.
    #[error("the OpenXR session was lost (while {doing})")]
    SessionLost {
        /// What was being done.
        doing: &'static str,
    },
    /// Sessions end as fast as they begin.
    #[error("the OpenXR session was lost {times} times without a frame in between; giving up")]
    LostAgain {
        /// How often.
        times: u32,
    },
    /// A call failed.
    #[error("{doing}: OpenXR says {result:?}")]
    Call {
        /// What was being done.
        doing: &'static str,
        /// OpenXR's answer.
        result: sys::Result,
    },
}

impl XrError {
    /// Whether waiting may help: the runtime or the headset may yet come, or come back. Monado calls it a failure of its own
    /// where it goes while a session is begun.
    pub const fn may_pass(&self) -> bool {
        matches!(
            self,
            Self::NoRuntime(_)
                | Self::NoHeadset { .. }
                | Self::InstanceLost { .. }
                | Self::Call { result: sys::Result::ERROR_RUNTIME_FAILURE, .. }
        )
    }

    /// What is wrong, without advice: for whoever waits already.
    pub fn what(&self) -> String {
        match self {
            Self::NoRuntime(result) => format!("no OpenXR runtime answers ({result})"),
            Self::NoHeadset { runtime } => format!("the OpenXR runtime {runtime} has no headset ready"),
            Self::InstanceLost { doing } => format!("the OpenXR runtime has gone (while {doing})"),
            other => other.to_string(),
        }
    }
}

/// Names what was being done when a call failed.
pub(super) trait Doing<T> {
    fn doing(self, what: &'static str) -> Result<T, XrError>;
}

impl<T> Doing<T> for openxr::Result<T> {
    fn doing(self, doing: &'static str) -> Result<T, XrError> {
        self.map_err(|result| match result {
            result if is_gone(result) => XrError::InstanceLost { doing },
            sys::Result::ERROR_SESSION_LOST => XrError::SessionLost { doing },
            _ => XrError::Call { doing, result },
        })
    }
}

/// Whether `result` means that the runtime is there no more.
pub(super) const fn is_gone(result: sys::Result) -> bool {
    matches!(result, sys::Result::ERROR_INSTANCE_LOST | sys::Result::ERROR_RUNTIME_UNAVAILABLE)
}

/// A raw call's answer; codes of success that are not plain success come back as they are.
pub(super) fn check(result: sys::Result) -> openxr::Result<sys::Result> {
    if result.into_raw() >= 0 { Ok(result) } else { Err(result) }
}
