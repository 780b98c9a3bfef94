//! Ensembles that are killed, whose workers are killed, or hang, or want too much.

use std::collections::BTreeMap;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use clinothem::model::Stream;

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

/// How often an ensemble is killed.
const KILLS: u32 = 20;
/// The longest that a worker may outlive its parent.
const MOURNING: Duration = Duration::from_secs(1);

/// Whether a process is a worker that still runs: one that has ended and was not asked for has no command line.
fn is_worker(id: u32) -> bool {
    std::fs::read(format!("/proc/{id}/cmdline"))
        .is_ok_and(|line| String::from_utf8_lossy(&line).contains("ensemble-worker"))
}

/// Each file in its place is as it is in the whole ensemble, though others may be missing. Returns how many there are.
#[track_caller]
fn assert_part_of(part: &BTreeMap<String, Vec<u8>>, whole: &BTreeMap<String, Vec<u8>>) -> usize {
    let in_place = |name: &&String| !name.starts_with(".unfinished-");
    let found: Vec<&String> = part.keys().filter(in_place).collect();
    for name in &found {
        assert!(part[*name] == whole[*name], "{name} is half-written");
    }
    found.len()
}

#[test]
fn an_ensemble_that_is_killed_at_twenty_random_moments_comes_to_the_same_bytes() {
    let sandbox = Sandbox::of(SLOW);
    let arguments = "ensemble model.toml -n 24 --workers 2 --quiet --set feature.channel.count=4";
    let started = Instant::now();
    sandbox.answer(&format!("{arguments} -o whole"));
    let undisturbed = started.elapsed();
    let whole = files(&sandbox, "whole");
    let killed = format!("{arguments} -o killed");
    let (mut alive, mut at_once) = (0, 0);
    for kill_number in 0..KILLS {
        let mut parent = start(&sandbox, &killed);
        let id = parent.id();
        // On the way to the end, where tables and plots are made.
        let moment = Stream::new(1, "test", "killed", "moment", kill_number).unit();
        std::thread::sleep(undisturbed.mul_f64(moment / 8.0));
        let workers = children(id);
        at_once = at_once.max(workers.len());
        let is_alive = parent.try_wait().unwrap().is_none();
        alive += u32::from(is_alive);
        if is_alive {
            kill(id);
            parent.wait().unwrap();
        }
        let mourning = Instant::now();
        while workers.iter().any(|id| is_worker(*id)) {
            assert!(
                mourning.elapsed() < MOURNING,
                "workers outlive their parent"
            );
            std::thread::sleep(Duration::from_millis(1));
        }
        // It may have been killed before it began.
        if sandbox.path("killed").exists() {
            assert_part_of(&files(&sandbox, "killed"), &whole);
        }
        if !is_alive {
            // It came to its end, and begins anew.
            std::fs::remove_dir_all(sandbox.path("killed")).unwrap();
        }
    }
    assert!(alive >= 10, "only {alive} were still at work when killed");
    assert_eq!(at_once, 2, "as many work at a time as were asked for");
    sandbox.answer(&killed);
    assert_same(&whole, &files(&sandbox, "killed"));
    // One that was finished is damaged, as by a copy that ended half-way.
    let first = sandbox.path("killed/realisations/0001/report.json");
    let bytes = std::fs::read(&first).unwrap();
    std::fs::write(&first, &bytes[..bytes.len() / 2]).unwrap();
    sandbox.answer(&killed);
    assert_same(&whole, &files(&sandbox, "killed"));
    let left = std::fs::read_dir(sandbox.path("killed")).unwrap();
    let left = left.filter(|entry| {
        let name = entry.as_ref().unwrap().file_name();
        name.to_string_lossy().starts_with(".unfinished")
    });
    assert_eq!(left.count(), 0);
}

/// Runs an ensemble in a file system of some size (in KiB), then again once it is larger, each time with a copy of what there is.
const FULL_DISK: &str = r#"
mount -t tmpfs -o size="$2k" tmpfs disk
"$1" ensemble model.toml $3 -o disk/out
echo "$?" > first-code
cp -a disk/out first
mount -o remount,size=256m disk
"$1" ensemble model.toml $3 -o disk/out
echo "$?" > second-code
cp -a disk/out second
"#;

/// As the only user of file systems of its own, which needs no rights but is not allowed everywhere.
fn in_file_systems_of_its_own(sandbox: &Sandbox) -> Command {
    let mut command = Command::new("unshare");
    command
        .args(["--map-root-user", "--mount", "sh", "-c"])
        .current_dir(sandbox.path(""));
    command
}

#[test]
fn a_disk_that_is_full_half_way_ends_it_and_with_more_room_it_comes_to_the_same_bytes() {
    let sandbox = Sandbox::of(SLOW);
    let able = in_file_systems_of_its_own(&sandbox)
        .arg("mkdir trial && mount -t tmpfs tmpfs trial")
        .stderr(Stdio::null())
        .status();
    if !able.is_ok_and(|status| status.success()) {
        // Containers may forbid it: then it is seen where they do not.
        return;
    }
    std::fs::create_dir(sandbox.path("disk")).unwrap();
    for write in ["tables", "step"] {
        let arguments =
            format!("-n 12 --workers 2 --quiet --set feature.channel.count=3 --write {write}");
        sandbox.answer(&format!("ensemble model.toml {arguments} -o whole"));
        let whole = files(&sandbox, "whole");
        // Files take whole pages; there is room for half of the realisations.
        let made = whole.iter().filter(|(name, _)| name.contains('/'));
        let pages: usize = made.map(|(_, bytes)| bytes.len().div_ceil(4096)).sum();
        let output = in_file_systems_of_its_own(&sandbox)
            .args([FULL_DISK, "sh", env!("CARGO_BIN_EXE_clinothem")])
            .args([&(pages * 4 / 2).to_string(), &arguments])
            .output()
            .unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        let code = |name: &str| std::fs::read_to_string(sandbox.path(name)).unwrap();
        assert_eq!(code("first-code").trim(), "3", "{errors}");
        assert!(errors.contains("No space left on device"), "{errors}");
        assert!(errors.contains("goes on from there"), "{errors}");
        let made = assert_part_of(&files(&sandbox, "first"), &whole);
        assert!(made > 1, "nothing was finished before the disk was full");
        assert_eq!(code("second-code").trim(), "0", "{errors}");
        assert_same(&whole, &files(&sandbox, "second"));
        for folder in ["whole", "first", "second"] {
            std::fs::remove_dir_all(sandbox.path(folder)).unwrap();
        }
    }
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
