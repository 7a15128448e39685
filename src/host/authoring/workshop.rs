//! A thread that makes what a changed scene needs while the old one is shown: its sea, its sky, its renderer.

use super::Fit;
use crate::draw::{Look, SkyMap};
use crate::gpu::{Device, Pass};
use crate::host::painter::{self, Painter};
use crate::panel::Facts;
use crate::scene::{Scene, SkySettings, WaterSettings};
use crate::sea::SeaAhead;
use std::any::Any;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread::{self, JoinHandle};

/// What is shown now, and with what.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// The scene.
    pub scene: &'a Arc<Scene>,
    /// Its sky.
    pub sky: &'a Arc<SkyMap>,
    /// How it is looked at.
    pub look: Look,
    /// Of the targets.
    pub pass: &'a Arc<Pass>,
    /// The device drawn on.
    pub device: &'a Arc<Device>,
    /// Workers for a sea; 0 for one a core.
    pub threads: usize,
}

impl Shown<'_> {
    /// The same for the thread.
    pub(super) fn kept(&self) -> Kept {
        let Self { scene, sky, look, pass, device, threads } = *self;
        let (scene, sky) = (Arc::clone(scene), Arc::clone(sky));
        Kept { scene, sky, look, pass: Arc::clone(pass), device: Arc::clone(device), threads }
    }
}

/// [`Shown`], shared.
pub struct Kept {
    scene: Arc<Scene>,
    sky: Arc<SkyMap>,
    look: Look,
    pass: Arc<Pass>,
    device: Arc<Device>,
    threads: usize,
}

/// What to make.
pub enum Order {
    /// A scene.
    Scene {
        /// Its text, and the text's name.
        text: String,
        /// See `text`.
        origin: String,
        /// What it takes the place of.
        shown: Kept,
        /// What else is done to it.
        fit: Fit,
        /// When it will be seen, about, seconds.
        time: f64,
        /// Make the renderer whether or not the scene has changed: shaders have.
        anew: bool,
    },
    /// Numbers for the panel about a scene that is shown already.
    Facts(Arc<Scene>),
    /// To be dropped, which may wait.
    Waste(Box<dyn Any + Send>),
}

/// A scene with whatever of it is new.
pub struct Made {
    /// The scene.
    pub scene: Scene,
    /// Numbers for the panel.
    pub facts: Facts,
    /// Its sky, where that is another.
    pub sky: Option<Arc<SkyMap>>,
    /// Its sea, where that is another, ready for a step to a time near the one that was asked for.
    pub sea: Option<SeaAhead>,
    /// Its renderer, where colours and numbers alone will not do.
    pub painter: Option<Painter>,
    /// How that renderer looks at it.
    pub look: Look,
}

/// What became of an order.
pub enum Outcome {
    /// A scene.
    Made(Box<Made>),
    /// Why it is none.
    Refused(String),
    /// Numbers.
    Facts(Facts),
}

/// The thread, by its two ends.
pub struct Workshop {
    /// Until the end.
    orders: Option<Sender<Order>>,
    outcomes: Receiver<Outcome>,
    thread: Option<JoinHandle<()>>,
    busy: bool,
}

impl Workshop {
    /// Starts the thread; it ends with the workshop.
    pub fn new() -> Self {
        let (orders, taken) = channel();
        let (made, outcomes) = channel();
        let thread = thread::spawn(move || {
            for order in taken {
                if let Some(outcome) = work(order)
                    && made.send(outcome).is_err()
                {
                    return;
                }
            }
        });
        Self { orders: Some(orders), outcomes, thread: Some(thread), busy: false }
    }

    /// Whether a scene is being made.
    pub const fn is_busy(&self) -> bool {
        self.busy
    }

    /// Has `order` made.
    pub fn order(&mut self, order: Order) {
        self.busy |= matches!(order, Order::Scene { .. });
        if let Some(orders) = &self.orders {
            // Where the thread has gone, the order is dropped here.
            let _gone = orders.send(order);
        }
    }

    /// What has been made since the last call, if something has.
    pub fn finished(&mut self) -> Option<Outcome> {
        match self.outcomes.try_recv() {
            Ok(outcome) => {
                self.busy &= matches!(outcome, Outcome::Facts(_));
                Some(outcome)
            }
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => self.busy.then(|| {
                self.busy = false;
                Outcome::Refused("the thread that makes scenes has ended".to_owned())
            }),
        }
    }
}

impl Drop for Workshop {
    /// What it makes uses the device, which is to go after it.
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            let _panicked = thread.join();
        }
    }
}

fn work(order: Order) -> Option<Outcome> {
    match order {
        Order::Waste(waste) => {
            drop(waste);
            None
        }
        Order::Facts(scene) => Some(Outcome::Facts(Facts::of(&scene.sea))),
        Order::Scene { text, origin, shown, fit, time, anew } => {
            let read = Scene::parse(&text, &origin).map_err(|error| error.to_string());
            let made = read.and_then(|mut scene| {
                fit.apply(&mut scene);
                make(scene, &shown, time, anew)
            });
            Some(made.map_or_else(Outcome::Refused, Outcome::Made))
        }
    }
}

fn make(scene: Scene, shown: &Kept, time: f64, anew: bool) -> Result<Box<Made>, String> {
    let told = |error: &dyn std::error::Error| error.to_string();
    let before = &shown.scene;
    let sky = if light(&scene.sky) == light(&before.sky) {
        None
    } else {
        Some(Arc::new(SkyMap::new(&scene.sky).map_err(|error| told(&error))?))
    };
    let sea = if scene.sea == before.sea {
        None
    } else {
        let mut sea = painter::begin_sea(&scene, shown.threads, Some(time)).map_err(|error| told(&error))?;
        // The first step remembers foam from before it, which takes its time.
        sea.next(None).map_err(|error| told(&error))?;
        Some(sea)
    };
    let painter = if anew || sky.is_some() || !is_repainting(before, &scene) {
        let sky = sky.as_ref().unwrap_or(&shown.sky);
        let painter = Painter::new(&shown.device, &shown.pass, &scene, sky, shown.look);
        Some(painter.map_err(|error| told(&error))?)
    } else {
        None
    };
    let facts = Facts::of(&scene.sea);
    Ok(Box::new(Made { scene, facts, sky, sea, painter, look: shown.look }))
}

/// What of a sky is in its map.
fn light(sky: &SkySettings) -> SkySettings {
    SkySettings { exposure: 0.0, visibility: 0.0, ..sky.clone() }
}

/// Whether `after` differs from `before` in nothing but what a renderer can be told. Whatever else there is, known here or not, wants
/// a new one.
fn is_repainting(before: &Scene, after: &Scene) -> bool {
    let water = WaterSettings {
        deep_color: after.water.deep_color,
        scatter_color: after.water.scatter_color,
        scatter: after.water.scatter,
        foam_color: after.water.foam_color,
        detail: after.water.detail,
        ..before.water
    };
    let sky =
        SkySettings { exposure: after.sky.exposure, visibility: after.sky.visibility, ..before.sky.clone() };
    let repainted = Scene {
        water,
        sky,
        camera: after.camera,
        raft: after.raft,
        buoys: after.buoys.clone(),
        warnings: after.warnings.clone(),
        ..before.clone()
    };
    repainted == *after
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_and_cameras_need_no_new_renderer_and_all_else_does() {
        let scene = |text: &str| Scene::parse(text, "scene").unwrap();
        let before = scene("");
        for same in [
            "[water]\nscatter = 2.0\ndeep_color = [0.1, 0.1, 0.1]\ndetail = 0.5",
            "[sky]\nexposure = 1.0\nvisibility = 5000.0",
            "[camera]\neye = [1.0, 2.0, 3.0]",
            "[[buoy]]",
            "[raft]\nlength = 5.0",
        ] {
            assert!(is_repainting(&before, &scene(same)), "{same}");
        }
        for other in ["[sea]\nwind_speed = 3.0", "[lod]\nquality = \"low\"", "[sky]\nsun_elevation_deg = 3.0"]
        {
            assert!(!is_repainting(&before, &scene(other)), "{other}");
        }
    }
}
