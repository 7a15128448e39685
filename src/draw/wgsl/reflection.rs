//! Bindings and uniform blocks, as shaders declare them.

use super::Failure;
use naga::{AddressSpace, Module, TypeInner};
use std::collections::BTreeMap;

/// What all shaders together declare.
#[derive(Default)]
pub struct Reflection {
    /// Kinds by number.
    pub bindings: BTreeMap<u32, &'static str>,
    /// Bytes of each uniform block, by its name in capitals.
    pub uniform_sizes: BTreeMap<String, u32>,
}

impl Reflection {
    /// Adds what `module` declares.
    pub fn add(&mut self, module: &Module) -> Result<(), Failure> {
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
