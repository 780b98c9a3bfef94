//! What the program answers: help, JSON, points whose volume is known in closed form, bytes.

use std::process::Stdio;

use clinothem::model::TEMPLATES;
use serde_json::Value;

use crate::sandbox::{STRAIGHT, Sandbox};

const COMMANDS: [&str; 8] = [
    "new", "check", "build", "surfaces", "locate", "section", "view", "schema",
];

#[test]
fn the_help_of_every_command_has_an_example_of_it() {
    let sandbox = Sandbox::new(STRAIGHT);
    let overview = sandbox.answer("--help");
    for command in COMMANDS {
        assert!(overview.contains(&format!("\n  {command} ")), "{overview}");
        for help in [format!("{command} --help"), format!("help {command}")] {
            let text = sandbox.answer(&help);
            let example = text.split("Example").nth(1).unwrap_or_default();
            assert!(
                example.contains(&format!("clinothem {command}")),
                "{help} has no example:\n{text}"
            );
        }
    }
    assert!(!overview.contains("worker"), "not for users: {overview}");
}

#[test]
fn examples_in_help_are_commands_that_the_program_knows() {
    // An example that clap would refuse is worse than none.
    let sandbox = Sandbox::new(STRAIGHT);
    for command in COMMANDS {
        let text = sandbox.answer(&format!("{command} --help"));
        let examples = text.split("Example").nth(1).unwrap_or_default();
        for line in examples.lines() {
            let Some(arguments) = line.trim().strip_prefix("clinothem ") else {
                continue;
            };
            let arguments = arguments.split("  ").next().unwrap_or_default();
            let arguments = arguments.split('>').next().unwrap_or_default();
            // Any file will do, if only it is missing: then nothing but the arguments was read.
            let output = sandbox.run(&arguments.replace(".toml", "-missing.toml"));
            let errors = String::from_utf8(output.stderr).unwrap();
            let refused = errors.contains("Usage:");
            assert!(!refused, "`clinothem {arguments}`: {errors}");
        }
    }
}

#[test]
fn machines_read_json_from_standard_output_and_nothing_else() {
    let sandbox = Sandbox::of("quickstart/quickstart.toml");
    let checked = sandbox.json("check model.toml --json");
    assert_eq!(checked["features"].as_array().map(Vec::len), Some(2));
    let located = sandbox.json("locate model.toml 300 200 -19 --json");
    assert_eq!(located["volume"], "background");
    let report = sandbox.json("build model.toml -o out --formats step,ply --json");
    let written: Value =
        serde_json::from_slice(&std::fs::read(sandbox.path("out/report.json")).unwrap()).unwrap();
    assert_eq!(report, written, "what is printed is what is written");
    let run: Value =
        serde_json::from_slice(&std::fs::read(sandbox.path("out/run.json")).unwrap()).unwrap();
    assert!(run["seconds"]["total"].as_f64() > Some(0.0));
    // Of the files, what takes long is told by itself.
    for part in ["files, step", "files, triangles"] {
        let seconds = run["seconds"][part].as_f64();
        assert!(seconds > Some(0.0) && seconds < run["seconds"]["files"].as_f64());
    }
    for (schema, instance) in [("schema --report", Some(&report)), ("schema", None)] {
        let schema = sandbox.json(schema);
        let validator = jsonschema::validator_for(&schema).unwrap();
        if let Some(instance) = instance {
            let errors: Vec<_> = validator.iter_errors(instance).collect();
            assert!(errors.is_empty(), "{errors:?}");
        }
    }
    sandbox.assert_no_temporaries();
}

#[test]
fn a_quiet_build_says_nothing() {
    let sandbox = Sandbox::new(STRAIGHT);
    assert_eq!(sandbox.answer("build model.toml --quiet"), "");
    assert!(sandbox.path("model-out/model.step").is_file());
}

/// A point of the section's base by de Boor's recursion, as an offset from the middle and a depth.
///
/// Seven control points on a uniform clamped cubic, as the section's documentation has them: banks at
/// 0.65 of the depth and a fifth of the way to the thalweg, the thalweg's neighbours at 0.45 of the way to
/// the nearer rim.
fn base(width: f64, depth: f64, asymmetry: f64, u: f64) -> [f64; 2] {
    let (half, thalweg) = (width / 2.0, asymmetry * width);
    let spread = 0.45 * (half - thalweg.abs());
    let mut points = [
        [-half, 0.0],
        [-half + 0.2 * (half + thalweg), 0.65 * depth],
        [thalweg - spread, depth],
        [thalweg, depth],
        [thalweg + spread, depth],
        [half - 0.2 * (half - thalweg), 0.65 * depth],
        [half, 0.0],
    ];
    let knots = [0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0, 1.0];
    let span = (3..7).rfind(|i| knots[*i] <= u).unwrap_or(3);
    for level in 1..=3 {
        for i in (span - 3 + level..=span).rev() {
            let t = (u - knots[i]) / (knots[i + 4 - level] - knots[i]);
            let before = points[i - 1];
            for (value, previous) in points[i].iter_mut().zip(before) {
                *value = (1.0 - t) * previous + t * *value;
            }
        }
    }
    points[span]
}

#[test]
fn locate_agrees_with_the_closed_form_of_a_straight_channel() {
    let sandbox = Sandbox::new(STRAIGHT);
    let volume = |y: f64, z: f64| {
        let answer = sandbox.json(&format!("locate model.toml 217.3 {y} {z} --json"));
        answer["volume"].as_str().unwrap().to_owned()
    };
    // Looking east, right is south: the thalweg lies 0.2 · 60 m south of the middle, and 8 m deep.
    assert_eq!(base(60.0, 8.0, 0.2, 0.5), [12.0, 8.0]);
    assert_eq!(volume(188.0, -11.9999), "ditch");
    assert_eq!(volume(188.0, -12.0001), "background");
    for step in 1..16 {
        let [offset, depth] = base(60.0, 8.0, 0.2, f64::from(step) / 16.0);
        let y = 200.0 - offset;
        // A centimetre above and below the base; nothing is above the top.
        assert_eq!(volume(y, -4.0 - depth + 0.01), "ditch", "{offset} {depth}");
        assert_eq!(volume(y, -4.0 - depth - 0.01), "background");
        assert_eq!(volume(y, -3.9999), "background");
    }
    assert_eq!(volume(229.999, -4.0001), "ditch");
    assert_eq!(volume(230.001, -4.0001), "background");
    assert_eq!(volume(170.001, -4.0001), "ditch");
    assert_eq!(volume(169.999, -4.0001), "background");
}

#[test]
fn a_point_on_a_face_belongs_to_the_younger_and_names_both() {
    let sandbox = Sandbox::new(STRAIGHT);
    for (z, on) in [(-4.0, true), (-12.0, true), (-11.0, false), (-3.0, false)] {
        let answer = sandbox.json(&format!("locate model.toml 300 188 {z} --json"));
        let names: Vec<&str> = answer["boundary_of"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(Value::as_str)
            .collect();
        if on {
            assert_eq!(names, ["background", "ditch"], "z = {z}");
            assert_eq!(answer["volume"], "ditch");
        } else {
            assert_eq!(names, [""; 0], "z = {z}");
        }
    }
    let text = sandbox.answer("locate model.toml 300 188 -12");
    assert!(text.contains("on the boundary of background and ditch"));
}

#[test]
fn a_reader_that_goes_away_is_no_reason_to_panic() {
    let sandbox = Sandbox::new(STRAIGHT);
    for arguments in [
        "--help",
        "schema",
        "check model.toml",
        "check model.toml --json",
        "locate model.toml 300 200 -5",
        "build model.toml -o out",
        "build model.toml -o out --json",
        "build nothing.toml",
    ] {
        let mut child = sandbox
            .std_command()
            .args(arguments.split(' '))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(!errors.contains("panicked"), "{arguments}: {errors}");
        let expected = i32::from(arguments.contains("nothing"));
        assert_eq!(output.status.code(), Some(expected), "{arguments}");
    }
}

#[test]
fn the_same_model_gives_the_same_bytes_on_one_thread_and_on_many() {
    // Six bodies of the belt, several of them crossing.
    let sandbox = Sandbox::of("channel-belt/channel-belt.toml");
    let build = "build model.toml --set feature.channel.count=6 --quiet -o";
    sandbox.answer(&format!(
        "{build} one --threads 1 --formats step,step-shared,brep"
    ));
    sandbox.answer(&format!(
        "{build} many --threads 7 --formats step,step-shared,brep"
    ));
    sandbox.answer(&format!("{build} default --formats step,step-shared,brep"));
    let read = |folder: &str, name: &str| {
        std::fs::read(sandbox.path(&format!("{folder}/{name}"))).unwrap()
    };
    for name in [
        "model.step",
        "model.shared.step",
        "model.brep",
        "report.json",
        "volumes.csv",
    ] {
        let one = read("one", name);
        assert!(one == read("many", name), "{name} differs with 7 threads");
        assert!(one == read("default", name), "{name} differs by default");
    }
    let report: Value = serde_json::from_slice(&read("one", "report.json")).unwrap();
    assert!(report["assembly"]["crossing_pairs"].as_u64() > Some(0));
}

#[test]
fn the_general_fuse_alone_builds_a_model_with_a_horizon() {
    let text = "name = \"One\"\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-30, 0]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n\
        [[feature]]\nid = \"unit\"\nkind = \"horizon\"\nfacies = \"sand\"\n\
        surface = { dipping = { through = [200, 150, -12], dip_deg = 2, azimuth_deg = 30 } }\n";
    let sandbox = Sandbox::new(text);
    let report = sandbox.json("build model.toml --engine occt --formats none -o out --json");
    let text = report.to_string();
    assert!(text.contains("\"engine\":\"occt\""), "{text}");
    // The plane passes through the middle of the domain's plan.
    let volumes = report["volumes"].as_array().unwrap();
    let unit = volumes.iter().find(|one| one["name"] == "unit").unwrap();
    let size = unit["volume_m3"].as_f64().unwrap();
    assert!((size / (400.0 * 300.0 * 12.0) - 1.0).abs() < 1e-6, "{size}");
}

#[test]
fn every_template_is_listed_and_written_and_one_pair_is_one_pair() {
    let sandbox = Sandbox::new(STRAIGHT);
    let listed = sandbox.answer("new");
    for template in TEMPLATES {
        let start = format!("{} ", template.name);
        let line = listed.lines().find(|line| line.starts_with(&start));
        assert!(
            line.is_some_and(|line| line.ends_with(template.about)),
            "{listed}"
        );
        // Two may write files of one name.
        sandbox.answer(&format!("new {} --force", template.name));
        let written = std::fs::read_to_string(sandbox.path(&template.file_name())).unwrap();
        assert!(written == template.text, "{}", template.name);
    }
    let said = sandbox.answer("build quickstart.toml --formats none");
    assert!(said.contains("1 pair of bodies crosses;"), "{said}");
}
