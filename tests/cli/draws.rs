//! Leaving something out changes no other draw: compared in the reports of whole builds.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::sandbox::Sandbox;

const MODEL: &str = r#"
name = "Draws"
seed = 11
[domain]
x = [0, 500]
y = [0, 500]
z = [-40, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "trunk"
kind = "channel"
count = 2
facies = "sand"
width = { uniform = [50, 80] }
depth = { triangular = [5, 6, 7] }
top = { uniform = [-12, -9] }
trajectory = { kind = "line", azimuth_deg = { uniform = [70, 110] }, center = [250, { uniform = [100, 400] }] }
[[feature]]
id = "thread"
kind = "channel"
parent = "trunk"
facies = "sand"
width = { uniform = [20, 30] }
depth = { normal = [4, 0.3], min = 3, max = 5 }
top = { uniform = [-14, -13] }
trajectory = { kind = "line", azimuth_deg = { uniform = [-10, 10] }, center = [{ uniform = [200, 300] }, 250] }
[[feature]]
id = "late"
kind = "channel"
facies = "sand"
width = { discrete = [31, 37, 41, 43] }
depth = { uniform = [4, 6] }
top = { uniform = [-34, -30] }
trajectory = { kind = "sine-generated", amplitude = 30, wavelength = { uniform = [300, 400] }, azimuth_deg = 45 }
"#;

type Drawn = BTreeMap<String, Value>;

fn drawn(sandbox: &Sandbox, arguments: &str) -> Drawn {
    let report = sandbox.json(&format!("build model.toml --json -o out {arguments}"));
    let volumes = report["volumes"].as_array().unwrap();
    let bodies = volumes.iter().filter(|volume| volume["level"] != 0);
    bodies
        .map(|volume| {
            let name = volume["name"].as_str().unwrap().to_owned();
            (name, volume["drawn"].clone())
        })
        .collect()
}

fn without(all: &Drawn, left_out: &[&str]) -> Drawn {
    let kept = all.iter().filter(|(name, _)| {
        left_out
            .iter()
            .all(|out| *name != out && !name.starts_with(&format!("{out}/")))
    });
    kept.map(|(name, values)| (name.clone(), values.clone()))
        .collect()
}

#[test]
fn leaving_out_a_feature_a_volume_or_a_level_changes_no_other_draw() {
    let sandbox = Sandbox::new(MODEL);
    let all = drawn(&sandbox, "");
    let names: Vec<&str> = all.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "late",
            "trunk-1",
            "trunk-1/thread",
            "trunk-2",
            "trunk-2/thread"
        ]
    );
    // Otherwise nothing is compared.
    for (name, values) in &all {
        assert!(
            values.as_object().is_some_and(|values| values.len() >= 3),
            "{name}: {values}"
        );
    }
    assert_ne!(all["trunk-1"], all["trunk-2"]);
    assert_ne!(all["trunk-1/thread"], all["trunk-2/thread"]);
    for (arguments, left_out) in [
        ("--without trunk-1", &["trunk-1"][..]),
        ("--without trunk", &["trunk-1", "trunk-2"]),
        ("--without late", &["late"]),
        ("--without thread", &["trunk-1/thread", "trunk-2/thread"]),
        ("--without trunk-2/thread", &["trunk-2/thread"]),
        ("--max-level 1", &["trunk-1/thread", "trunk-2/thread"]),
        ("--set feature.trunk.enabled=false", &["trunk-1", "trunk-2"]),
        ("--set feature.late.enabled=false", &["late"]),
        ("--set feature.late.width=35", &["late"]),
    ] {
        let mut some = drawn(&sandbox, arguments);
        if arguments.contains("width") {
            some.remove("late");
        }
        assert_eq!(some, without(&all, left_out), "{arguments}");
    }
    let other = drawn(&sandbox, "--seed 12");
    for (name, values) in &all {
        assert_ne!(*values, other[name], "{name} depends on the seed");
    }
}

#[test]
fn what_is_drawn_for_the_domains_own_top_is_in_the_report_and_in_its_volume() {
    let sandbox = Sandbox::of("strata/bounds.toml");
    let arguments =
        "build model.toml --json -o out --formats none --set domain.top={level={uniform=[-9,-3]}}";
    let domain = &sandbox.json(arguments)["domain"];
    let drawn = domain["drawn"].as_object().unwrap();
    assert_eq!(drawn.len(), 1, "the base is not random: {drawn:?}");
    let top = drawn["top.level"].as_f64().unwrap();
    assert!((-9.0..-3.0).contains(&top), "{top}");
    // The base is a plane, at −36 m in the middle.
    let wanted = 400.0 * 600.0 * (top + 36.0);
    let volume = domain["volume_m3"].as_f64().unwrap();
    assert!((volume / wanted - 1.0).abs() < 1e-12, "{volume} {wanted}");
}
