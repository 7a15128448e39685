//! `shaders/budgets.toml`: what each stage may cost.
use super::{Chip, Cost};
use serde::Deserialize;
use std::collections::BTreeMap;
use swell::sea::settings::MAX_CASCADES;

/// Most instructions, for 1, 2, 3 and 4 cascades, with a number for none before them where there may be none; or one number
/// where cascades do not matter.
type Instructions = BTreeMap<String, Vec<i64>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budgets {
    /// Mesa's version that the limits were measured with.
    pub mesa: String,
    /// Fewest waves at once, by the chip and the threads of a wave.
    pub waves: BTreeMap<String, BTreeMap<String, i64>>,
    /// The same for pipelines that need more registers, by their vertex shader: for what no headset draws by default.
    pub waves_of: BTreeMap<String, BTreeMap<String, BTreeMap<String, i64>>>,
    /// The same of pipelines for formulas.
    pub waves_of_formulas: BTreeMap<String, BTreeMap<String, i64>>,
    /// By the pipeline's vertex shader, the stage, and the chip.
    pub instructions: BTreeMap<String, BTreeMap<String, Instructions>>,
}

impl Budgets {
    pub fn read() -> Self {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/budgets.toml");
        let text = std::fs::read_to_string(file).unwrap();
        toml::from_str(&text).unwrap_or_else(|error| panic!("{file}: {error}"))
    }

    /// What is wrong with `cost`, a line each.
    pub fn faults(&self, chip: &Chip, driver: &str, cost: &Cost) -> Vec<String> {
        let Cost { pipeline, cascades, stage, .. } = cost;
        let what = format!(
            "{pipeline}'s {stage} stage with {cascades} cascades on Adreno {} ({driver}; limits in shaders/budgets.toml \
             are of Mesa {})",
            chip.name, self.mesa
        );
        let most = self.instructions.get(pipeline).and_then(|stages| stages.get(stage)?.get(chip.name));
        let most = most.and_then(|most| {
            let fewest = usize::from(most.len() <= MAX_CASCADES);
            most.get(cascades.saturating_sub(fewest)).or(most.last())
        });
        let mut faults = Vec::new();
        match most {
            None => faults.push(format!("{what}: no limit for its {} instructions", cost.instructions)),
            Some(most) if cost.instructions > *most => {
                faults.push(format!("{what}: {} instructions, at most {most}", cost.instructions));
            }
            Some(_) => {}
        }
        let formulas = if pipeline.contains("analytic_") { &self.waves_of_formulas } else { &self.waves };
        let waves = self.waves_of.get(pipeline).unwrap_or(formulas);
        let least = waves.get(chip.name).and_then(|least| least.get(&cost.width.to_string()));
        match least {
            None => faults.push(format!("{what}: no limit for waves of {} threads", cost.width)),
            Some(least) if cost.waves < *least => {
                let Cost { waves, width, .. } = cost;
                faults.push(format!("{what}: {waves} waves of {width} threads, at least {least}"));
            }
            Some(_) => {}
        }
        if cost.spills > 0 {
            faults.push(format!("{what}: {} registers spilled, at most 0", cost.spills));
        }
        faults
    }
}
