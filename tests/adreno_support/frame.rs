//! The model of a headset's frame in docs/quest.md, and how many waves that are formulas it leaves time for.
use super::Cost;
use std::fmt::Write as _;

/// A headset as it begins: `host::standalone::TABLE`.
pub struct Headset {
    pub name: &'static str,
    pub refresh_rate: u32,
    /// Pixels of an eye.
    eye: [f64; 2],
    /// Million instructions a second at its peak.
    peak: f64,
    /// Vertices of a view at its quality, from docs/frame-cost.md.
    vertices: f64,
}

/// In the order of `CHIPS`: Quest 3 at high, Quest 2 at medium.
pub const HEADSETS: [Headset; 2] = [
    Headset {
        name: "Quest 3",
        refresh_rate: 90,
        eye: [1680.0, 1760.0],
        peak: 2.5 * 1024.0 * 587.0,
        vertices: 224_234.0,
    },
    Headset {
        name: "Quest 2",
        refresh_rate: 72,
        eye: [1440.0, 1584.0],
        peak: 1024.0 * 587.0,
        vertices: 51_363.0,
    },
];

/// Share of its peak that a GPU reaches, by the worse and the better guess.
pub const REACHED: [f64; 2] = [0.2, 0.5];

fn cost<'a>(costs: &'a [Cost], pipeline: &str, stage: &str, cascades: usize) -> &'a Cost {
    let is_it = |cost: &&Cost| {
        (cost.pipeline.as_str(), cost.stage.as_str(), cost.cascades) == (pipeline, stage, cascades)
    };
    costs.iter().find(is_it).expect("a cost that was measured")
}

impl Headset {
    /// Most waves with which a frame is in time, where the GPU reaches this share of its peak: on a sea of so many cascades.
    fn waves(&self, costs: &[Cost], cascades: usize, reached: f64) -> usize {
        let pixels = 2.0 * self.eye[0] * self.eye[1] * 0.85;
        let fragments = pixels * 0.6 * 1.3;
        let vertices = 2.0 * self.vertices * 1.3 * 2.0;
        let [of_fragment, of_vertex] =
            ["fragment", "vertex"].map(|stage| cost(costs, "analytic_ocean.vertex_main", stage, cascades));
        assert!(of_fragment.around[1] > 0 && of_vertex.around[1] > 0, "a wave costs something");
        let [wave, rest] = [
            |cost: &Cost| cost.around[1] as f64,
            // The loop is counted once, all kinds of waves with it.
            |cost: &Cost| (cost.instructions - cost.around[1]) as f64,
        ]
        .map(|count| fragments * count(of_fragment) + vertices * count(of_vertex));
        let sky = pixels * 0.4 * cost(costs, "sky.vertex_main", "fragment", 3).instructions as f64;
        let all = reached * self.peak * 1e6 / f64::from(self.refresh_rate);
        ((all - sky - rest) / wave).max(0.0) as usize
    }

    /// The same on any sea that a headset shows.
    pub fn fewest_waves(&self, costs: &[Cost], reached: f64) -> usize {
        (0..=3).map(|cascades| self.waves(costs, cascades, reached)).min().unwrap_or_default()
    }

    /// A row of the table: what a wave takes, and how many there may be.
    pub fn row(&self, costs: &[Cost]) -> String {
        let Self { name, refresh_rate, .. } = self;
        let mut row = format!("| {name}, {refresh_rate} Hz |");
        for stage in ["vertex", "fragment"] {
            for way in 0..2 {
                let most = (0..=3)
                    .map(|cascades| cost(costs, "analytic_ocean.vertex_main", stage, cascades).around[way])
                    .max();
                let _never = write!(row, " {} |", most.unwrap_or_default());
            }
        }
        for reached in REACHED {
            let _never = write!(row, " {} |", self.fewest_waves(costs, reached));
        }
        row
    }
}
