//! `swell query`.
use super::shared::SceneFile;
use clap::Args;
use std::io::{BufWriter, stdout};
use swell::commands::query::{Coordinates, Point};
use swell::commands::{self, CommandError};

#[derive(Args)]
pub struct Query {
    #[command(flatten)]
    scene: SceneFile,
    /// When, seconds.
    #[arg(long, allow_negative_numbers = true)]
    time: f64,
    /// The surface above or below this point of the world; may be given many times.
    #[arg(long, value_name = "X,Z", allow_hyphen_values = true)]
    at: Vec<Coordinates>,
    /// The water that rests at this point; may be given many times.
    #[arg(long, value_name = "X,Z", allow_hyphen_values = true)]
    rest: Vec<Coordinates>,
}

impl Query {
    /// Does it; `order` is the command line as it was.
    pub fn run(self, order: &[String]) -> Result<(), CommandError> {
        let (mut at, mut rest) = (self.at.into_iter(), self.rest.into_iter());
        // clap sorts values by option; answers come in the order of the questions.
        let points: Vec<Point> = order
            .iter()
            .filter_map(|word| match word.split('=').next() {
                Some("--at") => at.next().map(|point| Point::At(point.0)),
                Some("--rest") => rest.next().map(|point| Point::Rest(point.0)),
                _ => None,
            })
            .collect();
        if points.is_empty() {
            return Err(CommandError::Usage("no point to ask about: give --at X,Z or --rest X,Z".to_owned()));
        }
        if !(-1e9..=1e9).contains(&self.time) {
            return Err(CommandError::Usage(format!(
                "--time {} is out of range: -1e9 to 1e9 seconds",
                self.time
            )));
        }
        Ok(commands::query(&self.scene.load()?, self.time, &points, BufWriter::new(stdout().lock()))?)
    }
}
