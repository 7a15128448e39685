//! Compiles `shaders/*.wgsl` to SPIR-V (`src/draw/wgsl.rs`), so that a shader that does not compile fails the build, with file and line.
//!
//! Bindings and the size of the uniform block are reflected into Rust, so no table is kept by hand.
//!
//! Output: `$OUT_DIR/shaders.rs` and the `.spv` files it includes. See docs/shaders.md.

#[path = "src/draw/wgsl.rs"]
mod wgsl;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, process};
use wgsl::{Failure, MAX_CASCADES, Reflection};

fn main() {
    println!("cargo::rerun-if-changed=shaders");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/draw/wgsl.rs");
    if let Err(failure) = run() {
        for line in failure.lines() {
            println!("cargo::error={line}");
        }
        process::exit(1);
    }
}

fn run() -> Result<(), Failure> {
    let out = PathBuf::from(env::var("OUT_DIR").map_err(|e| e.to_string())?);
    let mut generated = String::new();
    let mut reflection = Reflection::default();
    let mut modules = Vec::new();
    for file in wgsl::files(Path::new("shaders"))? {
        compile(&file, &out, &mut generated, &mut reflection, &mut modules)?;
    }
    write(&reflection, &modules, &mut generated);
    fs::write(out.join("shaders.rs"), generated).map_err(|e| format!("shaders.rs: {e}"))
}

fn compile(
    file: &Path,
    out: &Path,
    generated: &mut String,
    reflection: &mut Reflection,
    listed: &mut Vec<String>,
) -> Result<(), Failure> {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    for entry in wgsl::compile(file, reflection)? {
        let constant = format!("{stem}_{}", entry.name).to_uppercase();
        let modules = entry.variants;
        let varies = modules.len() > 1;
        let mut variants = Vec::new();
        let fetches: Vec<String> = modules.iter().map(|variant| variant.fetches.to_string()).collect();
        for (cascades, variant) in (1..).zip(&modules) {
            let name = format!("{stem}_{}_{cascades}.spv", entry.name);
            fs::write(out.join(&name), variant.bytes()).map_err(|e| format!("{name}: {e}"))?;
            variants.push(format!("include_bytes!(concat!(env!(\"OUT_DIR\"), \"/{name}\"))"));
        }
        for cascades in 1..=variants.len() {
            let each = if varies { format!("[{}]", cascades - 1) } else { String::new() };
            let name = format!("{stem}.{}", entry.name);
            listed.push(format!("(\"{name}\", {cascades}, {constant}{each})"));
        }
        let about = format!("/// `{}`, `{}`", file.display(), entry.name);
        let counted = format!("/// Texture fetches of [`{constant}`], at most, each time that it runs");
        let _never = if varies {
            let (list, fetches) = (variants.join(", "), fetches.join(", "));
            writeln!(
                generated,
                "{about}, for 1 to {MAX_CASCADES} cascades.\npub static {constant}: [&[u8]; {MAX_CASCADES}] = [{list}];\n\
                 {counted}.\npub const {constant}_FETCHES: [u32; {MAX_CASCADES}] = [{fetches}];"
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

fn write(reflection: &Reflection, modules: &[String], generated: &mut String) {
    let list: Vec<String> =
        reflection.bindings.iter().map(|(number, kind)| format!("({number}, BindingKind::{kind})")).collect();
    let _never = writeln!(
        generated,
        "/// Every binding of every shader.\npub static BINDINGS: &[(u32, BindingKind)] = &[{}];\n\
         /// Bytes of the uniform block.\npub const UNIFORM_SIZE: usize = {};\n\
         /// Every module: its file and entry point, the number of cascades it is for (1 where that does not matter), SPIR-V.\n\
         pub static MODULES: &[(&str, u32, &[u8])] = &[{}];",
        list.join(", "),
        reflection.uniform_size,
        modules.join(", ")
    );
}
