//! Ctrl-C: the program ends with 130 and leaves nothing: no file, no process.

use std::os::unix::process::CommandExt;
use std::process::{Child, Stdio};
use std::time::Duration;

use crate::sandbox::Sandbox;

fn signal(name: &str, target: &str) {
    let status = std::process::Command::new("kill")
        .args([&format!("-{name}"), "--", target])
        .status()
        .unwrap();
    assert!(status.success());
}

/// Ids of processes one of whose arguments lies in the sandbox's folder for temporary files: workers.
pub(crate) fn workers(sandbox: &Sandbox) -> Vec<String> {
    let marker = sandbox.temporary().to_str().unwrap().to_owned();
    let processes = std::fs::read_dir("/proc").unwrap().flatten();
    processes
        .filter(|process| {
            std::fs::read(process.path().join("cmdline"))
                .is_ok_and(|line| String::from_utf8_lossy(&line).contains(&marker))
        })
        .map(|process| process.file_name().to_string_lossy().into_owned())
        .collect()
}

fn start(sandbox: &Sandbox, arguments: &str) -> Child {
    sandbox
        .std_command()
        .args(arguments.split(' '))
        .process_group(0)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

pub(crate) fn wait_for_worker(sandbox: &Sandbox, parent: &mut Child) {
    while workers(sandbox).is_empty() {
        let ended = parent.try_wait().unwrap();
        assert!(ended.is_none(), "it ended without a worker: {ended:?}");
        std::thread::sleep(Duration::from_millis(10));
    }
    // It has its job now.
    std::thread::sleep(Duration::from_millis(200));
}

fn assert_gone(sandbox: &Sandbox) {
    // A process that was told to end may take a moment.
    std::thread::sleep(Duration::from_millis(100));
    let left = workers(sandbox);
    assert!(left.is_empty(), "processes left: {left:?}");
    sandbox.assert_no_temporaries();
}

#[test]
fn an_interrupted_build_ends_with_130_and_leaves_nothing() {
    // To the program alone, as `kill` does, and to its group, as a terminal does.
    for (name, whole_group) in [("INT", false), ("INT", true), ("TERM", false)] {
        let sandbox = Sandbox::of("channel-belt/channel-belt.toml");
        let before = sandbox.files();
        let mut child = start(&sandbox, "build --engine occt model.toml -o out");
        wait_for_worker(&sandbox, &mut child);
        let id = child.id();
        let target = if whole_group {
            format!("-{id}")
        } else {
            id.to_string()
        };
        signal(name, &target);
        let output = child.wait_with_output().unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{name}: {errors}");
        assert!(errors.contains("nothing was written"), "{errors}");
        assert!(output.stdout.is_empty());
        assert_eq!(sandbox.files(), before);
        assert_gone(&sandbox);
    }
}

#[test]
fn whenever_a_build_is_interrupted_its_results_are_whole_or_not_there() {
    let sandbox = Sandbox::of("quickstart/quickstart.toml");
    sandbox.answer("build --engine occt model.toml --quiet -o whole");
    let mut stopped = 0;
    // Over the stages: reading, assembling, proving, writing, and after the end.
    for step in 0..12 {
        let out = format!("out-{step}");
        let child = start(
            &sandbox,
            &format!("build --engine occt model.toml --quiet -o {out}"),
        );
        std::thread::sleep(Duration::from_millis(20 + 130 * step));
        // It may have ended; then there is nobody to tell, but it is not waited for, so the id is its own.
        signal("INT", &child.id().to_string());
        let output = child.wait_with_output().unwrap();
        let folder = sandbox.path(&out);
        match output.status.code() {
            Some(0) => {
                for name in ["model.step", "report.json", "volumes.csv"] {
                    let read = |folder: &str| {
                        std::fs::read(sandbox.path(&format!("{folder}/{name}"))).unwrap()
                    };
                    assert!(read(&out) == read("whole"), "{name} is not whole");
                }
                assert!(std::fs::read_dir(&folder).unwrap().all(|entry| {
                    !entry
                        .unwrap()
                        .file_name()
                        .to_string_lossy()
                        .starts_with('.')
                }));
            }
            // Before it could catch the signal there is no code.
            Some(130) | None => {
                stopped += 1;
                assert!(!folder.exists(), "{out} is left");
            }
            other => panic!("{other:?}: {}", String::from_utf8_lossy(&output.stderr)),
        }
        assert_gone(&sandbox);
    }
    assert!(
        stopped > 0,
        "every build was over before it was interrupted"
    );
}
