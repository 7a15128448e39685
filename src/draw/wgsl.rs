//! WGSL to SPIR-V by naga: when Swell is built, by `build.rs`, which takes this file in, and again while shaders are being changed.
//!
//! - `#include "file.wgsl"` on a line of its own takes in another file, once; errors still name the file they are in.
//! - A shader with `override CASCADES` is compiled once for each number of cascades: naga resolves overrides before it
//!   writes, as SPIR-V gets no specialisation constants from it.
//! - A shader is compiled anew for each of [`FLAVOURS`], where other files take the place of some that it includes.
//! - Each module holds one entry point, because Adreno's compilers have failed on several.
//! - How often each variant looks into a texture is counted, for docs/frame-cost.md and its test.

use naga::back::{pipeline_constants::process_overrides, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Block, Expression, Function, Literal, Module, Statement, TypeInner};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// As `sea::MAX_CASCADES`.
pub const MAX_CASCADES: u32 = 4;

/// A kind of sea or of shading: files that are included in the place of others.
struct Flavour {
    /// Before the names of what comes out.
    prefix: &'static str,
    /// What is included, and what instead. Shaders that include none of the former come without this flavour.
    instead: &'static [(&'static str, &'static str)],
    /// Fewest cascades that it is compiled for, where they matter.
    fewest: u32,
}

/// The first is the plain one.
const FLAVOURS: [Flavour; 4] = [
    Flavour { prefix: "", instead: &[], fewest: 1 },
    Flavour { prefix: "analytic_", instead: &[("waves.wgsl", "analytic.wgsl")], fewest: 0 },
    Flavour { prefix: "phong_", instead: &[("water.wgsl", "blinn_phong.wgsl")], fewest: 1 },
    Flavour {
        prefix: "analytic_phong_",
        instead: &[("waves.wgsl", "analytic.wgsl"), ("water.wgsl", "blinn_phong.wgsl")],
        fewest: 0,
    },
];

/// What is wrong, with file, line and column where they are known.
pub type Failure = String;

/// The files of `folder` that hold an entry point, and those that do not.
///
/// # Errors
/// The folder cannot be read.
pub fn files(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .map_err(|e| format!("{}: {e}", folder.display()))?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"))
        .collect();
    files.sort();
    Ok(files)
}

/// One entry point of a file, in one flavour.
pub struct Entry {
    /// The file's name without its ending, after the flavour's prefix.
    pub stem: String,
    /// Its name.
    pub name: String,
    /// The number of cascades that the first variant is for.
    pub first: u32,
    /// For each number of cascades from `first`, or one where they make no difference.
    pub variants: Vec<Variant>,
}

/// Compiles every entry point of `file` in every flavour, none where it has none, and tells `reflection` what it declares.
///
/// # Errors
/// The file cannot be read, or naga refuses it.
pub fn compile(file: &Path, reflection: &mut Reflection) -> Result<Vec<Entry>, Failure> {
    let plain = Source::read(file, &[])?;
    if !plain.text.contains("@vertex") && !plain.text.contains("@fragment") {
        return Ok(Vec::new());
    }
    let mut entries = Vec::new();
    for flavour in &FLAVOURS {
        if flavour.instead.iter().all(|(name, _)| plain.seen.iter().any(|seen| seen.ends_with(name))) {
            let source = Source::read(file, flavour.instead)?;
            compile_flavour(&source, file, flavour, reflection, &mut entries)?;
        }
    }
    Ok(entries)
}

fn compile_flavour(
    source: &Source,
    file: &Path,
    flavour: &Flavour,
    reflection: &mut Reflection,
    entries: &mut Vec<Entry>,
) -> Result<(), Failure> {
    let module = naga::front::wgsl::parse_str(&source.text)
        .map_err(|error| source.error(error.location(&source.text), &describe(&error)))?;
    let capabilities = Capabilities::MULTIVIEW;
    let info = Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .map_err(|error| source.error(error.location(&source.text), &describe(error.as_inner())))?;
    reflection.add(&module).map_err(|message| source.error(None, &message))?;
    let stem = format!("{}{}", flavour.prefix, file.file_stem().unwrap_or_default().to_string_lossy());
    let varies = module.overrides.iter().any(|(_, o)| o.name.as_deref() == Some("CASCADES"));
    for entry in &module.entry_points {
        // Stages to which the flavour makes no difference are the plain one's.
        let mut reached = BTreeSet::new();
        source.reach(&module, &entry.function.body, &mut reached);
        if !flavour.instead.iter().all(|(_, name)| reached.iter().any(|file| file.ends_with(name))) {
            continue;
        }
        let first = if varies { flavour.fewest } else { 1 };
        let mut variants = Vec::new();
        for cascades in first..=if varies { MAX_CASCADES } else { 1 } {
            let variant = Variant::write(&module, &info, entry, varies.then_some(cascades));
            variants.push(variant.map_err(|message| source.error(None, &message))?);
        }
        // The stages that do not look at CASCADES come out the same each time: one of them will do.
        variants.dedup();
        entries.push(Entry { stem: stem.clone(), name: entry.name.clone(), first, variants });
    }
    Ok(())
}

/// A shader's text with its includes, and where each line came from.
#[derive(Default)]
struct Source {
    text: String,
    lines: Vec<(PathBuf, usize)>,
    seen: Vec<PathBuf>,
}

impl Source {
    fn read(file: &Path, instead: &[(&str, &str)]) -> Result<Self, Failure> {
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
    fn reach(&self, module: &Module, block: &Block, files: &mut BTreeSet<PathBuf>) {
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
    fn error(&self, location: Option<naga::SourceLocation>, message: &str) -> Failure {
        let at = location.and_then(|at| {
            let (file, line) = self.lines.get(at.line_number as usize - 1)?;
            Some(format!("{}:{line}:{}: ", file.display(), at.line_position))
        });
        let file = self.seen.first().map_or_else(String::new, |file| format!("{}: ", file.display()));
        format!("{}{message}", at.unwrap_or(file))
    }
}

/// An error with the chain of its causes on one line.
fn describe(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let _never = write!(text, ": {error}");
        cause = error.source();
    }
    text
}

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

    fn write(
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

/// What all shaders together declare.
#[derive(Default)]
pub struct Reflection {
    /// Kinds by number.
    pub bindings: BTreeMap<u32, &'static str>,
    /// Bytes of each uniform block, by its name in capitals.
    pub uniform_sizes: BTreeMap<String, u32>,
}

impl Reflection {
    fn add(&mut self, module: &Module) -> Result<(), Failure> {
        for (_, variable) in module.global_variables.iter() {
            let Some(binding) = &variable.binding else { continue };
            let name = variable.name.as_deref().unwrap_or("?");
            if binding.group != 0 {
                return Err(format!("{name}: group {} is not 0, the only one there is", binding.group));
            }
            let inner = &module.types[variable.ty].inner;
            let kind = match (variable.space, inner) {
                (AddressSpace::Uniform, TypeInner::Struct { span, .. }) => {
                    self.uniform_sizes.insert(name.to_uppercase(), *span);
                    "Uniform"
                }
                (_, TypeInner::Image { .. }) => "Texture",
                (_, TypeInner::Sampler { .. }) => "Sampler",
                _ => return Err(format!("{name}: only uniform structs, textures and samplers can be bound")),
            };
            if *self.bindings.entry(binding.binding).or_insert(kind) != kind {
                return Err(format!(
                    "{name}: binding {} is something else in another shader",
                    binding.binding
                ));
            }
        }
        Ok(())
    }
}
