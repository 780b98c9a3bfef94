//! Ensembles that are killed, whose workers are killed, or hang, or want too much.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::{QUICK, Sandbox, assert_same, files, table};

/// A realisation of it takes long enough to be met at work.
const SLOW: &str = "channel-belt/channel-belt.toml";

fn start(sandbox: &Sandbox, arguments: &str) -> Child {
    sandbox
        .std_command()
        .args(arguments.split(' '))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Ids of the processes that a process has started.
fn children(parent: u32) -> Vec<u32> {
    let path = format!("/proc/{parent}/task");
    let tasks = std::fs::read_dir(path).into_iter().flatten().flatten();
    tasks
        .filter_map(|task| std::fs::read_to_string(task.path().join("children")).ok())
        .flat_map(|text| {
            text.split_whitespace()
                .map(|id| id.parse().unwrap())
                .collect::<Vec<_>>()
        })
        .collect()
}

fn kill(id: u32) {
    let status = Command::new("kill")
        .args(["-9", &id.to_string()])
        .stderr(Stdio::null())
        .status();
    // It may have ended by itself.
    assert!(status.is_ok());
}

/// Waits for what is true within a minute.
fn wait(what: &str, mut is_true: impl FnMut() -> bool) {
    let started = Instant::now();
    while !is_true() {
        assert!(started.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn an_ensemble_that_is_killed_again_and_again_comes_to_the_same_bytes() {
    let sandbox = Sandbox::of(SLOW);
    let arguments = "ensemble model.toml -n 6 --workers 2 --quiet --set feature.channel.count=8";
    sandbox.answer(&format!("{arguments} -o whole"));
    let killed = format!("{arguments} -o killed");
    for pause in [0, 30, 60, 150] {
        let mut parent = start(&sandbox, &killed);
        let id = parent.id();
        let mut workers = Vec::new();
        wait("no worker was started", || {
            workers = children(id);
            !workers.is_empty() || parent.try_wait().unwrap().is_some()
        });
        std::thread::sleep(Duration::from_millis(pause));
        workers.extend(children(id));
        kill(id);
        parent.wait().unwrap();
        wait("workers outlive their parent", || {
            let is_ours = |id: &u32| {
                std::fs::read(format!("/proc/{id}/cmdline"))
                    .is_ok_and(|line| String::from_utf8_lossy(&line).contains("ensemble-worker"))
            };
            !workers.iter().any(is_ours)
        });
    }
    // One that was finished is damaged, as by a disk that is full.
    let first = sandbox.path("killed/realisations/0001/report.json");
    if let Ok(bytes) = std::fs::read(&first) {
        std::fs::write(&first, &bytes[..bytes.len() / 2]).unwrap();
    }
    sandbox.answer(&killed);
    assert_same(&files(&sandbox, "whole"), &files(&sandbox, "killed"));
    let left = std::fs::read_dir(sandbox.path("killed")).unwrap();
    let left = left.filter(|entry| {
        let name = entry.as_ref().unwrap().file_name();
        name.to_string_lossy().starts_with(".unfinished")
    });
    assert_eq!(left.count(), 0);
}

#[test]
fn workers_that_are_killed_are_started_again_and_once_only() {
    let sandbox = Sandbox::of(SLOW);
    let arguments = "ensemble model.toml -n 3 --workers 1 --quiet --set feature.channel.count=8";
    sandbox.answer(&format!("{arguments} -o whole"));
    let mut parent = start(&sandbox, &format!("{arguments} -o killed"));
    let mut first = Vec::new();
    wait("no worker was started", || {
        first = children(parent.id());
        !first.is_empty()
    });
    kill(first[0]);
    assert!(parent.wait().unwrap().success());
    assert_same(&files(&sandbox, "whole"), &files(&sandbox, "killed"));
    // Both attempts at the first: the others are made, and the next run makes that one.
    let mut parent = start(&sandbox, &format!("{arguments} -o twice"));
    let mut seen = Vec::new();
    for _ in 0..2 {
        wait("no other worker was started", || {
            let now = children(parent.id());
            let new = now.into_iter().find(|id| !seen.contains(id));
            seen.extend(new);
            new.is_some()
        });
        kill(*seen.last().unwrap());
    }
    assert_eq!(parent.wait().unwrap().code(), Some(2));
    let unmade = table(&files(&sandbox, "twice"), "unmade.csv");
    assert_eq!(unmade.len(), 1);
    assert_eq!(unmade[0]["realisation"], "0001");
    assert_eq!(unmade[0]["outcome"], "crashed");
    assert!(unmade[0]["words"].contains("signal: 9"), "{unmade:?}");
    assert!(!sandbox.path("twice/realisations/0001").exists());
    sandbox.answer(&format!("{arguments} -o twice"));
    assert_same(&files(&sandbox, "whole"), &files(&sandbox, "twice"));
}

#[test]
fn one_that_takes_too_long_or_wants_too_much_ends_alone() {
    let sandbox = Sandbox::of(QUICK);
    // The second row has a hundred times as many channels.
    std::fs::write(
        sandbox.path("design.csv"),
        "feature.young-channel.count\n1\n400\n2\n",
    )
    .unwrap();
    let limits = [
        ("--time-limit 8", "time limit", "longer than 8 s"),
        ("--memory-limit 450", "memory limit", "more than 450 MiB"),
    ];
    for (limit, outcome, words) in limits {
        let arguments =
            format!("ensemble model.toml --design design.csv --quiet --force -o out {limit}");
        let output = sandbox.run(&arguments);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(
            errors.contains("1 of 3 realisations could not be made"),
            "{errors}"
        );
        let files = files(&sandbox, "out");
        let unmade = table(&files, "unmade.csv");
        assert_eq!(unmade[0]["outcome"], outcome, "{unmade:?}");
        assert!(unmade[0]["words"].contains(words), "{unmade:?}");
        assert_eq!(table(&files, "realisations.csv").len(), 2);
        std::fs::remove_dir_all(sandbox.path("out")).unwrap();
    }
}

#[test]
fn what_is_refused_is_not_tried_again_and_the_others_are_made() {
    let sandbox = Sandbox::of(QUICK);
    // Bends of 50 m in a channel as wide as that are tighter than any draw can be.
    std::fs::write(
        sandbox.path("design.csv"),
        "feature.young-channel.trajectory.wavelength\n400\n20\n",
    )
    .unwrap();
    let arguments = "ensemble model.toml --design design.csv --quiet -o out";
    for _ in 0..2 {
        let output = sandbox.run(arguments);
        assert_eq!(output.status.code(), Some(2));
        let files = files(&sandbox, "out");
        let unmade = table(&files, "unmade.csv");
        assert_eq!(unmade[0]["outcome"], "refused", "{unmade:?}");
        assert!(unmade[0]["words"].contains("young-channel"), "{unmade:?}");
        assert_eq!(table(&files, "realisations.csv").len(), 1);
    }
    let run = std::fs::read_to_string(sandbox.path("out/run.json")).unwrap();
    let run: serde_json::Value = serde_json::from_str(&run).unwrap();
    assert_eq!((&run["made_now"], &run["kept"]), (&0.into(), &2.into()));
}
