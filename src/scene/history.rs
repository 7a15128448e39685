//! What a document was: undo and redo, as a list of texts.
//!
//! A scene file is a few kilobytes, so each step keeps the whole text: undoing gives back the very bytes.

/// Steps that can be undone.
const DEPTH: usize = 1000;

/// A text, those before it, and those that were undone.
#[derive(Clone, Debug)]
pub struct History {
    now: String,
    past: Vec<String>,
    future: Vec<String>,
    /// What is on disk.
    saved: String,
    /// What the change that is being made is about: more of the same is one step.
    open: Option<String>,
}

impl History {
    /// Begins with the text of a file.
    pub fn new(text: String) -> Self {
        Self { saved: text.clone(), now: text, past: Vec::new(), future: Vec::new(), open: None }
    }

    /// The text as it is.
    pub fn text(&self) -> &str {
        &self.now
    }

    /// Takes `text` for a change of `about`. Until [`Self::settle`], further changes of the same, such as the rest of a
    /// slider's way, belong to the same step.
    pub fn change(&mut self, about: &str, text: String) {
        if text == self.now {
            return;
        }
        let before = std::mem::replace(&mut self.now, text);
        if self.open.as_deref() != Some(about) {
            self.past.push(before);
            if self.past.len() > DEPTH {
                self.past.remove(0);
            }
            self.open = Some(about.to_owned());
        }
        self.future.clear();
    }

    /// Ends a step: the next change is another.
    pub fn settle(&mut self) {
        self.open = None;
    }

    /// Takes back a step; whether there was one.
    pub fn undo(&mut self) -> bool {
        self.settle();
        let Some(before) = self.past.pop() else { return false };
        self.future.push(std::mem::replace(&mut self.now, before));
        true
    }

    /// Takes back an undo; whether there was one.
    pub fn redo(&mut self) -> bool {
        self.settle();
        let Some(after) = self.future.pop() else { return false };
        self.past.push(std::mem::replace(&mut self.now, after));
        true
    }

    /// Whether there is something to undo.
    pub const fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is something to redo.
    pub const fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }

    /// The text as it is has been written to disk.
    pub fn mark_saved(&mut self) {
        self.settle();
        self.saved.clone_from(&self.now);
    }

    /// Whether the file on disk says something else.
    pub fn is_changed(&self) -> bool {
        self.saved != self.now
    }

    /// The file on disk has become `text` by somebody else's hand. Taken as a step, so that it can be undone, unless it is
    /// what was written from here; whether it was taken.
    pub fn reload(&mut self, text: String) -> bool {
        if text == self.saved {
            return false;
        }
        self.settle();
        self.saved.clone_from(&text);
        self.change("file", text);
        self.settle();
        true
    }
}
