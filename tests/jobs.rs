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
    for threads in 1..8 {
        // All of them, at once: a session is told once.
        assert_eq!(Workers::new(threads).expect("threads").kernel_ids().len(), threads);
    }
    assert_ne!(Some(own), swell::jobs::kernel_id(), "this thread is no worker");
}

#[test]
#[cfg(target_os = "linux")]
fn there_are_as_many_workers_as_processors_that_may_be_used() {
    use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
    use nix::unistd::Pid;
    let own = Pid::from_raw(0);
    let allowed =
        |mask: &CpuSet| (0..CpuSet::count()).filter(|&cpu| mask.is_set(cpu) == Ok(true)).collect::<Vec<_>>();
    let all = allowed(&sched_getaffinity(own).expect("a mask"));
    // A mask is a thread's, and those it starts inherit it.
    for count in [1, 2.min(all.len())] {
        let some = all[all.len() - count..].to_vec();
        let thread = std::thread::spawn(move || {
            let mut mask = CpuSet::new();
            some.iter().for_each(|&cpu| mask.set(cpu).expect("a processor"));
            sched_setaffinity(own, &mask).expect("a part of the mask");
            let workers = Workers::new(0).expect("threads");
            let theirs = workers.run(|| allowed(&sched_getaffinity(own).expect("a mask")));
            (workers.threads(), theirs, some)
        });
        let (threads, theirs, some) = thread.join().expect("no panic");
        assert_eq!(theirs, some);
        // A quota below two processors' worth of time allows one.
        assert!(threads == count || (1..count).contains(&threads), "{threads} of {count}");
        assert!(count > 1 || threads == 1);
    }
}

#[test]
fn every_stage_reads_what_an_earlier_one_wrote() {
    // Made before the first step; the foam's memory carries over from earlier steps.
    let mut written = vec!["amplitudes", "harmonics", "memory"];
    for stage in STAGES {
        for read in stage.reads {
            assert!(written.contains(read), "{} reads {read}, which nothing has written", stage.name);
        }
        written.extend(stage.writes);
    }
}
