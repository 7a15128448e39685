//! The layer of `tests/fault_layer` between a program and the runtime: faults on demand, and a record of the calls.
use super::monado::Service;
use super::program::{SWELL, Said, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const LAYER: &str = "XR_APILAYER_SWELL_faults";
const CORE_VALIDATION: &str = "XR_APILAYER_LUNARG_core_validation";

/// What programs do on a service.
pub struct Record {
    calls: PathBuf,
    validation: PathBuf,
}

/// Puts core validation and the faults (see `tests/fault_layer/plan.rs`; "" for none) between `command` and the runtime,
/// in this order: validation sees what the program asks for, and takes a fault for the runtime's. A program that is
/// started again on the same service adds to the same record.
pub fn between(service: &Service, command: &mut Command, faults: &str) -> Record {
    let folder = service.folder();
    let record = Record { calls: folder.join("calls.txt"), validation: folder.join("validation.txt") };
    // The loader takes layers in the order of their folders, and `vk-run` puts validation's behind the caller's.
    let layers =
        Path::new(&std::env::var_os("XR_API_LAYER_PATH").expect("run tests with ./x test")).to_owned();
    let own = folder.join("layers");
    fs::create_dir_all(&own).unwrap();
    let manifest = serde_json::json!({"file_format_version": "1.0.0", "api_layer": {
        "name": LAYER, "library_path": library(), "api_version": "1.0", "implementation_version": "1",
        "description": "faults for tests"}});
    fs::write(own.join("faults.json"), manifest.to_string()).unwrap();
    let path = std::env::join_paths([&layers, &own]).unwrap();
    command
        .env("XR_API_LAYER_PATH", path)
        .env("XR_ENABLE_API_LAYERS", format!("{CORE_VALIDATION}:{LAYER}"))
        .env("XR_CORE_VALIDATION_EXPORT_TYPE", "text")
        .env("XR_CORE_VALIDATION_FILE_NAME", &record.validation)
        .env("SWELL_FAULTS", faults)
        .env("SWELL_FAULT_LOG", &record.calls);
    record
}

/// Shows `command` Monado without `extensions`.
pub fn hidden(service: &Service, command: &mut Command, extensions: &[&str]) {
    wrapped(service, command).env("SWELL_HIDDEN", extensions.join(","));
}

/// Shows `command` Monado with `extensions` that `tests/fault_layer/pretend` plays. Call it besides [`between`], whose record
/// tells what was asked of them.
pub fn pretended(service: &Service, command: &mut Command, extensions: &[&str]) {
    wrapped(service, command).env("SWELL_PRETENDED", extensions.join(","));
}

/// What the ignored test `name` did on a runtime that pretends `extensions`, where `faults` struck. It passes, nobody
/// objects, and nothing is wrong with what the runtime was told.
pub fn passes(service: &Service, name: &str, extensions: &[&str], faults: &str) -> (Calls, Said) {
    let mut client = service.reexec(name);
    pretended(service, &mut client, extensions);
    let record = between(service, &mut client, faults);
    let said = run(&mut client);
    let calls = record.calls();
    print!("{}", said.out);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}\n{calls:#?}");
    assert_eq!(record.objections(), [""; 0]);
    assert_eq!(calls.count("wrong"), 0, "{calls:#?}");
    (calls, said)
}

/// The library as a runtime around Monado.
fn wrapped<'a>(service: &Service, command: &'a mut Command) -> &'a mut Command {
    let read = |file: &Path| fs::read_to_string(file).unwrap();
    let monado = Path::new(&std::env::var_os("XR_RUNTIME_JSON").expect("run tests with ./x test")).to_owned();
    let monado: serde_json::Value = serde_json::from_str(&read(&monado)).unwrap();
    let manifest =
        serde_json::json!({"file_format_version": "1.0.0", "runtime": {"library_path": library()}});
    let file = service.folder().join("runtime.json");
    fs::write(&file, manifest.to_string()).unwrap();
    command
        // `vk-run` would name Monado's manifest.
        .env_remove("SWELL_XR")
        .env("XR_RUNTIME_JSON", file)
        .env("SWELL_RUNTIME", monado["runtime"]["library_path"].as_str().unwrap())
}

/// Beside the tests' programs, where `./x test` builds it.
fn library() -> PathBuf {
    let file = Path::new(SWELL).with_file_name("examples").join("libswell_fault_layer.so");
    assert!(file.exists(), "{} is missing: cargo build --example swell_fault_layer", file.display());
    file
}

impl Record {
    /// The calls so far.
    pub fn calls(&self) -> Calls {
        let text = fs::read_to_string(&self.calls).unwrap_or_default();
        Calls(text.lines().map(str::to_owned).collect())
    }

    /// What core validation objects to. It has to have been there.
    pub fn objections(&self) -> Vec<String> {
        let text = fs::read_to_string(&self.validation).expect("core validation did not run");
        text.lines().filter(|line| !line.contains("[VALID_DEBUG |")).map(str::to_owned).collect()
    }
}

/// A line for each call, in order: its name, then `key=value` words, then ` -> ERROR` where it failed. Sessions' states
/// are `state NAME`, other events `event NAME`, faults that struck `fault NAME CALL`.
#[derive(Debug)]
pub struct Calls(pub Vec<String>);

impl Calls {
    /// How many lines begin with `words`.
    pub fn count(&self, words: &str) -> usize {
        self.0.iter().filter(|line| line.starts_with(words)).count()
    }

    /// How many lines end with ` -> ERROR`.
    pub fn failed(&self, error: &str) -> usize {
        self.0.iter().filter(|line| line.ends_with(&format!(" -> {error}"))).count()
    }

    /// Lines that begin with these words are there in this order, others between them.
    pub fn come_in_order(&self, words: &[&str]) {
        let mut rest = self.0.iter();
        for words in words {
            assert!(
                rest.any(|line| line.starts_with(words)),
                "{words:?} does not come, or not there: {self:#?}"
            );
        }
    }
}
