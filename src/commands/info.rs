//! `swell info`: the machine's Vulkan devices, its OpenXR runtime and headset, and the scene in a few numbers.

use super::{CommandError, SceneSummary};
use crate::gpu::{Directly, GpuError, Instance, PhysicalDevice, Validation, version};
use crate::host::HostError;
use crate::scene::Scene;
use crate::xr;
use serde::Serialize;
use std::io::{self, Write};

#[derive(Serialize)]
struct Report<'a> {
    swell: &'static str,
    devices: Vec<DeviceSummary>,
    /// Why there is no usable device, where there is none.
    problem: Option<String>,
    openxr: XrSummary,
    scene: &'a SceneSummary,
}

/// The runtime and its headset; the fields are empty where there is none, and `problem` says why.
#[derive(Default, Serialize)]
struct XrSummary {
    runtime: Option<String>,
    headset: Option<String>,
    /// Pixels of a view, as the runtime recommends.
    recommended: Option<[u32; 2]>,
    /// Pixels of a view at most.
    most: Option<[u32; 2]>,
    problem: Option<String>,
    /// Extensions that Swell knows of.
    extensions: Vec<XrExtension>,
}

#[derive(Serialize)]
struct XrExtension {
    name: &'static str,
    purpose: &'static str,
    found: bool,
}

#[derive(Serialize)]
struct DeviceSummary {
    name: String,
    kind: String,
    driver: String,
    vulkan: String,
    /// What Swell needs and this device has not; empty for a usable one.
    lacks: Vec<String>,
    wireframe: bool,
    /// The one that is used when none is named.
    chosen: bool,
    /// Optional extensions that Swell knows of.
    extensions: Vec<Extension>,
}

#[derive(Serialize)]
struct Extension {
    name: &'static str,
    found: bool,
}

/// Extensions Swell uses where they are, or will.
const KNOWN: [&str; 5] = [
    "VK_KHR_driver_properties",
    "VK_KHR_swapchain",
    "VK_EXT_fragment_density_map",
    "VK_KHR_fragment_shading_rate",
    "VK_KHR_external_semaphore_fd",
];

/// Tells about devices and `scene` on `out`, as text or as JSON.
///
/// # Errors
/// No usable device: told on `out` like everything else, and returned so that scripts can see it.
pub fn info(scene: &Scene, json: bool, mut out: impl Write) -> Result<(), CommandError> {
    let scene = SceneSummary::new(scene);
    let (devices, problem) = match devices() {
        Ok((devices, problem)) => (devices, problem),
        Err(problem) => (Vec::new(), Some(problem)),
    };
    let report = Report {
        swell: env!("CARGO_PKG_VERSION"),
        devices,
        problem: problem.as_ref().map(ToString::to_string),
        openxr: openxr(),
        scene: &scene,
    };
    let written = if json {
        serde_json::to_writer_pretty(&mut out, &report).map_err(io::Error::from).and_then(|()| writeln!(out))
    } else {
        write_text(&report, &mut out)
    };
    written.map_err(CommandError::Answer)?;
    problem.map_or(Ok(()), |problem| Err(HostError::from(problem).into()))
}

type Devices = (Vec<DeviceSummary>, Option<GpuError>);

fn devices() -> Result<Devices, GpuError> {
    let instance = Instance::new(Validation::Off, &[], &Directly)?;
    let all = PhysicalDevice::all(&instance)?;
    let chosen = PhysicalDevice::choose(&instance, None);
    let summary = |device: PhysicalDevice| DeviceSummary {
        chosen: chosen.as_ref().is_ok_and(|chosen| chosen.raw == device.raw),
        kind: format!("{:?}", device.kind).to_lowercase(),
        vulkan: version(device.api_version),
        extensions: KNOWN
            .map(|name| Extension { name, found: device.extensions.iter().any(|have| have == name) })
            .into(),
        name: device.name,
        driver: device.driver,
        lacks: device.lacks,
        wireframe: device.wireframe,
    };
    let devices = all.into_iter().map(summary).collect();
    Ok((devices, chosen.err()))
}

/// No runtime is no failure: most machines have none.
fn openxr() -> XrSummary {
    let about = match xr::about() {
        Ok(about) => about,
        Err(problem) => return XrSummary { problem: Some(problem.to_string()), ..XrSummary::default() },
    };
    let extensions = about.extensions.into_iter();
    let extensions = extensions.map(|(name, purpose, found)| XrExtension { name, purpose, found }).collect();
    let summary = XrSummary { runtime: Some(about.runtime), extensions, ..XrSummary::default() };
    match about.headset {
        Ok((headset, size)) => XrSummary {
            headset: Some(headset),
            recommended: Some(size.recommended),
            most: Some(size.most),
            ..summary
        },
        Err(problem) => XrSummary { problem: Some(problem.to_string()), ..summary },
    }
}

fn write_openxr(openxr: &XrSummary, out: &mut impl Write) -> io::Result<()> {
    if let Some(runtime) = &openxr.runtime {
        writeln!(out, "OpenXR runtime: {runtime}")?;
    }
    if let (Some(headset), Some([width, height]), Some(most)) =
        (&openxr.headset, openxr.recommended, openxr.most)
    {
        writeln!(out, "    headset: {headset}, {width}x{height} an eye, at most {}x{}", most[0], most[1])?;
    }
    if let Some(problem) = &openxr.problem {
        writeln!(out, "OpenXR: {problem}")?;
    }
    for XrExtension { name, purpose, found } in &openxr.extensions {
        writeln!(out, "    {} {name}: {purpose}", if *found { "found  " } else { "missing" })?;
    }
    Ok(())
}

fn write_text(report: &Report<'_>, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "swell {}", report.swell)?;
    for device in &report.devices {
        let mark = if device.chosen { "*" } else { " " };
        writeln!(
            out,
            "{mark} {} ({}), driver {}, Vulkan {}",
            device.name, device.kind, device.driver, device.vulkan
        )?;
        for lack in &device.lacks {
            writeln!(out, "    lacks {lack}")?;
        }
        for extension in &device.extensions {
            writeln!(out, "    {} {}", if extension.found { "found  " } else { "missing" }, extension.name)?;
        }
    }
    write_openxr(&report.openxr, out)?;
    report.scene.write_text(out)
}
