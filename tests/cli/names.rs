//! What things are called: models from standard input, volumes by the end of their names, display names in every file.

use occt_bridge::read_step;
use serde_json::Value;

use super::sandbox::{STRAIGHT, Sandbox};

/// The straight channel with a lag, and names in several alphabets.
fn named() -> String {
    let lag =
        "[[feature]]\nid = \"lag\"\nkind = \"lag\"\nparent = \"ditch\"\nfacies = \"gravel\"\n";
    let text = STRAIGHT
        .replace("name = \"Straight\"", "name = \"Grøft 水路\"")
        .replace(
            "[facies.sand]",
            "[facies.sand]\nname = \"Песок\"\n[facies.gravel]",
        )
        .replace(
            "id = \"ditch\"",
            "id = \"ditch\"\nname = \"Brent Næss 上部\"",
        );
    format!("{text}{lag}")
}

#[test]
fn display_names_of_any_alphabet_are_in_the_report_the_table_the_summary_and_step() {
    let sandbox = Sandbox::new(&named());
    let said = sandbox.answer("build model.toml -o out");
    assert!(said.contains("ditch (Brent Næss 上部)"), "{said}");
    assert!(said.contains("ditch/lag (Brent Næss 上部/lag)"), "{said}");
    assert!(said.contains("Песок: "), "{said}");
    let report: Value =
        serde_json::from_slice(&std::fs::read(sandbox.path("out/report.json")).unwrap()).unwrap();
    let names: Vec<(&str, Option<&str>)> = report["volumes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| (one["name"].as_str().unwrap(), one["display_name"].as_str()))
        .collect();
    assert_eq!(
        names,
        [
            ("background", None),
            ("ditch", Some("Brent Næss 上部")),
            ("ditch/lag", Some("Brent Næss 上部/lag")),
        ]
    );
    assert_eq!(report["model"]["name"], "Grøft 水路");
    let table = std::fs::read_to_string(sandbox.path("out/volumes.csv")).unwrap();
    assert!(
        table.contains("\nditch/lag,Brent Næss 上部/lag,"),
        "{table}"
    );
    // The kernel reads what programs show; identifiers stay the names.
    let parts = read_step(&sandbox.path("out/model.step")).unwrap();
    let shown: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(
        shown,
        ["background", "Brent Næss 上部", "Brent Næss 上部/lag"]
    );
    let text = std::fs::read_to_string(sandbox.path("out/model.step")).unwrap();
    assert!(text.is_ascii());
    for product in [
        "PRODUCT('ditch/lag','Brent N\\X2\\00E6\\X0\\ss \\X2\\4E0A90E8\\X0\\/lag',",
        "PRODUCT('ditch with children','Brent N\\X2\\00E6\\X0\\ss \\X2\\4E0A90E8\\X0\\ with children',",
        "PRODUCT('Groft Shui Lu','Gr\\X2\\00F8\\X0\\ft \\X2\\6C348DEF\\X0\\',",
    ] {
        assert!(text.contains(product), "{product}");
    }
    sandbox.answer("surfaces model.toml -o surfaces.step");
    let parts = read_step(&sandbox.path("surfaces.step")).unwrap();
    assert!(
        parts.iter().any(|part| part.name == "Brent Næss 上部/base"),
        "{parts:?}"
    );
}

#[test]
fn each_of_several_has_the_name_with_its_number() {
    let text = named().replace("kind = \"channel\"", "kind = \"channel\"\ncount = 2");
    let text = text.replace("top = -4", "top = { uniform = [-9, -1] }");
    let sandbox = Sandbox::new(&text);
    let report = sandbox.json("build model.toml --formats none --json -o out");
    let volumes = report["volumes"].as_array().unwrap();
    let labels: Vec<&str> = volumes
        .iter()
        .filter_map(|one| one["display_name"].as_str())
        .collect();
    assert_eq!(
        labels,
        [
            "Brent Næss 上部 1",
            "Brent Næss 上部 1/lag",
            "Brent Næss 上部 2",
            "Brent Næss 上部 2/lag",
        ]
    );
}

#[test]
fn a_model_comes_from_standard_input_in_toml_or_json() {
    let sandbox = Sandbox::new("");
    let ask = |text: &str, arguments: &[&str]| {
        let mut command = sandbox.command();
        command.args(arguments).write_stdin(text).output().unwrap()
    };
    let json = serde_json::to_string(&toml::from_str::<toml::Value>(STRAIGHT).unwrap()).unwrap();
    for text in [STRAIGHT, &json] {
        let output = ask(text, &["locate", "-", "300", "188", "-8", "--json"]);
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(found["volume"], "ditch");
    }
    let output = ask(STRAIGHT, &["build", "-", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert!(sandbox.path("model-out/model.step").is_file());
    // Defects name the stream and the line.
    let output = ask(&STRAIGHT.replace("width", "widht"), &["check", "-"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("standard input:14:1"), "{said}");
    let output = ask("", &["check", "-"]);
    assert!(
        String::from_utf8(output.stderr)
            .unwrap()
            .contains("the file is empty")
    );
}

#[test]
fn a_volume_that_lies_in_one_place_is_left_out_by_the_end_of_its_name() {
    let text = named().replace(
        "kind = \"lag\"",
        "kind = \"ellipsoid\"\ncount = 2\nsemi_axes = [3, 3, 1]",
    );
    let sandbox = Sandbox::new(&text);
    let names = |arguments: &str| {
        let checked = sandbox.json(&format!("check model.toml --json{arguments}"));
        let features = checked["features"].as_array().unwrap();
        let lag = features.iter().find(|one| one["id"] == "lag");
        lag.map(|lag| lag["volumes"].as_u64().unwrap())
    };
    assert_eq!(names(""), Some(2));
    assert_eq!(names(" --without lag-2"), Some(1));
    assert_eq!(names(" --without ditch/lag-2"), Some(1));
    assert_eq!(names(" --without lag"), None);
    let several =
        Sandbox::new(&text.replace("kind = \"channel\"", "kind = \"channel\"\ncount = 3"));
    let said = several.refusal("check model.toml --without lag-2", 1);
    for place in ["ditch-1/lag-2", "ditch-2/lag-2", "ditch-3/lag-2"] {
        assert!(said.contains(place), "{said}");
    }
}
