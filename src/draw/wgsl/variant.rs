//! SPIR-V of one entry point, and what it costs in texture fetches.

use super::{Failure, describe};
use naga::back::{pipeline_constants::process_overrides, spv};
use naga::valid::ModuleInfo;
use naga::{Block, Expression, Function, Literal, Module, Statement};

/// One entry point for one number of cascades.
#[derive(PartialEq)]
pub struct Variant {
    words: Vec<u32>,
    /// Texture fetches, at most, each time that it runs.
    pub fetches: u32,
}

impl Variant {
    /// SPIR-V, the lowest byte of each word first.
    pub fn bytes(&self) -> Vec<u8> {
        self.words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    /// Of `entry` of `module`, of which `info` tells.
    pub fn write(
        module: &Module,
        info: &ModuleInfo,
        entry: &naga::EntryPoint,
        cascades: Option<u32>,
    ) -> Result<Self, Failure> {
        let mut constants = naga::back::PipelineConstants::default();
        if let Some(count) = cascades {
            constants.insert("CASCADES".to_owned(), f64::from(count));
        }
        let (module, info) = process_overrides(module, info, Some((entry.stage, &entry.name)), &constants)
            .map_err(|error| describe(&error))?;
        // The shaders are our own: no padding against hostile indices, endless loops or division by zero.
        let options = spv::Options {
            lang_version: (1, 3),
            flags: spv::WriterFlags::LABEL_VARYINGS,
            bounds_check_policies: naga::proc::BoundsCheckPolicies {
                index: naga::proc::BoundsCheckPolicy::Unchecked,
                buffer: naga::proc::BoundsCheckPolicy::Unchecked,
                image_load: naga::proc::BoundsCheckPolicy::Unchecked,
                binding_array: naga::proc::BoundsCheckPolicy::Unchecked,
            },
            force_loop_bounding: false,
            emit_int_div_checks: false,
            ..spv::Options::default()
        };
        let pipeline = spv::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.clone() };
        let words =
            spv::write_vec(&module, &info, &options, Some(&pipeline)).map_err(|error| describe(&error))?;
        let made =
            module.entry_points.iter().find(|made| made.name == entry.name && made.stage == entry.stage);
        let fetches = made.map_or(0, |made| fetches(&module, &made.function, &made.function.body));
        Ok(Self { words, fetches })
    }
}

/// Texture fetches in `block` of `function` and in what it calls. Of a branch that overrides decide, only the part that
/// is left counts; of any other both parts do; loops count once.
fn fetches(module: &Module, function: &Function, block: &Block) -> u32 {
    let within = |block: &Block| fetches(module, function, block);
    let is_fetch = |expression: &Expression| {
        matches!(expression, Expression::ImageSample { .. } | Expression::ImageLoad { .. })
    };
    let count = |statement: &Statement| match statement {
        Statement::Emit(range) => {
            range.clone().filter(|&handle| is_fetch(&function.expressions[handle])).count() as u32
        }
        Statement::Call { function: called, .. } => {
            let called = &module.functions[*called];
            fetches(module, called, &called.body)
        }
        Statement::Block(block) => within(block),
        Statement::If { condition, accept, reject } => match function.expressions[*condition] {
            Expression::Literal(Literal::Bool(true)) => within(accept),
            Expression::Literal(Literal::Bool(false)) => within(reject),
            _ => within(accept) + within(reject),
        },
        Statement::Switch { cases, .. } => cases.iter().map(|case| within(&case.body)).sum(),
        Statement::Loop { body, continuing, .. } => within(body) + within(continuing),
        _ => 0,
    };
    block.iter().map(count).sum()
}
