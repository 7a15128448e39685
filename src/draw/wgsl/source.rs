//! A shader's text, with what it includes: in which file a line is.

use super::Failure;
use naga::{Block, Module, Statement};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// A shader's text with its includes, and where each line came from.
#[derive(Default)]
pub struct Source {
    /// All of it.
    pub text: String,
    lines: Vec<(PathBuf, usize)>,
    /// The files, in the order in which they were met.
    pub seen: Vec<PathBuf>,
}

impl Source {
    /// Of `file`, with other files included `instead` of some.
    pub fn read(file: &Path, instead: &[(&str, &str)]) -> Result<Self, Failure> {
        let mut source = Self::default();
        source.add(file, instead)?;
        Ok(source)
    }

    fn add(&mut self, file: &Path, instead: &[(&str, &str)]) -> Result<(), Failure> {
        if self.seen.iter().any(|seen| seen == file) {
            return Ok(());
        }
        self.seen.push(file.to_owned());
        let text = fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
        for (index, line) in text.lines().enumerate() {
            match line.trim().strip_prefix("#include ") {
                Some(name) => {
                    let name = name.trim().trim_matches('"');
                    let name = instead.iter().find(|(from, _)| *from == name).map_or(name, |(_, to)| *to);
                    let folder = file.parent().unwrap_or(Path::new(""));
                    self.add(&folder.join(name), instead)?;
                }
                None => {
                    self.text.push_str(line);
                    self.text.push('\n');
                    self.lines.push((file.to_owned(), index + 1));
                }
            }
        }
        Ok(())
    }

    /// The files whose functions `block` calls, and those that they call.
    pub fn reach(&self, module: &Module, block: &Block, files: &mut BTreeSet<PathBuf>) {
        for statement in block {
            match statement {
                Statement::Call { function, .. } => {
                    let line = module.functions.get_span(*function).location(&self.text).line_number as usize;
                    files.extend(self.lines.get(line - 1).map(|(file, _)| file.clone()));
                    self.reach(module, &module.functions[*function].body, files);
                }
                Statement::Block(block) => self.reach(module, block, files),
                Statement::If { accept, reject, .. } => {
                    self.reach(module, accept, files);
                    self.reach(module, reject, files);
                }
                Statement::Switch { cases, .. } => {
                    cases.iter().for_each(|case| self.reach(module, &case.body, files));
                }
                Statement::Loop { body, continuing, .. } => {
                    self.reach(module, body, files);
                    self.reach(module, continuing, files);
                }
                _ => {}
            }
        }
    }

    /// "shaders/ocean.wgsl:12:5: message", from a place in the joined text.
    pub fn error(&self, location: Option<naga::SourceLocation>, message: &str) -> Failure {
        let at = location.and_then(|at| {
            let (file, line) = self.lines.get(at.line_number as usize - 1)?;
            Some(format!("{}:{line}:{}: ", file.display(), at.line_position))
        });
        let file = self.seen.first().map_or_else(String::new, |file| format!("{}: ", file.display()));
        format!("{}{message}", at.unwrap_or(file))
    }
}
