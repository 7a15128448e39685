//! Where in a scene file a section is: `sea.cascade[1]`.
use std::fmt;

/// The way to a table: names, each with a number where there are several tables of that name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Address(Vec<(String, Option<usize>)>);

impl Address {
    /// The top of the file.
    pub const fn root() -> Self {
        Self(Vec::new())
    }

    /// The table `name` in this one.
    #[must_use]
    pub fn table(&self, name: &str) -> Self {
        self.step(name, None)
    }

    /// The table `index`, from 0, of the array `name` in this one.
    #[must_use]
    pub fn element(&self, name: &str, index: usize) -> Self {
        self.step(name, Some(index))
    }

    fn step(&self, name: &str, index: Option<usize>) -> Self {
        let mut steps = self.0.clone();
        steps.push((name.to_owned(), index));
        Self(steps)
    }

    /// The table around this one.
    #[must_use]
    pub fn parent(&self) -> Self {
        Self(self.0[..self.0.len().saturating_sub(1)].to_vec())
    }

    /// Names and numbers, from the top.
    pub(super) fn steps(&self) -> &[(String, Option<usize>)] {
        &self.0
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, (name, index)) in self.0.iter().enumerate() {
            let dot = if at == 0 { "" } else { "." };
            write!(f, "{dot}{name}")?;
            if let Some(index) = index {
                write!(f, "[{index}]")?;
            }
        }
        Ok(())
    }
}
