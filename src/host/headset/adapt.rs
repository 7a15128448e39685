//! Frames are made less finely while they run late: [`crate::host::fallback`] decides, this does it.

use super::stage::Stage;
use super::world::{World, keep};
use super::{Guest, HeadsetSettings, Show};
use crate::host::HostError;
use crate::host::fallback::{Change, Fallback, Ladder, Level, Punctuality};
use crate::scene::Scene;
use crate::xr::FrameTime;

/// What decides, where anything is to be decided.
pub struct Adapt {
    fallback: Option<Fallback>,
    /// What is drawn without.
    best: Level,
    punctuality: Punctuality,
    /// Decided after the frame that was shown last.
    change: Option<Change>,
}

impl Adapt {
    pub fn new(scene: &Scene, settings: &HeadsetSettings) -> Self {
        let ladder = Ladder::new(scene.lod.quality);
        Self {
            best: ladder.level(0),
            fallback: settings.fallback.map(|level| Fallback::new(ladder, level)),
            punctuality: Punctuality::new(settings.space_warp),
            change: None,
        }
    }

    /// The scene asks for another quality from now on. The level is of the same number, and so are the views' sizes.
    pub fn refit(&mut self, scene: &Scene) {
        let ladder = Ladder::new(scene.lod.quality);
        self.best = ladder.level(0);
        if let Some(fallback) = &mut self.fallback {
            *fallback = Fallback::new(ladder, fallback.number());
        }
    }

    /// What frames are made on.
    pub fn level(&self) -> Level {
        self.fallback.as_ref().map_or(self.best, Fallback::level)
    }

    /// Its number.
    pub fn number(&self) -> usize {
        self.fallback.as_ref().map_or(0, Fallback::number)
    }

    /// A frame was shown.
    pub fn frame(&mut self, time: FrameTime) {
        let late = self.punctuality.frame(time.seconds, time.period);
        if let (Some(fallback), Some(late)) = (&mut self.fallback, late) {
            self.change = fallback.frame(late);
        }
    }

    /// The next frame does not follow the one shown last.
    pub const fn interrupt(&mut self) {
        self.punctuality.interrupt();
    }

    /// What was decided.
    pub const fn take(&mut self) -> Option<Change> {
        self.change.take()
    }
}

impl Show<'_> {
    /// Sees to it that a renderer that was just made, and the sea, are on the level that frames are made on.
    pub(super) fn use_level(&mut self, world: &mut World) -> Result<(), HostError> {
        let level = self.adapt.level();
        if level.quality != self.scene.lod.quality {
            world.painter.set_quality(&self.scene, level.quality)?;
        }
        self.sea.take_turns(level.in_turns);
        Ok(())
    }

    /// Goes over to another level between two frames, and says so.
    pub(super) fn change_level(
        &mut self,
        change: Change,
        world: &mut World,
        stage: &mut Stage,
        guest: &mut dyn Guest,
    ) -> Result<(), HostError> {
        let ladder = Ladder::new(self.scene.lod.quality);
        let (from, to) = (ladder.level(change.from), ladder.level(change.to));
        if from.scale != to.scale {
            // Whoever looks on reads the picture that goes.
            keep(world, Some(stage), true, guest)?;
            stage.resize(self.settings, guest.looks(), to.scale)?;
        }
        if from.quality != to.quality {
            world.painter.set_quality(&self.scene, to.quality)?;
        }
        self.sea.take_turns(to.in_turns);
        self.adapt.interrupt();
        guest.level(change.to);
        let why = if change.to > change.from {
            format!("{} of {} frames were late", change.late, change.frames)
        } else {
            "frames are in time again".to_owned()
        };
        let waves = if to.in_turns { ", small waves every second frame" } else { "" };
        let [width, height] = stage.size();
        eprintln!(
            "level {} of {}: {why}; {width}x{height} an eye, quality {:?}{waves}",
            change.to,
            ladder.last(),
            to.quality
        );
        Ok(())
    }
}
