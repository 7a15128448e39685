//! Workers have names, and the sea's job graph is a graph.
use swell::jobs::Workers;
use swell::sea::stages::STAGES;

#[test]
fn workers_are_named_and_counted() {
    let workers = Workers::new(2).expect("threads");
    assert_eq!(workers.threads(), 2);
    let name = workers.run(|| std::thread::current().name().map(str::to_owned));
    assert!(name.is_some_and(|name| name.starts_with("swell-worker-")));
    assert!(Workers::new(0).expect("threads").threads() >= 1);
}

#[test]
#[cfg(target_os = "linux")]
fn workers_are_known_to_the_kernel() {
    let workers = Workers::new(2).expect("threads");
    let own = workers.run(swell::jobs::kernel_id).expect("Linux numbers threads");
    assert!(workers.kernel_ids().contains(&own));
    assert_ne!(Some(own), swell::jobs::kernel_id(), "this thread is no worker");
}

#[test]
fn every_stage_reads_what_an_earlier_one_wrote() {
    // Made before the first step; the foam's memory also carries over from earlier steps.
    let mut written = vec!["spectrum"];
    for stage in STAGES {
        for read in stage.reads {
            assert!(written.contains(read), "{} reads {read}, which nothing has written", stage.name);
        }
        written.extend(stage.writes);
    }
}
