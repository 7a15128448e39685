//! What shaders cost on the GPUs of Quest's headsets, and that those take them: docs/quest.md.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
mod adreno_support;

use adreno_support::budget::Budgets;
use adreno_support::frame::{HEADSETS, REACHED};
use adreno_support::listener::{self, Listener};
use adreno_support::{CHIPS, Cost, measure, script, spirv};
use ash::vk;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use swell::draw::shaders::MODULES;
use swell::draw::{Look, Renderer, SkyMap};
use swell::gpu::{Device, DeviceNeeds, Instance, Opener, Target, TargetInfo, Validation};
use swell::scene::{Scene, Shading, Shadows, WAVE_LIMITS};
use swell::sea::settings::MAX_CASCADES;

/// Of the shipped scenes.
const USUAL_CASCADES: usize = 3;

/// Any will do: shaders are the same for all.
const FORMULAS: &str = "[sea]\nmodel = 'fbm'";

/// Run by the others, on a device that is not there.
#[test]
#[ignore = "wants scripts/adreno"]
fn compiles_every_pipeline() {
    let instance = Instance::new(Validation::Off, &[], &Listener).unwrap();
    let physical = Listener.choose(&instance, None).unwrap();
    println!("driver {} {}", physical.name, physical.driver);
    let needs = DeviceNeeds { opener: &Listener, ..DeviceNeeds::default() };
    let device = Device::new(instance, physical, &needs).unwrap();
    let extent = vk::Extent2D { width: 64, height: 64 };
    let (format, samples) = (vk::Format::R8G8B8A8_SRGB, vk::SampleCountFlags::TYPE_4);
    let eyes = Target::new(&device, TargetInfo { extent, views: 2, format, samples }).unwrap();
    let (format, samples) = (vk::Format::R16G16B16A16_SFLOAT, vk::SampleCountFlags::TYPE_1);
    let motion = Target::new(&device, TargetInfo { extent, views: 2, format, samples }).unwrap();
    let mut scene = Scene::load(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/open_ocean.toml")).unwrap();
    let sky = SkyMap::new(&scene.sky).unwrap();
    let first = scene.sea.cascades[0].clone();
    let with_and_without_shadows = |scene: &mut Scene, cascades| {
        let mut renderer = Renderer::new(&device, eyes.pass(), scene, &sky, Look::Water).unwrap();
        renderer.prepare_motion(&device, motion.pass()).unwrap();
        scene.water.shadows.shadows = Shadows::On;
        Renderer::new(&device, eyes.pass(), scene, &sky, Look::Water).unwrap();
        scene.water.shadows.shadows = Shadows::Off;
        let mut costs = listener::take(cascades);
        // With shadows some are the same as without.
        let mut told = BTreeSet::new();
        costs.retain(|cost| told.insert(cost.line()));
        costs
    };
    for cascades in 1..=MAX_CASCADES {
        scene.sea.cascades.resize(cascades, first.clone());
        for cost in with_and_without_shadows(&mut scene, cascades) {
            println!("{}", cost.line());
        }
    }
    // Formulas, and Blinn-Phong, bring stages of their own for the sea alone.
    let models = Scene::parse(FORMULAS, "formulas").unwrap().sea.models;
    let others =
        [(Shading::Physical, &models), (Shading::BlinnPhong, &Vec::new()), (Shading::BlinnPhong, &models)];
    for (shading, models) in others {
        scene.water.shading = shading;
        scene.sea.models.clone_from(models);
        for cascades in usize::from(models.is_empty())..=MAX_CASCADES {
            scene.sea.spectral = cascades > 0;
            scene.sea.cascades.resize(cascades.max(1), first.clone());
            let prefix = if shading == Shading::BlinnPhong { "phong_" } else { "analytic_" };
            for cost in with_and_without_shadows(&mut scene, cascades) {
                if cost.pipeline.starts_with(prefix) {
                    println!("{}", cost.line());
                }
            }
        }
    }
}

#[test]
fn shaders_keep_to_their_budgets() {
    let budgets = Budgets::read();
    let (mut faults, mut table) = (Vec::new(), String::new());
    let mut waves = String::from(
        "| headset | a vertex: least | most | a pixel: least | most | waves at 20 % of its peak | at 50 % |\n\
         |---|---:|---:|---:|---:|---:|---:|\n",
    );
    let mut same_mesa = true;
    for (chip, headset) in CHIPS.iter().zip(&HEADSETS) {
        let (driver, costs) = measure(chip, "compiles_every_pipeline");
        assert!(driver.contains(chip.name), "wanted Adreno {}, got {driver}", chip.name);
        same_mesa &= driver.contains(&format!("Mesa {}", budgets.mesa));
        let found: BTreeSet<&str> = costs.iter().map(|cost| cost.pipeline.as_str()).collect();
        let budgeted: BTreeSet<&str> = budgets.instructions.keys().map(String::as_str).collect();
        assert_eq!(found, budgeted, "pipelines of the renderer, and those of shaders/budgets.toml");
        faults.extend(costs.iter().flat_map(|cost| budgets.faults(chip, &driver, cost)));
        table.push_str(&rows(chip.name, chip.headset, &costs));
        let _never = writeln!(waves, "{}", headset.row(&costs));
        let limit = WAVE_LIMITS.iter().find(|limit| limit.headset == headset.name).unwrap();
        let fits = headset.fewest_waves(&costs, REACHED[1]);
        if (limit.waves, limit.refresh_rate) != (fits, headset.refresh_rate) {
            faults
                .push(format!("WAVE_LIMITS has {limit:?}, the model {fits} at {} Hz", headset.refresh_rate));
        }
    }
    println!("{table}\n{waves}");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    // Another Mesa compiles otherwise; its limits may still be kept.
    if same_mesa {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/quest.md");
        let page = std::fs::read_to_string(page).unwrap();
        for table in [table, waves] {
            assert!(page.contains(&table), "docs/quest.md ought to have:\n{table}");
        }
    }
}

/// A chip's table: with the usual number of cascades and none, and of what depends on it with the most.
fn rows(chip: &str, headset: &str, costs: &[Cost]) -> String {
    let mut table = format!(
        "| Adreno {chip}, {headset} | stage | cascades | instructions | of them nops | registers | waves x threads |\n\
         |---|---|---:|---:|---:|---:|---:|\n"
    );
    for cost in costs {
        let Cost { pipeline, cascades, stage, instructions, nops, registers, waves, width, .. } = cost;
        let varies = costs.iter().any(|other| {
            (&other.pipeline, &other.stage) == (pipeline, stage) && other.instructions != *instructions
        });
        if [0, USUAL_CASCADES].contains(cascades) || *cascades == MAX_CASCADES && varies {
            let cascades = if varies { cascades.to_string() } else { "any".to_owned() };
            let _never = writeln!(
                table,
                "| {pipeline} | {stage} | {cascades} | {instructions} | {nops} | {registers} | {waves} x {width} |"
            );
        }
    }
    table
}

/// Capabilities that any device Swell runs on has, by SPIR-V's numbers: `Shader` is every Vulkan device's (Vulkan's
/// specification, appendix "Vulkan Environment for SPIR-V", table of capabilities), `MultiView` comes with the multiview
/// feature, which Vulkan 1.1 demands and `gpu::PhysicalDevice` asks for. `MultiView` is declared in the vertex stage alone.
const CAPABILITIES: [(u32, &str); 2] = [(1, "Shader"), (4439, "MultiView")];
/// The same of extensions: multiview's is in SPIR-V's core from 1.3 on, which is Vulkan 1.1's.
const EXTENSIONS: [&str; 1] = ["SPV_KHR_multiview"];

#[test]
fn modules_hold_one_entry_point_and_ask_for_nothing_unusual() {
    for (name, cascades, bytes) in MODULES {
        let declared = spirv::declared(bytes);
        assert_eq!(declared.entry_points, 1, "{name}, {cascades} cascades: entry points");
        for capability in declared.capabilities {
            let known = CAPABILITIES.iter().any(|&(number, _)| number == capability);
            assert!(
                known,
                "{name}, {cascades} cascades: SPIR-V capability {capability}, none of {CAPABILITIES:?}"
            );
        }
        for extension in declared.extensions {
            let known = EXTENSIONS.contains(&extension.as_str());
            assert!(
                known,
                "{name}, {cascades} cascades: SPIR-V extension {extension}, none of {EXTENSIONS:?}"
            );
        }
    }
}

#[test]
fn modules_are_valid() {
    let folder = tempfile::tempdir().unwrap();
    for (name, cascades, bytes) in MODULES {
        let file = folder.path().join(format!("{name}.{cascades}.spv"));
        std::fs::write(&file, bytes).unwrap();
        let said = script().args(["--spirv-val", "--target-env", "vulkan1.1"]).arg(&file).output().unwrap();
        let text = String::from_utf8_lossy(&said.stderr);
        assert!(
            said.status.success() && said.stdout.is_empty() && text.is_empty(),
            "{name}, {cascades} cascades: {text}"
        );
    }
}
