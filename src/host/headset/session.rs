//! A session's frames: what the runtime says is heard between them, and each is waited for, drawn and ended.

use super::panel::{HeadsetPanel, Quad, cut_ahead};
use super::ride::Person;
use super::stage::Stage;
use super::warp::Warp;
use super::world::World;
use super::{Drawn, Guest, HeadsetFrame, Over, REST, Show};
use crate::host::HostError;
use crate::xr::{Demand, EventDataBuffer, HANDS, Notice, XrError};
use std::thread;
use std::time::{Duration, Instant};

/// A session that was asked to end and does not is left.
const PATIENCE: Duration = Duration::from_secs(3);

impl Show<'_> {
    /// One session, from its first event to its last.
    pub(super) fn session(
        &mut self,
        world: &mut World,
        kept: &mut Option<Stage>,
        guest: &mut dyn Guest,
    ) -> Result<Over, HostError> {
        let stage = match kept {
            Some(stage) => stage,
            None => {
                let scale = self.adapt.level().scale;
                let device = world.painter.device();
                kept.insert(Stage::new(&world.runtime, device, self.settings, guest.looks(), scale)?)
            }
        };
        if self.settings.thread_hints {
            stage.hint_threads(&self.sea.kernel_ids())?;
        }
        stage.show_hidden_area(&mut world.painter)?;
        if let Some(warp) = &stage.warp {
            world.painter.prepare_motion(warp.target())?;
        }
        self.pace.forget_clock();
        self.adapt.interrupt();
        let mut buffer = EventDataBuffer::new();
        let mut asked_to_end: Option<Instant> = None;
        loop {
            while let Some(notice) = world.runtime.poll(&mut buffer)? {
                match notice {
                    Notice::State(state) => {
                        let demand = stage.session.enter(state)?;
                        guest.state(stage.session.lifecycle().name());
                        match demand {
                            Demand::Leave => return Ok(Over::Ended),
                            Demand::Lost => return Ok(Over::Lost),
                            Demand::Nothing | Demand::Begin | Demand::End => {}
                        }
                    }
                    Notice::InstanceLossPending => {
                        return Err(XrError::InstanceLost { doing: "listening for events" }.into());
                    }
                    Notice::MaskChanged => stage.show_hidden_area(&mut world.painter)?,
                    Notice::ProfileChanged => stage.tell_hands()?,
                    Notice::EventsLost(count) => eprintln!("the OpenXR runtime dropped {count} events"),
                    Notice::Recentred { space, at } if space == stage.session.space => {
                        stage.moves_at = Some(at);
                    }
                    Notice::Recentred { .. } | Notice::RefreshRate(_) | Notice::Performance => {}
                }
            }
            let running = stage.session.lifecycle().is_running();
            if self.is_enough(guest) {
                match asked_to_end {
                    None if running => {
                        stage.session.request_exit()?;
                        asked_to_end = Some(Instant::now());
                    }
                    None => return Ok(Over::Ended),
                    Some(since) if since.elapsed() > PATIENCE => return Ok(Over::Ended),
                    Some(_) => {}
                }
            }
            if running {
                let ending = asked_to_end.is_some();
                self.frame(world, stage, guest, ending)?;
                if let Some(change) = self.adapt.take() {
                    self.change_level(change, world, stage, guest)?;
                }
            } else {
                thread::sleep(REST);
            }
        }
    }

    /// Waits for a frame and shows it; an empty one while the session is `ending`, or nobody would see it.
    fn frame(
        &mut self,
        world: &mut World,
        stage: &mut Stage,
        guest: &mut dyn Guest,
        ending: bool,
    ) -> Result<(), HostError> {
        let time = stage.session.wait()?;
        stage.session.begin()?;
        let views = if time.should_render && !ending { stage.session.locate(time)? } else { None };
        if views.is_some() {
            let seconds = self.pace.time_of(time);
            self.author(world, stage, seconds, guest)?;
        }
        // The eyes, the images and the hands are seen to while the sea's workers are at it.
        let seconds = match views {
            Some(_) => self.pace.begin(&mut self.sea, time)?,
            None => self.pace.time_of(time),
        };
        let turns = match views {
            Some(_) => stage.acquire()?,
            None => None,
        };
        let (Some(views), Some(turns)) = (views, turns) else {
            stage.end_empty(time)?;
            self.adapt.interrupt();
            if !ending {
                self.report.skipped += 1;
            }
            let state = stage.session.lifecycle().name();
            return guest.frame(&HeadsetFrame { time: seconds, state, drawn: None });
        };
        let hands = stage.input.hands(&stage.session, time)?;
        let joints = stage.joints(time, &hands)?;
        let pointed = self.point(stage, &views, &hands, seconds, guest)?;
        let board = stage.quad.as_mut().map_or(Ok(None), Quad::acquire)?;
        let maps = self.pace.maps(&mut self.sea)?;
        let moved = stage.has_moved(time);
        let person =
            Person { views: &views, hands: &pointed.hands, rays: &pointed.rays, joints: &joints, moved };
        let ridden = self.ride.step(&self.scene, maps, seconds, &person);
        cut_ahead(self.panel.as_mut(), maps, &ridden.eyes[0]);
        let index = self.report.shown as usize;
        let target = (&stage.views.target, turns.views);
        let motion = stage.warp.as_ref().map(Warp::target).zip(turns.motion);
        let (mut over, quad) = (Ok(()), &mut stage.quad);
        let counts = world.painter.paint_moving(index, target, motion, ridden.moment(maps), |commands| {
            stage.views.copy(commands, turns.views);
            if let (Some(quad), Some(turn)) = (quad, board) {
                over = quad.record(commands, turn, index);
            }
        })?;
        over?;
        stage.release()?;
        stage.end(time, ridden.step, self.panel.as_ref().and_then(HeadsetPanel::board))?;
        for hand in (0..HANDS).filter(|&hand| ridden.buzz[hand]) {
            stage.input.buzz(&stage.session, hand, 0.5)?;
        }
        self.report.shown += 1;
        self.adapt.frame(time);
        let drawn = Drawn {
            eyes: &ridden.eyes,
            hands: &hands,
            solids: ridden.solids,
            vignette: ridden.vignette,
            counts,
            uploaded: world.painter.uploaded(),
            sea: self.sea.last_step(),
            picture: stage.picture(),
        };
        let state = stage.session.lifecycle().name();
        guest.frame(&HeadsetFrame { time: seconds, state, drawn: Some(drawn) })
    }
}
