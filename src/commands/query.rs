//! `swell query`: the surface at points, as JSON.
use crate::jobs::{JobsError, Workers};
use crate::scene::Scene;
use crate::sea::{Query, Sea, SeaError};
use serde::Serialize;
use std::io::{self, Write};
use std::str::FromStr;

/// A point of the sea's plane to ask about, world (x, z) in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Point {
    /// The surface above or below it (`--at`).
    At([f64; 2]),
    /// The point of the surface that rests at it (`--rest`).
    Rest([f64; 2]),
}

/// Two coordinates, as `X,Z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates(pub [f64; 2]);

impl FromStr for Coordinates {
    type Err = String;

    fn from_str(given: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.abs() <= 1e9);
        given.split_once(',').and_then(|(x, z)| Some(Self([number(x)?, number(z)?]))).ok_or_else(|| {
            format!("{given:?} is not X,Z: two numbers of metres, -1e9 to 1e9, such as 12.5,-3")
        })
    }
}

/// Errors of queries.
#[derive(Debug, thiserror::Error)]
pub enum QueryError {
    /// Building the sea or stepping it to the time.
    #[error(transparent)]
    Sea(#[from] SeaError),
    /// Starting threads.
    #[error(transparent)]
    Jobs(#[from] JobsError),
    /// The answers could not be written.
    #[error("cannot write the answers: {0}")]
    Write(#[from] io::Error),
}

/// One line of the answer. Lengths are metres, axes the world's.
#[derive(Serialize)]
struct Answer {
    time: f64,
    position: [f64; 3],
    height: f64,
    normal: [f64; 3],
    displacement: [f64; 3],
    foam: f64,
    rest: [f64; 2],
    /// Horizontal distance between the point asked for and the one found.
    residual: f64,
}

/// Writes one JSON object a line for each of `points`, in their order: `time` in seconds, `position` (x, y, z) and
/// `height` in metres, the unit `normal`, `displacement` from the `rest` position (x, z), `foam` from 0 to 1, and
/// `residual`, the horizontal distance in metres between the point asked for and the one found.
///
/// # Errors
/// A time that is not finite, a sea that cannot be built, output that cannot be written.
pub fn query(scene: &Scene, time: f64, points: &[Point], mut out: impl Write) -> Result<(), QueryError> {
    let workers = Workers::new(0)?;
    let maps = workers.run(|| {
        let mut sea = Sea::new(&scene.sea)?;
        let mut maps = sea.new_maps();
        sea.step(time, &mut maps)?;
        Ok::<_, SeaError>(maps)
    })?;
    let sea = Query::new(&maps);
    for point in points {
        let surface = match *point {
            Point::At([x, z]) => sea.above(x, z),
            Point::Rest([x, z]) => sea.at_rest(x, z),
        };
        let answer = Answer {
            time,
            position: surface.position,
            height: surface.height(),
            normal: surface.normal,
            displacement: surface.displacement,
            foam: surface.foam,
            rest: surface.rest,
            residual: surface.residual,
        };
        serde_json::to_writer(&mut out, &answer).map_err(io::Error::from)?;
        out.write_all(b"\n")?;
    }
    Ok(out.flush()?)
}
