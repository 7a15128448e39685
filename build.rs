//! Compiles `shaders/*.wgsl` to SPIR-V (`src/draw/wgsl/`), so that a shader that does not compile fails the build, with file and line.
//!
//! Bindings and sizes of uniform blocks are reflected into Rust, so no table is kept by hand.
//!
//! Output: `$OUT_DIR/shaders.rs` and the `.spv` files it includes. See docs/shaders.md.

#[path = "src/draw/wgsl/mod.rs"]
mod wgsl;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, process};
use wgsl::{Entry, Failure, MAX_CASCADES, Reflection};

fn main() {
    println!("cargo::rerun-if-changed=shaders");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/draw/wgsl");
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
    for Entry { stem, name: entry, first, variants: modules } in wgsl::compile(file, reflection)? {
        let constant = format!("{stem}_{entry}").to_uppercase();
        let varies = modules.len() > 1;
        let mut variants = Vec::new();
        let fetches: Vec<String> = modules.iter().map(|variant| variant.fetches.to_string()).collect();
        for (cascades, variant) in (first..).zip(&modules) {
            let name = format!("{stem}_{entry}_{cascades}.spv");
            fs::write(out.join(&name), variant.bytes()).map_err(|e| format!("{name}: {e}"))?;
            variants.push(format!("include_bytes!(concat!(env!(\"OUT_DIR\"), \"/{name}\"))"));
        }
        for (index, cascades) in (first..).take(variants.len()).enumerate() {
            let each = if varies { format!("[{index}]") } else { String::new() };
            listed.push(format!("(\"{stem}.{entry}\", {cascades}, {constant}{each})"));
        }
        let about = format!("/// `{}`, `{entry}`", file.display());
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

fn write(reflection: &Reflection, modules: &[String], generated: &mut String) {
    let list: Vec<String> =
        reflection.bindings.iter().map(|(number, kind)| format!("({number}, BindingKind::{kind})")).collect();
    for (name, size) in &reflection.uniform_sizes {
        let about = "/// Bytes of the uniform block of that name.";
        let _never = writeln!(generated, "{about}\npub const {name}_SIZE: usize = {size};");
    }
    let sizes: Vec<String> =
        reflection.uniform_sizes.iter().map(|(name, size)| format!("(\"{name}\", {size})")).collect();
    let _never = writeln!(
        generated,
        "/// Every binding of every shader.\npub static BINDINGS: &[(u32, BindingKind)] = &[{}];\n\
         /// Every uniform block and its bytes.\npub static UNIFORM_SIZES: &[(&str, u32)] = &[{}];\n\
         /// Every module: its file and entry point, the number of cascades it is for (1 where that does not matter), SPIR-V.\n\
         pub static MODULES: &[(&str, u32, &[u8])] = &[{}];",
        list.join(", "),
        sizes.join(", "),
        modules.join(", ")
    );
}
