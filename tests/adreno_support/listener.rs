//! Stands between the renderer and the driver: asks the driver to keep statistics of every pipeline, and writes them down.
//!
//! It opens Vulkan for the renderer (`gpu::Opener`) and hands it an instance whose `vkGetDeviceProcAddr` gives out two
//! functions of its own. So what is measured is what the renderer makes, in whatever state it makes it.
use super::{Cost, ways};
use ash::{khr, vk};
use std::ffi::{CStr, c_char};
use std::mem::transmute;
use std::sync::{Mutex, OnceLock};
use swell::draw::shaders::MODULES;
use swell::gpu::{Directly, GpuError, Instance, Opener, PhysicalDevice};

/// The driver's functions that ours stand before.
static GET_DEVICE_PROC_ADDR: OnceLock<vk::PFN_vkGetDeviceProcAddr> = OnceLock::new();
static CREATE_PIPELINES: OnceLock<vk::PFN_vkCreateGraphicsPipelines> = OnceLock::new();
static CREATE_MODULE: OnceLock<vk::PFN_vkCreateShaderModule> = OnceLock::new();
static STATISTICS: OnceLock<khr::pipeline_executable_properties::Device> = OnceLock::new();
/// Live modules, each with its place in `MODULES`.
static LIVE: Mutex<Vec<(vk::ShaderModule, usize)>> = Mutex::new(Vec::new());
static COSTS: Mutex<Vec<Cost>> = Mutex::new(Vec::new());

/// What was compiled since the last call, for `cascades`.
pub fn take(cascades: usize) -> Vec<Cost> {
    let mut costs = std::mem::take(&mut *COSTS.lock().unwrap());
    costs.iter_mut().for_each(|cost| cost.cascades = cascades);
    costs
}

/// Opens Vulkan for who is listened to.
pub struct Listener;

impl Opener for Listener {
    fn create_instance(
        &self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<ash::Instance, GpuError> {
        let plain = Directly.create_instance(entry, info)?;
        let handle = plain.handle();
        GET_DEVICE_PROC_ADDR.get_or_init(|| plain.fp_v1_0().get_device_proc_addr);
        let find = |name: &CStr| {
            if name == c"vkGetDeviceProcAddr" {
                return get_device_proc_addr as *const _;
            }
            // SAFETY: the instance lives; a function is handed on as what it was asked for.
            unsafe { transmute(entry.get_instance_proc_addr(handle, name.as_ptr())) }
        };
        // SAFETY: the functions are this instance's, our own being of the type of the one it stands before.
        Ok(unsafe { ash::Instance::load_with(find, handle) })
    }

    fn choose(&self, instance: &Instance, wanted: Option<&str>) -> Result<PhysicalDevice, GpuError> {
        Directly.choose(instance, wanted)
    }

    fn create_device(
        &self,
        instance: &Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<ash::Device, GpuError> {
        let count = info.enabled_extension_count as usize;
        let mut names = vec![khr::pipeline_executable_properties::NAME.as_ptr()];
        if count > 0 {
            // SAFETY: as many names as the caller says.
            names.extend(unsafe { std::slice::from_raw_parts(info.pp_enabled_extension_names, count) });
        }
        let mut kept = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
            .pipeline_executable_info(true);
        // SAFETY: a copy of what the caller keeps past the call, with a longer chain.
        let info = unsafe { std::ptr::read(info) }.enabled_extension_names(&names).push_next(&mut kept);
        let device = Directly.create_device(instance, physical, &info)?;
        STATISTICS.get_or_init(|| khr::pipeline_executable_properties::Device::new(&instance.raw, &device));
        Ok(device)
    }
}

/// # Safety
/// As `vkGetDeviceProcAddr`.
unsafe extern "system" fn get_device_proc_addr(
    device: vk::Device,
    name: *const c_char,
) -> vk::PFN_vkVoidFunction {
    // SAFETY: the caller's promise; each function is kept as what its name says, and given out as the same.
    unsafe {
        let found = GET_DEVICE_PROC_ADDR.get().unwrap()(device, name)?;
        let name = CStr::from_ptr(name);
        Some(if name == c"vkCreateGraphicsPipelines" {
            CREATE_PIPELINES.get_or_init(|| transmute(found));
            transmute::<vk::PFN_vkCreateGraphicsPipelines, unsafe extern "system" fn()>(create_pipelines)
        } else if name == c"vkCreateShaderModule" {
            CREATE_MODULE.get_or_init(|| transmute(found));
            transmute::<vk::PFN_vkCreateShaderModule, unsafe extern "system" fn()>(create_module)
        } else {
            found
        })
    }
}

/// # Safety
/// As `vkCreateShaderModule`.
unsafe extern "system" fn create_module(
    device: vk::Device,
    info: *const vk::ShaderModuleCreateInfo<'_>,
    allocator: *const vk::AllocationCallbacks<'_>,
    made: *mut vk::ShaderModule,
) -> vk::Result {
    // SAFETY: the caller's promise.
    let (result, module, code) = unsafe {
        let code = std::slice::from_raw_parts((*info).p_code.cast::<u8>(), (*info).code_size);
        let result = CREATE_MODULE.get().unwrap()(device, info, allocator, made);
        (result, *made, code)
    };
    if result == vk::Result::SUCCESS {
        let place = MODULES.iter().position(|(_, _, spirv)| *spirv == code).unwrap();
        let mut live = LIVE.lock().unwrap();
        live.retain(|&(other, _)| other != module);
        live.push((module, place));
    }
    result
}

/// # Safety
/// As `vkCreateGraphicsPipelines`.
unsafe extern "system" fn create_pipelines(
    device: vk::Device,
    cache: vk::PipelineCache,
    count: u32,
    infos: *const vk::GraphicsPipelineCreateInfo<'_>,
    allocator: *const vk::AllocationCallbacks<'_>,
    made: *mut vk::Pipeline,
) -> vk::Result {
    // SAFETY: the caller's promise: as many structures as it says, and stages in each.
    unsafe {
        let mut infos = std::slice::from_raw_parts(infos, count as usize).to_vec();
        for info in &mut infos {
            info.flags |= vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR
                | vk::PipelineCreateFlags::CAPTURE_INTERNAL_REPRESENTATIONS_KHR;
        }
        let create = CREATE_PIPELINES.get().unwrap();
        let result = create(device, cache, count, infos.as_ptr(), allocator, made);
        if result == vk::Result::SUCCESS {
            for (index, info) in infos.iter().enumerate() {
                let stages = std::slice::from_raw_parts(info.p_stages, info.stage_count as usize);
                let module = |flag| stages.iter().find(|stage| stage.stage == flag).map(|stage| stage.module);
                let vertex = module(vk::ShaderStageFlags::VERTEX).unwrap();
                write_down(*made.add(index), vertex, module(vk::ShaderStageFlags::FRAGMENT));
            }
        }
        result
    }
}

/// # Safety
/// `pipeline` was made to keep its statistics, its stages from `vertex` and `fragment`, which one of depth alone has not.
unsafe fn write_down(pipeline: vk::Pipeline, vertex: vk::ShaderModule, fragment: Option<vk::ShaderModule>) {
    let name = |wanted| {
        let place = LIVE.lock().unwrap().iter().find(|&&(module, _)| module == wanted).unwrap().1;
        MODULES[place].0
    };
    let vertex = name(vertex);
    // Blinn-Phong has no vertex stages of its own.
    let shading = if fragment.map(name).is_some_and(|name| name.contains("phong_")) { "phong_" } else { "" };
    let statistics = STATISTICS.get().unwrap();
    let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
    // SAFETY: the caller's promise.
    let executables = unsafe { statistics.get_pipeline_executable_properties(&info) }.unwrap();
    for (index, executable) in (0..).zip(&executables) {
        let stage = match executable.stages {
            // The vertex stage comes a second time, cut down to what binning needs: never dearer than the whole.
            vk::ShaderStageFlags::VERTEX if index > 0 => continue,
            vk::ShaderStageFlags::VERTEX => "vertex",
            _ => "fragment",
        };
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline).executable_index(index);
        // SAFETY: as above.
        let said = unsafe { statistics.get_pipeline_executable_statistics(&info) }.unwrap();
        let value = |name: &str| {
            let found = said.iter().find(|one| one.name_as_c_str().is_ok_and(|own| own.to_str() == Ok(name)));
            // SAFETY: every number that the driver gives fills the union's 64 bits, and those asked for are whole.
            found
                .map(|one| unsafe { one.value.i64 })
                .unwrap_or_else(|| panic!("the driver tells no '{name}'"))
        };
        // SAFETY: as above.
        let assembly = unsafe { assembly(statistics, &info) };
        COSTS.lock().unwrap().push(Cost {
            pipeline: format!("{shading}{vertex}"),
            cascades: 0,
            stage: stage.to_owned(),
            instructions: value("Instruction Count"),
            nops: value("NOPs Count"),
            registers: value("Registers used"),
            waves: value("Max Waves Per Core"),
            width: i64::from(executable.subgroup_size),
            spills: value("STP Count") + value("LDP Count"),
            around: assembly.map_or([0; 2], |text| ways::around(&text, value("Instruction Count"))),
        });
    }
}

/// What the driver made of a stage, as text; of the empty fragment stage of depth alone it has none.
///
/// # Safety
/// The pipeline of `info` was made to keep its representations.
unsafe fn assembly(
    statistics: &khr::pipeline_executable_properties::Device,
    info: &vk::PipelineExecutableInfoKHR<'_>,
) -> Option<String> {
    let get = statistics.fp().get_pipeline_executable_internal_representations_khr;
    let mut count = 0;
    // SAFETY: the caller's promise; asked for their number, then for as many, then for their bytes.
    unsafe {
        assert_eq!(get(statistics.device(), info, &mut count, std::ptr::null_mut()), vk::Result::SUCCESS);
        let mut all = vec![vk::PipelineExecutableInternalRepresentationKHR::default(); count as usize];
        assert_eq!(get(statistics.device(), info, &mut count, all.as_mut_ptr()), vk::Result::SUCCESS);
        let mut texts: Vec<Vec<u8>> = all.iter().map(|one| vec![0; one.data_size]).collect();
        for (one, text) in all.iter_mut().zip(&mut texts) {
            one.p_data = text.as_mut_ptr().cast();
        }
        assert_eq!(get(statistics.device(), info, &mut count, all.as_mut_ptr()), vk::Result::SUCCESS);
        let own = all.iter().position(|one| one.name_as_c_str().is_ok_and(|name| name == c"IR3 Assembly"));
        own.map(|own| String::from_utf8_lossy(&texts[own]).trim_end_matches('\0').to_owned())
    }
}
