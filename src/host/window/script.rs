//! A session played by a script: what a hand would do, a line each, so that it can be recorded and shown again.
//!
//! Places are keys of the scene, `sea.wind_speed`, or buttons, `Undo`; docs/panel.md has the words.

use crate::panel::{Edit, Panel};
use egui::{Event, Modifiers, PointerButton, Pos2, Rect};
use std::collections::VecDeque;
use std::path::Path;
use std::str::FromStr;

/// Frames a second that a script counts in.
const RATE: f64 = 30.0;
/// Frames that the pointer takes to a place, and that a drag takes.
const WAY: u32 = 14;
const DRAG: u32 = 36;
/// Frames after which a place that is not there counts as none.
const LOST: u32 = 90;

/// One line.
#[derive(Clone, Debug, PartialEq)]
enum Line {
    /// So many frames pass.
    Wait(u32),
    /// The panel is shown, or hidden.
    Panel,
    /// The pointer goes to a place and clicks.
    Click(String),
    /// The same for a word of a list that is open.
    Choose(String),
    /// The pointer presses at a share of a place's width and moves to another.
    Drag(String, [f32; 2]),
    /// What keys with Ctrl do.
    Edit(Edit),
}

/// Lines of a script, and how far the first of them has come.
#[derive(Clone, Debug)]
pub struct Script {
    lines: VecDeque<Line>,
    frame: u32,
    from: Pos2,
    pointer: Pos2,
    name: String,
}

/// A script that cannot be read, or not be played.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ScriptError {
    /// It cannot be read.
    #[error("{file}: {reason}")]
    Read {
        /// The file.
        file: String,
        /// What the system said.
        reason: String,
    },
    /// A line that says nothing.
    #[error(
        "{file}:{line}: {text:?} is none of: wait FRAMES; panel; click PLACE; choose WORD; drag PLACE FROM TO; undo; redo; save"
    )]
    Line {
        /// The file.
        file: String,
        /// Counted from 1.
        line: usize,
        /// What it says.
        text: String,
    },
    /// A place that is not there.
    #[error("{script}: the panel shows no {place}")]
    NoPlace {
        /// The script.
        script: String,
        /// What was looked for.
        place: String,
    },
}

/// What a frame of a script asks of the window.
#[derive(Debug, Default, PartialEq)]
pub struct Asked {
    /// Events for the panel.
    pub events: Vec<Event>,
    /// Show the panel, or hide it.
    pub toggle: bool,
}

impl Script {
    /// Reads the script at `path`.
    ///
    /// # Errors
    /// [`ScriptError::Read`] and [`ScriptError::Line`].
    pub fn load(path: &Path) -> Result<Self, ScriptError> {
        let file = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|error| ScriptError::Read { file: file.clone(), reason: error.to_string() })?;
        Self::parse(&text, &file)
    }

    /// Reads the script in `text`, of the file `file`. A line is empty, a comment after `#`, or one thing to do.
    ///
    /// # Errors
    /// [`ScriptError::Line`].
    pub fn parse(text: &str, file: &str) -> Result<Self, ScriptError> {
        let mut lines = VecDeque::new();
        for (number, line) in text.lines().enumerate() {
            let said = line.split('#').next().unwrap_or_default().trim();
            if !said.is_empty() {
                lines.push_back(read(said).ok_or_else(|| ScriptError::Line {
                    file: file.to_owned(),
                    line: number + 1,
                    text: said.to_owned(),
                })?);
            }
        }
        let start = Pos2::new(200.0, 200.0);
        Ok(Self { lines, frame: 0, from: start, pointer: start, name: file.to_owned() })
    }

    /// Seconds that a frame counts as.
    pub const fn step(&self) -> f64 {
        1.0 / RATE
    }

    /// Whether everything is done.
    pub fn is_over(&self) -> bool {
        self.lines.is_empty()
    }

    /// Goes on by a frame, in what `panel` showed in the frame before; `choice` finds a word of an open list.
    ///
    /// # Errors
    /// [`ScriptError::NoPlace`].
    pub fn go_on(
        &mut self,
        panel: &mut Panel,
        choice: impl Fn(&str) -> Option<Rect>,
    ) -> Result<Asked, ScriptError> {
        let mut asked = Asked::default();
        let Some(line) = self.lines.front().cloned() else { return Ok(asked) };
        let over = match &line {
            Line::Wait(frames) => self.frame + 1 >= *frames,
            Line::Panel => {
                asked.toggle = true;
                true
            }
            Line::Edit(edit) => {
                panel.edit(*edit);
                true
            }
            Line::Click(place) => {
                if self.frame == 0 {
                    panel.seek(place);
                }
                let at = panel.place(place);
                self.click(place, at.map(|at| at.center()), &mut asked)?
            }
            Line::Choose(word) => {
                let at = choice(word);
                self.click(word, at.map(|at| at.center()), &mut asked)?
            }
            Line::Drag(place, shares) => {
                if self.frame == 0 {
                    panel.seek(place);
                }
                self.drag(place, panel.place(place), *shares, &mut asked)?
            }
        };
        self.frame += 1;
        if over {
            self.lines.pop_front();
            (self.frame, self.from) = (0, self.pointer);
        }
        Ok(asked)
    }

    fn no_place(&self, place: &str) -> ScriptError {
        ScriptError::NoPlace { script: self.name.clone(), place: place.to_owned() }
    }

    fn move_to(&mut self, at: Pos2, asked: &mut Asked) {
        self.pointer = at;
        asked.events.push(Event::PointerMoved(at));
    }

    fn button(&self, pressed: bool, asked: &mut Asked) {
        let (pos, button, modifiers) = (self.pointer, PointerButton::Primary, Modifiers::NONE);
        asked.events.push(Event::PointerButton { pos, button, pressed, modifiers });
    }

    /// Sections open and lists scroll first: a place counts from when it has been seen for as long as the pointer takes to it.
    fn click(&mut self, place: &str, at: Option<Pos2>, asked: &mut Asked) -> Result<bool, ScriptError> {
        let Some(at) = at else {
            return if self.frame > LOST { Err(self.no_place(place)) } else { Ok(false) };
        };
        let way = WAY * 2;
        if self.frame < way {
            self.move_to(self.from.lerp(at, share(self.frame + 1, way)), asked);
        } else if self.frame == way + 2 {
            self.move_to(at, asked);
            self.button(true, asked);
        } else if self.frame == way + 4 {
            self.button(false, asked);
        }
        Ok(self.frame >= way + 8)
    }

    fn drag(
        &mut self,
        place: &str,
        at: Option<Rect>,
        [from, to]: [f32; 2],
        asked: &mut Asked,
    ) -> Result<bool, ScriptError> {
        let Some(at) = at else {
            return if self.frame > LOST { Err(self.no_place(place)) } else { Ok(false) };
        };
        let along = |share: f32| Pos2::new(at.left() + share * at.width(), at.center().y);
        let way = WAY * 2;
        match self.frame {
            frame if frame < way => self.move_to(self.from.lerp(along(from), share(frame + 1, way)), asked),
            frame if frame == way + 2 => {
                self.move_to(along(from), asked);
                self.button(true, asked);
            }
            frame if frame > way + 2 && frame <= way + 2 + DRAG => {
                self.move_to(along(from + (to - from) * share(frame - way - 2, DRAG)), asked);
            }
            frame if frame == way + 4 + DRAG => self.button(false, asked),
            _ => {}
        }
        Ok(self.frame >= way + 10 + DRAG)
    }
}

fn share(frame: u32, of: u32) -> f32 {
    frame as f32 / of as f32
}

fn read(line: &str) -> Option<Line> {
    let (word, rest) = line.split_once(' ').map_or((line, ""), |(word, rest)| (word, rest.trim()));
    let plain = |line| rest.is_empty().then_some(line);
    match word {
        "wait" => rest.parse().ok().map(Line::Wait),
        "panel" => plain(Line::Panel),
        "undo" => plain(Line::Edit(Edit::Undo)),
        "redo" => plain(Line::Edit(Edit::Redo)),
        "save" => plain(Line::Edit(Edit::Save)),
        "click" if !rest.is_empty() => Some(Line::Click(rest.to_owned())),
        "choose" if !rest.is_empty() => Some(Line::Choose(rest.to_owned())),
        "drag" => {
            let mut words = rest.rsplitn(3, ' ');
            let number =
                |word: Option<&str>| word.and_then(|word| f32::from_str(word).ok()).filter(|n| n.is_finite());
            let (to, from) = (number(words.next())?, number(words.next())?);
            Some(Line::Drag(words.next()?.to_owned(), [from, to]))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_or_named() {
        let script = Script::parse(
            "wait 3 # a while\n\npanel\ndrag sea.wind_speed 0.1 0.4\nclick preset gale\nsave",
            "s",
        );
        let wanted = [
            Line::Wait(3),
            Line::Panel,
            Line::Drag("sea.wind_speed".to_owned(), [0.1, 0.4]),
            Line::Click("preset gale".to_owned()),
            Line::Edit(Edit::Save),
        ];
        assert_eq!(script.unwrap().lines, wanted);
        for wrong in ["wait", "wait x", "panel now", "click", "drag a 1", "drag a b c", "jump"] {
            let error = Script::parse(&format!("# one\n{wrong}"), "s").unwrap_err().to_string();
            assert!(error.starts_with(&format!("s:2: {wrong:?} is none of: ")), "{error}");
        }
    }

    #[test]
    fn a_place_that_never_comes_is_told() {
        let mut panel = Panel::new(String::new(), None).unwrap();
        let mut script = Script::parse("click nowhere", "s").unwrap();
        let error = (0..=LOST + 1).find_map(|_| script.go_on(&mut panel, |_| None).err());
        assert_eq!(error.unwrap().to_string(), "s: the panel shows no nowhere");
    }
}
