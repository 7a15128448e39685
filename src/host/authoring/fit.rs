//! What a host does to every scene that it reads.

use crate::scene::Scene;
use std::fmt;
use std::sync::Arc;

/// Sets what somebody else than the scene decides: the quality that a command line asked for, or what a headset is up to.
#[derive(Clone)]
pub struct Fit(Arc<dyn Fn(&mut Scene) + Send + Sync>);

impl Fit {
    /// Does `fit` to each.
    pub fn new(fit: impl Fn(&mut Scene) + Send + Sync + 'static) -> Self {
        Self(Arc::new(fit))
    }

    /// Does `more` after it.
    #[must_use]
    pub fn then(self, more: impl Fn(&mut Scene) + Send + Sync + 'static) -> Self {
        Self::new(move |scene| {
            self.apply(scene);
            more(scene);
        })
    }

    /// Does it to `scene`.
    pub fn apply(&self, scene: &mut Scene) {
        (self.0)(scene);
    }
}

impl fmt::Debug for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Fit")
    }
}
