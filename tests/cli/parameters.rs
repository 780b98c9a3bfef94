//! Values from files of parameters, as engines of ensembles write them, and responses for these.

use serde_json::Value;

use super::sandbox::{STRAIGHT, Sandbox};

fn with(files: &[(&str, &str)]) -> Sandbox {
    let sandbox = Sandbox::new(STRAIGHT);
    for (name, text) in files {
        std::fs::write(sandbox.path(name), text).unwrap();
    }
    sandbox
}

fn volumes(sandbox: &Sandbox, arguments: &str) -> Vec<u8> {
    sandbox.answer(&format!(
        "build model.toml --formats none --quiet -o out {arguments}"
    ));
    std::fs::read(sandbox.path("out/volumes.csv")).unwrap()
}

#[test]
fn every_form_of_a_file_of_parameters_is_the_same_as_its_overrides() {
    let forms = [
        r#"{"feature.ditch.width": 31.5, "feature.ditch.depth": 6}"#,
        // As ERT writes it.
        "{\n\"feature.ditch.width\" : {\n\"value\" : 31.5\n}, \n\"feature.ditch.depth\" : {\n\"value\" : 6.0\n}\n}",
        r#"{"SIZES": {"feature.ditch.width": 31.5}, "feature.ditch.depth": {"value": 6e0}}"#,
        // As older versions of it do, if a prior is lognormal.
        r#"{"SIZES": {"feature.ditch.width": 31.5, "feature.ditch.depth": 6.0}, "LOG10_SIZES": {"feature.ditch.width": 1.498}}"#,
        "\u{feff}{\"SIZES\": {\"feature.ditch.width\": {\"value\": 31.5}, \"feature.ditch.depth\": {\"value\": 6.0}}}",
    ];
    let sandbox = with(&[]);
    let expected = volumes(
        &sandbox,
        "--set feature.ditch.width=31.5 --set feature.ditch.depth=6",
    );
    for form in forms {
        std::fs::write(sandbox.path("parameters.json"), form).unwrap();
        let found = volumes(&sandbox, "--parameters parameters.json");
        assert!(found == expected, "{form}");
    }
}

#[test]
fn a_channel_twice_as_wide_holds_twice_as_much() {
    let sandbox = with(&[
        ("narrow.json", r#"{"feature.ditch.width": {"value": 30.0}}"#),
        ("wide.json", r#"{"feature.ditch.width": {"value": 60.0}}"#),
    ]);
    let volume = |name: &str| {
        let build = "build model.toml --formats none --json -o out --parameters";
        let report = sandbox.json(&format!("{build} {name}.json"));
        report["volumes"][1]["volume_m3"].as_f64().unwrap()
    };
    let ratio = volume("wide") / volume("narrow");
    // Volumes are integrated to some parts in ten million.
    assert!((ratio - 2.0).abs() < 1e-6, "{ratio}");
}

#[test]
fn whole_numbers_of_programs_that_know_none_are_counts_and_seeds() {
    let sandbox = with(&[(
        "parameters.json",
        r#"{"seed": {"value": 7.0}, "feature.ditch.count": {"value": 2.0}, "feature.ditch.top": {"value": -4.0}}"#,
    )]);
    let report = sandbox
        .json("build model.toml --formats none --json -o out --parameters parameters.json --set feature.ditch.trajectory.from=[0,100]");
    assert_eq!(report["model"]["seed"], 7);
    std::fs::write(
        sandbox.path("parameters.json"),
        r#"{"feature.ditch.count": 2.5}"#,
    )
    .unwrap();
    let told = sandbox.refusal("check model.toml --parameters parameters.json", 1);
    assert!(told.contains("parameters.json:1:25"), "{told}");
}

#[test]
fn what_is_said_in_the_command_wins_over_the_file() {
    let sandbox = with(&[(
        "parameters.json",
        r#"{"seed": 7, "feature.ditch.width": 30}"#,
    )]);
    let found = volumes(
        &sandbox,
        "--parameters parameters.json --set feature.ditch.width=45 --seed 9",
    );
    assert!(found == volumes(&sandbox, "--set feature.ditch.width=45 --seed 9"));
    assert!(found != volumes(&sandbox, "--set feature.ditch.width=30 --seed 9"));
}

#[test]
fn a_table_of_names_says_which_keys_they_are_and_leaves_the_others_alone() {
    let sandbox = with(&[
        (
            "parameters.json",
            r#"{"SIZE": {"value": 50.0}, "FILL": {"value": "mud"}, "OWC": {"value": 1820.5}, "spare.x": null, "G": {"p": 1}, "H": {"p": 2}}"#,
        ),
        (
            "names.toml",
            "SIZE = [\"feature.ditch.width\", \"feature.ditch.trajectory.from.2\"]\nFILL = \"feature.ditch.facies\"\n",
        ),
    ]);
    // What is not taken may be anything.
    let found = volumes(
        &sandbox,
        "--parameters parameters.json --parameter-names names.toml",
    );
    let overrides = "--set feature.ditch.width=50 --set feature.ditch.trajectory.from.2=50 --set feature.ditch.facies=mud";
    assert!(found == volumes(&sandbox, overrides));
}

#[test]
fn every_command_that_reads_a_model_takes_parameters() {
    let sandbox = with(&[("p.json", r#"{"feature.ditch.width": {"value": 100.0}}"#)]);
    let at = |arguments: &str| {
        let answer = sandbox.json(&format!(
            "locate model.toml --json {arguments} 300 165 -4.1"
        ));
        answer["volume"].as_str().map(str::to_owned)
    };
    assert_eq!(at("").as_deref(), Some("background"));
    assert_eq!(at("--parameters p.json").as_deref(), Some("ditch"));
    let log = sandbox.answer("log model.toml --at 300,165 --parameters p.json");
    assert!(log.contains("ditch"), "{log}");
    for command in [
        "check model.toml",
        "section model.toml -o section.svg",
        "grid model.toml --cells 4x4x4 -o grid",
        "surfaces model.toml -o surfaces",
    ] {
        let output = sandbox.run(&format!("{command} --parameters p.json"));
        assert!(output.status.success(), "{command}: {output:?}");
    }
    let told = sandbox.refusal("ensemble model.toml -n 2 --parameters p.json", 1);
    assert!(told.contains("write --design"), "{told}");
}

#[test]
fn what_is_wrong_with_parameters_is_told_with_its_file_place_and_remedy() {
    for (parameters, names, told) in [
        (
            r#"{"feature.ditch.widht": 3}"#,
            "",
            "p.json:1:2 did you mean `width`?",
        ),
        (
            r#"{"feature.dich.width": 3}"#,
            "",
            "p.json:1:2 did you mean \"ditch\"?",
        ),
        (r#"{"feature.ditch.width": -3}"#, "", "p.json:1:25 -3"),
        (
            "{\n\"G\": {\"CH_WIDTH\": 3}}",
            "",
            "p.json:2:7 `CH_WIDTH` is no key of the model --parameter-names",
        ),
        (
            r#"{"a b": 3}"#,
            "",
            "p.json:1:2 `a b` is not a path of keys",
        ),
        (
            r#"{"feature.ditch": 3}"#,
            "",
            "p.json:1:2 cannot be replaced as a whole",
        ),
        (
            r#"{"feature.ditch.width": null}"#,
            "",
            "p.json:1:25 write a number",
        ),
        (
            r#"{"G": {"feature.ditch.width": {"b": 1, "c": 2}}}"#,
            "",
            "p.json:1:31 `feature.ditch.width` is a table",
        ),
        (
            r#"{"G": {"seed": 1}, "H": {"seed": 2}}"#,
            "",
            "p.json:1:26 `seed` is given twice first given here",
        ),
        ("[1, 2]", "", "p.json:1:1 an object of names and values"),
        ("", "", "p.json"),
        (r#"{"seed": 1,}"#, "", "p.json:1 not valid JSON"),
        (
            r#"{"WIDTH": 3}"#,
            "WDITH = \"feature.ditch.width\"",
            "n.toml:1:1 did you mean `WIDTH`?",
        ),
        (
            r#"{"WIDTH": 3}"#,
            "WIDTH = \"feature.dich.width\"",
            "n.toml:1:9 did you mean \"ditch\"?",
        ),
        (
            r#"{"WIDTH": -3}"#,
            "WIDTH = \"feature.ditch.width\"",
            "p.json:1:11 -3",
        ),
        (
            r#"{"WIDTH": 3}"#,
            "WIDTH = []",
            "n.toml:1:9 no key of the model",
        ),
        (
            r#"{"WIDTH": 3}"#,
            "WIDTH = 4",
            "n.toml:1:9 no key of the model",
        ),
        (r#"{"WIDTH": 3}"#, "WIDTH", "n.toml:1"),
        (
            r#"{"A": 3, "B": 4}"#,
            "A = \"feature.ditch.width\"\nB = \"feature.ditch.width\"",
            "n.toml:2:5 is given twice",
        ),
    ] {
        let sandbox = with(&[("p.json", parameters), ("n.toml", names)]);
        let names = if names.is_empty() {
            ""
        } else {
            "--parameter-names n.toml"
        };
        let errors = sandbox.refusal(&format!("check model.toml --parameters p.json {names}"), 1);
        let (place, words) = told.split_once(' ').unwrap_or((told, ""));
        assert!(errors.contains(place), "{parameters}: {place}: {errors}");
        assert!(
            errors.contains("help") || errors.contains("write"),
            "{errors}"
        );
        for part in words.split("  ") {
            let all = part.split(' ').all(|word| errors.contains(word));
            assert!(all, "{parameters}: {part}: {errors}");
        }
    }
}

#[test]
fn no_key_of_the_schema_is_taken_for_a_name() {
    let sandbox = with(&[]);
    let schema = sandbox.json("schema");
    let keys = schema["properties"].as_object().unwrap();
    assert!(keys.contains_key("origin"));
    for key in keys.keys() {
        let text = format!("{{\"{key}\": false}}");
        std::fs::write(sandbox.path("p.json"), text).unwrap();
        let told = sandbox.refusal("check model.toml --parameters p.json", 1);
        assert!(!told.contains("is no key of the model"), "{key}: {told}");
    }
}

#[test]
fn files_of_parameters_that_cannot_be_read_are_named() {
    let sandbox = with(&[("names.toml", "A = \"seed\"\n")]);
    std::fs::write(sandbox.path("bytes.json"), b"{\"seed\": \xff}").unwrap();
    for (arguments, told) in [
        (
            "--parameters nowhere.json",
            "nowhere.json: the file of parameters cannot be read",
        ),
        (
            "--parameters bytes.json",
            "bytes.json: the file of parameters is not UTF-8 from its byte 9 on",
        ),
        ("--parameter-names names.toml", "--parameters"),
    ] {
        let errors = sandbox.refusal(&format!("check model.toml {arguments}"), 1);
        assert!(errors.contains(told), "{errors}");
    }
}

#[test]
fn a_response_is_a_file_of_the_number_in_the_report() {
    let sandbox = Sandbox::of("quickstart/quickstart.toml");
    sandbox.answer(
        "build model.toml --formats none --quiet -o out --responses pore_volume_m3,net_to_gross,facies.sand.volume_m3",
    );
    let report: Value =
        serde_json::from_slice(&std::fs::read(sandbox.path("out/report.json")).unwrap()).unwrap();
    let sand = report["facies"].as_array().unwrap();
    let sand = sand.iter().find(|one| one["name"] == "sand").unwrap();
    for (name, expected) in [
        ("pore_volume_m3", &report["totals"]["pore_volume_m3"]),
        ("net_to_gross", &report["net_to_gross"]),
        ("facies.sand.volume_m3", &sand["volume_m3"]),
    ] {
        let text = std::fs::read_to_string(sandbox.path(&format!("out/responses/{name}.txt")));
        let found: f64 = text.unwrap().trim_end().parse().unwrap();
        assert_eq!(Some(found), expected.as_f64(), "{name}");
    }
    let told = sandbox.refusal("build model.toml -o other --responses pore_volume", 1);
    assert!(
        told.contains("`pore_volume`") && told.contains("pore_volume_m3"),
        "{told}"
    );
}
