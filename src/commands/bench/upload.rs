//! `upload`: what a frame's upload of the maps costs the CPU: the copies into the mapped ring, and recording the barriers
//! and copies to textures. Nothing is submitted, so the device's own work is not in it.
use super::harness::{Body, Case, Label, Work};
use super::{BenchError, sea, selection::Selection};
use crate::draw::SeaTextures;
use crate::gpu::{
    Commands, Device, DeviceNeeds, Directly, FRAMES_IN_FLIGHT, GpuError, Instance, PhysicalDevice,
    UploadRing, Validation,
};
use crate::sea::{Sea, SeaMaps};

struct Recording {
    /// Dropped first: it would wait for work on the others.
    commands: Vec<Commands>,
    textures: Vec<SeaTextures>,
    ring: UploadRing,
    maps: SeaMaps,
    frame: usize,
}

impl Body for Recording {
    fn prepare(&mut self) {
        self.frame += 1;
    }

    fn run(&mut self) -> Result<(), BenchError> {
        let slot = self.frame % FRAMES_IN_FLIGHT;
        let recorder = self.commands[slot].begin()?;
        self.ring.begin(slot as u64);
        Ok(self.textures[slot].upload(recorder, &mut self.ring, &self.maps)?)
    }
}

/// The case of one cascade of the size of detail, if it is wanted. Without a device it is left out, and a line on standard
/// error says why.
///
/// # Errors
/// Making the sea; with a device asked for, also that it is not there.
pub fn cases(selection: &Selection) -> Result<Option<Case>, BenchError> {
    if !selection.wants("upload") {
        return Ok(None);
    }
    let n = selection.detail;
    let settings = sea::settings(n, 1, sea::NO_MEMORY);
    let mut sea = Sea::new(&settings)?;
    let mut maps = sea.new_maps();
    sea.step(10.0, &mut maps)?;
    let bytes = SeaTextures::bytes(&settings.cascades);
    let body = match recording(selection.device.as_deref(), bytes, sea.settings(), maps) {
        Err(reason) if selection.device.is_none() => {
            eprintln!("upload is left out: {reason}");
            return Ok(None);
        }
        body => body?,
    };
    let label = Label { name: "upload".to_owned(), n, cascades: 1, threads: 1, isa: "" };
    // Each byte is read from the maps and written to the ring.
    let work = Work { points: (n * n) as f64, bytes: 2.0 * bytes as f64, flops: 0.0 };
    Ok(Some(Case::new(label, work, body)))
}

fn recording(
    name: Option<&str>,
    bytes: u64,
    settings: &crate::sea::SeaSettings,
    maps: SeaMaps,
) -> Result<Recording, GpuError> {
    let instance = Instance::new(Validation::Off, &[], &Directly)?;
    let physical = PhysicalDevice::choose(&instance, name)?;
    let device = Device::new(instance, physical, &DeviceNeeds::default())?;
    Ok(Recording {
        commands: (0..FRAMES_IN_FLIGHT)
            .map(|_| Commands::new(&device, "upload"))
            .collect::<Result<_, _>>()?,
        textures: (0..FRAMES_IN_FLIGHT)
            .map(|_| SeaTextures::new(&device, &settings.cascades))
            .collect::<Result<_, _>>()?,
        ring: UploadRing::new(&device, FRAMES_IN_FLIGHT as u64, bytes)?,
        maps,
        frame: 0,
    })
}
