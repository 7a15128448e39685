//! Shaders compiled anew from their folder while Swell runs, each in place of the one that was built in.

use super::shaders::{BINDINGS, MODULES, UNIFORM_SIZES};
use super::wgsl::{self, Reflection};
use crate::gpu::{BindingKind, Replacements};
use std::collections::HashMap;
use std::path::Path;

/// Compiles the shaders in `folder`, all of them: what stands in for each module that was built in.
///
/// # Errors
/// The first fault, with file, line and column; a module that is gone, or bindings that Swell was not built with.
pub fn compile_shaders(folder: &Path) -> Result<Replacements, String> {
    let mut reflection = Reflection::default();
    let mut entries = HashMap::new();
    for file in wgsl::files(folder)? {
        for entry in wgsl::compile(&file, &mut reflection)? {
            entries.insert(format!("{}.{}", entry.stem, entry.name), entry);
        }
    }
    check(folder, &reflection)?;
    let mut replacements = Replacements::new();
    for &(name, cascades, built_in) in MODULES {
        let entry = entries.get(name).ok_or_else(|| format!("{}: {name} is gone", folder.display()))?;
        let (first, variants) = (entry.first, &entry.variants);
        let built = MODULES.iter().filter(|(other, ..)| *other == name).count();
        if variants.len() > built {
            let wants = "looks at the number of cascades, which it did not: this wants a build";
            return Err(format!("{}: {name} {wants}", folder.display()));
        }
        // One that does not look at that number any more is the same for each.
        let index = (cascades.saturating_sub(first) as usize).min(variants.len() - 1);
        if let Some(variant) = variants.get(index) {
            replacements.insert(built_in, variant.bytes());
        }
    }
    Ok(replacements)
}

/// Layouts and the uniform block are Rust's: shaders that want others want a build.
fn check(folder: &Path, reflection: &Reflection) -> Result<(), String> {
    for (name, size) in UNIFORM_SIZES {
        if reflection.uniform_sizes.get(*name) != Some(size) {
            let block = format!("the uniform block {} has another size", name.to_lowercase());
            return Err(format!("{}: {block}: this wants a build", folder.display()));
        }
    }
    let known = |number: u32, kind: &str| {
        BINDINGS.iter().any(|&(own, own_kind)| {
            own == number
                && kind
                    == match own_kind {
                        BindingKind::Uniform => "Uniform",
                        BindingKind::Texture => "Texture",
                        BindingKind::Sampler => "Sampler",
                    }
        })
    };
    match reflection.bindings.iter().find(|(number, kind)| !known(**number, kind)) {
        Some((number, _)) => {
            Err(format!("{}: binding {number} is new: this wants a build", folder.display()))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn copy() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for file in wgsl::files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders")).unwrap() {
            fs::copy(&file, folder.path().join(file.file_name().unwrap())).unwrap();
        }
        folder
    }

    #[test]
    fn what_was_built_in_comes_out_the_same() {
        let folder = copy();
        let replacements = compile_shaders(folder.path()).unwrap();
        for (name, _, built_in) in MODULES {
            assert!(replacements.get(built_in).is_some_and(|new| new == built_in), "{name}");
        }
    }

    #[test]
    fn a_fault_is_told_with_its_place() {
        let folder = copy();
        let file = folder.path().join("sky.wgsl");
        let text = fs::read_to_string(&file).unwrap();
        fs::write(&file, format!("{text}\nfn broken() -> f32 {{ return vec2f(1.0); }}\n")).unwrap();
        let error = compile_shaders(folder.path()).unwrap_err();
        let line = text.lines().count() + 2;
        assert!(error.contains(&format!("sky.wgsl:{line}:")), "{error}");
    }

    #[test]
    fn bindings_that_are_new_want_a_build() {
        let folder = copy();
        let file = folder.path().join("sky.wgsl");
        let text = fs::read_to_string(&file).unwrap();
        fs::write(&file, format!("{text}\n@group(0) @binding(77) var other: sampler;\n")).unwrap();
        let error = compile_shaders(folder.path()).unwrap_err();
        assert!(error.contains("binding 77") && error.contains("wants a build"), "{error}");
    }
}
