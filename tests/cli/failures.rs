//! What is refused: with the right exit code, a reason, and nothing left behind.

use crate::sandbox::{STRAIGHT, Sandbox};

#[test]
fn wrong_arguments_are_refused_with_1_and_leave_nothing() {
    let sandbox = Sandbox::new(STRAIGHT);
    for (arguments, reason) in [
        ("", "Usage"),
        ("dig model.toml", "dig"),
        ("build", "MODEL"),
        ("build no-such.toml", "no such file"),
        ("build .", "directory"),
        ("build model.toml --seed abc", "abc"),
        ("build model.toml --seed -1", "-1"),
        ("build model.toml --threads 0", "0"),
        ("build model.toml --time-limit 0", "0"),
        ("build model.toml --formats dxf", "dxf"),
        ("build model.toml --proof none", "none"),
        ("build model.toml --set nonsense", "nonsense"),
        ("build model.toml --set feature.nobody.width=3", "nobody"),
        ("build model.toml --set feature.ditch.widht=3", "widht"),
        ("build model.toml --set feature.ditch.width=-3", "-3"),
        ("build model.toml --set feature.ditch.width=nan", "width"),
        ("build model.toml --set domain.x=[nan,600]", "domain"),
        ("build model.toml --set domain.x=[0,inf]", "domain"),
        ("build model.toml --without nobody", "nobody"),
        ("build model.toml --without ditch-2", "ditch-2"),
        ("build model.toml --max-level one", "one"),
        ("build model.toml -o model.toml", "file"),
        ("check model.toml --without dich", "did you mean `ditch`"),
        ("surfaces model.toml --without nobody", "nobody"),
        ("locate model.toml 1 2", "Z"),
        ("locate model.toml NaN 200 -5", "NaN"),
        ("locate model.toml 300 inf -5", "inf"),
        ("locate model.toml 300 200 north", "north"),
        ("locate model.toml 300 200 5", "outside the domain"),
        ("locate model.toml 300 -0.001 -5", "outside the domain"),
        ("locate model.toml 300 200 -5 --tolerance 0", "tolerance"),
        ("locate model.toml 300 200 -5 --tolerance nan", "nan"),
        ("section model.toml --map 3", "outside the domain"),
        ("section model.toml --map nan", "nan"),
        ("section model.toml --map -5 --width 0", "width"),
        ("section model.toml --from 0,0", "--to"),
        ("section model.toml --from 0,0 --to 0", "2 numbers"),
        ("section model.toml --from 5,5 --to 5,5", "same"),
        ("section model.toml --from NaN,5 --to 5,5", "NaN"),
        ("section model.toml --fence 0,0", "two points"),
        ("section model.toml --exaggeration 0", "exaggeration"),
        ("section model.toml --exaggeration -1", "-1"),
        ("section model.toml -o picture.bmp", ".png or .svg"),
        ("section model.toml -o picture", ".png or .svg"),
        ("view model.toml -o picture.svg", "PNG"),
        ("view model.toml -o picture.jpeg", ".png"),
        ("view model.toml --style block --size 0,100", "width"),
        ("view model.toml --style block --size 100", "100"),
        (
            "view model.toml --style block --exaggeration 0",
            "exaggeration",
        ),
        ("view model.toml --style block --exaggeration nan", "nan"),
        ("section model.toml --width -5", "'-5'"),
        ("section model.toml --from 1e300,0 --to 5,5", "beyond 1e9"),
        ("view model.toml --style block --size -5,5", "whole numbers"),
        ("view model.toml --style block --exaggeration -2", "-2"),
        ("locate model.toml 1e308 0 0", "1e308 is beyond 1e9"),
        (
            "locate model.toml 300 200 -5 --tolerance 1e300",
            "beyond 1e9",
        ),
        ("check model.toml --max-level -1", "-1"),
        ("build model.toml --threads -1", "'-1'"),
        ("new delta", "without a name lists them"),
        ("new quikstart", "quickstart"),
        ("new quickstart model.toml", "exists already"),
    ] {
        let errors = sandbox.refusal(arguments, 1);
        assert!(
            errors.to_lowercase().contains(&reason.to_lowercase()),
            "`{arguments}` should speak of `{reason}`: {errors}"
        );
    }
}

#[test]
fn places_that_cannot_be_written_to_are_refused_with_3_and_leave_nothing() {
    let sandbox = Sandbox::new(STRAIGHT);
    // Permissions do not bind root, so: below a file, and in file systems that take no new files.
    for place in ["model.toml/below", "/proc/below", "/sys/below"] {
        for command in [
            "build model.toml --quiet -o",
            "surfaces model.toml -o",
            "section model.toml --map -5 -o",
            "view model.toml --style block -o",
            "new quickstart",
        ] {
            let ending = match command.split(' ').next() {
                Some("surfaces") => "/x.step",
                Some("section" | "view") => "/x.png",
                _ => "",
            };
            let errors = sandbox.refusal(&format!("{command} {place}{ending}"), 3);
            assert!(errors.contains(place), "{command} {place}: {errors}");
        }
    }
}

#[test]
fn a_folder_that_is_not_there_is_named_with_what_to_do() {
    let sandbox = Sandbox::new(STRAIGHT);
    for command in [
        "surfaces model.toml -o nowhere/x.step",
        "section model.toml --map -5 -o nowhere/x.png",
        "view model.toml --style block -o nowhere/x.png",
        "new quickstart nowhere/x.toml",
    ] {
        let errors = sandbox.refusal(command, 3);
        assert!(
            errors.contains("nowhere does not exist; make that folder"),
            "{errors}"
        );
        assert!(!errors.contains(".clinothem-"), "{errors}");
    }
    // A build makes its folder, but cannot replace a folder by a file.
    sandbox.answer("build model.toml -o out --formats none");
    std::fs::remove_file(sandbox.path("out/report.json")).unwrap();
    std::fs::create_dir(sandbox.path("out/report.json")).unwrap();
    let output = sandbox.run("build model.toml -o out --formats none");
    assert_eq!(output.status.code(), Some(3));
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(errors.contains("out/report.json"), "{errors}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_below_standard_output_is_told_with_3_and_a_closed_pipe_is_no_failure() {
    let sandbox = Sandbox::new(STRAIGHT);
    for arguments in [
        "--help",
        "--version",
        "help build",
        "new",
        "new quickstart made.toml",
        "check model.toml",
        "check model.toml --json",
        "check model.toml --set seed=x --json",
        "locate model.toml 300 200 -5",
        "locate model.toml 300 200 -5 --json",
        "schema",
        "schema --report",
        "section model.toml --map -5",
        "surfaces model.toml",
        "view model.toml --style block",
        "build model.toml --formats none -o out",
        "build model.toml --formats none -o out --json",
    ] {
        let to = |out: std::process::Stdio| {
            let mut command = sandbox.std_command();
            command.args(arguments.split(' ')).stdout(out);
            drop(std::fs::remove_file(sandbox.path("made.toml")));
            command.output().unwrap()
        };
        let full = std::fs::File::options().write(true).open("/dev/full");
        let full = to(full.unwrap().into());
        let errors = String::from_utf8(full.stderr).unwrap();
        assert_eq!(full.status.code(), Some(3), "{arguments}: {errors}");
        assert!(
            errors.contains("cannot write to standard output: No space left"),
            "{arguments}: {errors}"
        );
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let closed = to(writer.into());
        let errors = String::from_utf8(closed.stderr).unwrap();
        let wrong = arguments.contains("seed=x");
        assert_eq!(
            closed.status.code(),
            Some(i32::from(wrong)),
            "{arguments}: {errors}"
        );
        assert_eq!(errors.is_empty(), !wrong, "{arguments}: {errors}");
    }
}

#[test]
fn an_assembly_that_takes_too_long_is_refused_with_2_and_leaves_nothing() {
    let sandbox = Sandbox::of("channel-belt/channel-belt.toml");
    let errors = sandbox.refusal("build model.toml --engine occt --time-limit 1 -o out", 2);
    assert!(errors.contains("longer than 1 s"), "{errors}");
    assert!(
        errors.contains("20 bodies") && errors.contains("channel-1"),
        "the features are named: {errors}"
    );
}

#[test]
fn every_defect_of_a_model_is_told_and_nothing_is_written() {
    let sandbox = Sandbox::new(
        &STRAIGHT
            .replace("width = 60", "width = -60")
            .replace("z = [-20, 0]", "z = [0, -20]"),
    );
    for command in ["check", "build", "surfaces", "section", "view"] {
        let errors = sandbox.refusal(&format!("{command} model.toml"), 1);
        assert!(
            errors.contains("-60") && errors.contains("model.toml:6"),
            "both defects: {errors}"
        );
    }
    let output = sandbox.run("check model.toml --json");
    assert_eq!(output.status.code(), Some(1));
    let defects: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(defects["defects"].as_array().map(Vec::len), Some(2));
}

#[test]
fn a_folder_that_is_not_ours_needs_force_and_keeps_what_is_in_it() {
    let sandbox = Sandbox::new(STRAIGHT);
    std::fs::create_dir_all(sandbox.path("out/deeper")).unwrap();
    let foreign = [
        ("out/thesis.txt", "ten years of work"),
        ("out/deeper/a", "b"),
    ];
    for (name, text) in foreign {
        std::fs::write(sandbox.path(name), text).unwrap();
    }
    let errors = sandbox.refusal("build model.toml -o out", 1);
    assert!(errors.contains("--force"), "{errors}");
    sandbox.answer("build model.toml -o out --force");
    // Ours now: another build replaces its own files without being forced.
    std::fs::write(sandbox.path("out/report.json"), "old").unwrap();
    sandbox.answer("build model.toml -o out");
    assert!(
        std::fs::read_to_string(sandbox.path("out/report.json"))
            .unwrap()
            .starts_with('{')
    );
    for (name, text) in foreign {
        assert_eq!(std::fs::read_to_string(sandbox.path(name)).unwrap(), text);
    }
    let names: Vec<_> = sandbox
        .files()
        .into_iter()
        .filter(|(_, bytes)| bytes.is_some())
        .map(|(path, _)| path.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(
        names,
        [
            "model.toml",
            "a",
            "model.step",
            "report.json",
            "run.json",
            "thesis.txt",
            "volumes.csv"
        ]
    );
    sandbox.assert_no_temporaries();
}

#[test]
fn a_build_that_fails_keeps_the_results_of_the_one_before() {
    let sandbox = Sandbox::of("channel-belt/channel-belt.toml");
    sandbox.answer("build model.toml --set feature.channel.count=1 -o out");
    sandbox.refusal("build model.toml --engine occt --time-limit 1 -o out", 2);
}
