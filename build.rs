//! Compiles `shaders/*.wgsl` to SPIR-V with naga, so that a shader that does not compile fails the build, with file and line.
//!
//! - `#include "file.wgsl"` on a line of its own takes in another file, once; errors still name the file they are in.
//! - A shader with `override CASCADES` is compiled once for each number of cascades: naga resolves overrides before it
//!   writes, as SPIR-V gets no specialisation constants from it.
//! - A shader is compiled anew for each of [`FLAVOURS`], where other files take the place of some that it includes.
//! - Each module holds one entry point, because Adreno's compilers have failed on several.
//! - How often each variant looks into a texture is counted, for docs/frame-cost.md and its test.
//! - Bindings and the size of the uniform block are reflected into Rust, so no table is kept by hand.
//!
//! Output: `$OUT_DIR/shaders.rs` and the `.spv` files it includes. See docs/shaders.md.

use naga::back::{pipeline_constants::process_overrides, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Block, Expression, Function, Literal, Module, Statement, TypeInner};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, process};

/// As `sea::MAX_CASCADES`.
const MAX_CASCADES: u32 = 4;

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

type Failure = String;

fn main() {
    println!("cargo::rerun-if-changed=shaders");
    println!("cargo::rerun-if-changed=build.rs");
    if let Err(failure) = run() {
        for line in failure.lines() {
            println!("cargo::error={line}");
        }
        process::exit(1);
    }
}

fn run() -> Result<(), Failure> {
    let out = PathBuf::from(env::var("OUT_DIR").map_err(|e| e.to_string())?);
    let mut files: Vec<PathBuf> = fs::read_dir("shaders")
        .map_err(|e| format!("shaders: {e}"))?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"))
        .collect();
    files.sort();
    let mut generated = String::new();
    let mut reflection = Reflection::default();
    for file in files {
        let plain = Source::read(&file, &[])?;
        if !plain.text.contains("@vertex") && !plain.text.contains("@fragment") {
            continue;
        }
        for flavour in FLAVOURS {
            let all =
                flavour.instead.iter().all(|(name, _)| plain.seen.iter().any(|seen| seen.ends_with(name)));
            if all {
                let source = Source::read(&file, flavour.instead)?;
                compile(&source, &file, &flavour, &out, &mut generated, &mut reflection)?;
            }
        }
    }
    reflection.write(&mut generated);
    fs::write(out.join("shaders.rs"), generated).map_err(|e| format!("shaders.rs: {e}"))
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
                    self.add(&Path::new("shaders").join(name), instead)?;
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

fn compile(
    source: &Source,
    file: &Path,
    flavour: &Flavour,
    out: &Path,
    generated: &mut String,
    reflection: &mut Reflection,
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
        let constant = format!("{stem}_{}", entry.name).to_uppercase();
        let mut modules = Vec::new();
        let first = if varies { flavour.fewest } else { 1 };
        for cascades in first..=if varies { MAX_CASCADES } else { 1 } {
            let variant = Variant::write(&module, &info, entry, varies.then_some(cascades));
            modules.push(variant.map_err(|message| source.error(None, &message))?);
        }
        // The stages that do not look at CASCADES come out the same each time: one of them will do.
        modules.dedup();
        let varies = modules.len() > 1;
        let mut variants = Vec::new();
        let fetches: Vec<String> = modules.iter().map(|variant| variant.fetches.to_string()).collect();
        for (cascades, Variant { words, .. }) in (first..).zip(modules) {
            let name = format!("{stem}_{}_{cascades}.spv", entry.name);
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
            fs::write(out.join(&name), bytes).map_err(|e| format!("{name}: {e}"))?;
            variants.push(format!("include_bytes!(concat!(env!(\"OUT_DIR\"), \"/{name}\"))"));
        }
        for (index, cascades) in (first..).take(variants.len()).enumerate() {
            let each = if varies { format!("[{index}]") } else { String::new() };
            let name = format!("{stem}.{}", entry.name);
            reflection.modules.push(format!("(\"{name}\", {cascades}, {constant}{each})"));
        }
        let about = format!("/// `{}`, `{}`", file.display(), entry.name);
        let counted = format!("/// Texture fetches of [`{constant}`], at most, each time that it runs");
        let _never = if varies {
            let (count, list, fetches) = (variants.len(), variants.join(", "), fetches.join(", "));
            writeln!(
                generated,
                "{about}, for {first} to {MAX_CASCADES} cascades.\npub static {constant}: [&[u8]; {count}] = [{list}];\n\
                 {counted}.\npub const {constant}_FETCHES: [u32; {count}] = [{fetches}];"
            )
        } else {
            writeln!(
                generated,
                "{about}.\npub static {constant}: &[u8] = {};\n\
                 {counted}.\npub const {constant}_FETCHES: u32 = {};",
                variants[0], fetches[0]
            )
        };
    }
    Ok(())
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
struct Variant {
    words: Vec<u32>,
    fetches: u32,
}

impl Variant {
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
struct Reflection {
    bindings: BTreeMap<u32, &'static str>,
    uniform_sizes: BTreeMap<String, u32>,
    modules: Vec<String>,
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

    fn write(&self, generated: &mut String) {
        let list: Vec<String> =
            self.bindings.iter().map(|(number, kind)| format!("({number}, BindingKind::{kind})")).collect();
        let sizes: String = self
            .uniform_sizes
            .iter()
            .map(|(name, size)| {
                format!(
                    "/// Bytes of the uniform block of that name.\npub const {name}_SIZE: usize = {size};\n"
                )
            })
            .collect();
        let _never = writeln!(
            generated,
            "/// Every binding of every shader.\npub static BINDINGS: &[(u32, BindingKind)] = &[{}];\n\
             {sizes}\
             /// Every module: its file and entry point, the number of cascades it is for (1 where that does not matter), SPIR-V.\n\
             pub static MODULES: &[(&str, u32, &[u8])] = &[{}];",
            list.join(", "),
            self.modules.join(", ")
        );
    }
}
