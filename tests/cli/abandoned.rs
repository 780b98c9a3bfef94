//! What builds that were killed have left, and what the next one does about it.

use std::fs::{self, File};
use std::process::Stdio;
use std::time::Duration;

use crate::sandbox::{STRAIGHT, Sandbox};

/// A folder of unfinished files as a build makes it.
fn leave(sandbox: &Sandbox, name: &str) -> File {
    fs::create_dir_all(sandbox.path(name)).unwrap();
    fs::write(sandbox.path(&format!("{name}/model.step")), "half of it").unwrap();
    File::create(sandbox.path(&format!("{name}/clinothem.lock"))).unwrap()
}

#[test]
fn a_build_goes_on_in_a_fresh_folder_where_another_one_was_killed() {
    let sandbox = Sandbox::new(STRAIGHT);
    drop(leave(&sandbox, "out/.unfinished-a"));
    sandbox.answer("build model.toml -o out");
    assert!(sandbox.path("out/model.step").is_file());
    assert!(!sandbox.path("out/.unfinished-a").exists());
}

#[test]
fn what_a_running_build_has_not_finished_is_left_alone() {
    let sandbox = Sandbox::new(STRAIGHT);
    let lock = leave(&sandbox, "out/.unfinished-a");
    lock.lock().unwrap();
    let errors = sandbox.refusal("build model.toml -o out", 1);
    assert!(
        errors.contains("another build is writing to the folder out"),
        "{errors}"
    );
    sandbox.answer("build model.toml -o out --force");
    assert!(sandbox.path("out/.unfinished-a/model.step").is_file());
    drop(lock);
    sandbox.answer("build model.toml -o out");
    assert!(!sandbox.path("out/.unfinished-a").exists());
}

#[test]
fn folders_of_such_a_name_that_no_build_has_made_are_kept() {
    let sandbox = Sandbox::new(STRAIGHT);
    drop(leave(&sandbox, "out/.unfinished-a"));
    fs::create_dir_all(sandbox.path("out/.unfinished-thesis")).unwrap();
    fs::write(
        sandbox.path("out/.unfinished-thesis/text"),
        "ten years of work",
    )
    .unwrap();
    let output = sandbox.run("build model.toml -o out");
    assert_eq!(output.status.code(), Some(1));
    assert!(sandbox.path("out/.unfinished-thesis/text").is_file());
    assert!(!sandbox.path("out/.unfinished-a").exists());
}

#[test]
fn a_fuse_ends_with_its_killed_parent_and_the_next_build_removes_its_folder() {
    let sandbox = Sandbox::of("channel-belt/channel-belt.toml");
    let mut build = sandbox
        .std_command()
        .args(["build", "--engine", "occt", "model.toml", "-o", "out"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    crate::interrupted::wait_for_worker(&sandbox, &mut build);
    build.kill().unwrap();
    build.wait().unwrap();
    // Nothing tells it but the end of its input; a fuse of this belt takes far longer than one look.
    while !crate::interrupted::workers(&sandbox).is_empty() {
        std::thread::sleep(Duration::from_millis(10));
    }
    let left = || fs::read_dir(sandbox.temporary()).unwrap().count();
    assert_eq!(left(), 1, "a killed process removes nothing");
    sandbox.answer("build model.toml --set feature.channel.count=1 --quiet -o out");
    assert_eq!(left(), 0);
}

#[test]
fn a_system_without_threads_is_told_of_and_is_no_panic() {
    let sandbox = Sandbox::new(STRAIGHT);
    for command in ["check", "build", "section", "view", "surfaces"] {
        let before = sandbox.files();
        let output = sandbox
            .std_command()
            .args([command, "model.toml"])
            // No machine has memory for a stack of a pebibyte.
            .env("RUST_MIN_STACK", (1_u64 << 50).to_string())
            .output()
            .unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(3), "{command}: {errors}");
        assert!(
            errors.contains("the system starts no threads"),
            "{command}: {errors}"
        );
        assert!(!errors.contains("panicked"), "{command}: {errors}");
        assert_eq!(sandbox.files(), before, "{command}");
    }
}
