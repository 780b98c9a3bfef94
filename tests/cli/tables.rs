//! Tables of a build: what they hold, in closed form, and that the same model gives the same bytes.

use crate::sandbox::Sandbox;

/// Four sands one on the other in four parts of a block, two of which touch along less than the others: strips of 100 m × 300 m.
const STRIPS: &str = r#"
name = "Strips"
[domain]
x = [0, 400]
y = [0, 300]
z = [-40, 0]
facies = "shale"
[facies.shale]
net = false
porosity = 0.05
permeability = 0.01
[facies.sand]
net = true
porosity = 0.2
permeability = [9, 9, 1]
[facies.silt]
net = 0.5
porosity = 0.2
permeability = 1
[[feature]]
id = "lower"
kind = "horizon"
facies = "sand"
surface = { level = -36 }
[[feature]]
id = "middle"
kind = "horizon"
facies = "silt"
surface = { level = -30 }
[[feature]]
id = "seal"
kind = "horizon"
facies = "shale"
surface = { level = -24 }
[[feature]]
id = "upper"
kind = "horizon"
facies = "sand"
surface = { level = -3 }
"#;

#[test]
fn three_to_one_hangs_together_with_a_chance_of_five_eighths() {
    let sandbox = Sandbox::new(STRIPS);
    let report = sandbox.json("build model.toml --formats none --json");
    let area = 400.0 * 300.0;
    // Net: 6 m of sand and half of 6 m of silt, then 3 m of sand: 9 m to 3 m.
    let web = &report["connectivity"];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let near = |value: &serde_json::Value, exact: f64| {
        let found = number(value);
        assert!(
            (found - exact).abs() < 1e-9 * exact.max(1.0),
            "{found} is {exact}"
        );
    };
    near(&web["gamma"], 0.625);
    near(&web["largest_share"], 0.75);
    assert_eq!(
        web["groups"][0]["solids"],
        serde_json::json!(["lower", "middle"])
    );
    near(&web["groups"][1]["net_volume_m3"], 3.0 * area);
    // Contacts of net solids: shale-lower, lower-middle, middle-seal, seal-upper; one of four is between two of them.
    near(&web["amalgamation"], 0.25);
    near(&report["net_to_gross"], 12.0 / 40.0);
    let units = report["units"].as_array().unwrap();
    let ratios: Vec<f64> = units
        .iter()
        .map(|unit| number(&unit["net_to_gross"]))
        .collect();
    let exact = [0.0, 1.0, 0.5, 0.0, 1.0];
    assert!(
        ratios
            .iter()
            .zip(exact)
            .all(|(one, exact)| (one - exact).abs() < 1e-12),
        "{ratios:?}"
    );
    // Of 12 m, 9 m with 9 mD and 3 m with 1 mD at one porosity: L = (1 − 3/12) · 9 · 9 / 84 … by areas under two straight lines.
    let (flow, store) = (81.0 / 84.0, 0.75);
    let under = flow * store / 2.0 + (1.0 - store) * (flow + 1.0) / 2.0;
    near(&report["heterogeneity"]["lorenz"], 2.0 * (under - 0.5));
    near(&report["heterogeneity"]["dykstra_parsons"], 1.0 - 1.0 / 9.0);
    // With more area asked for than there is, all fall apart.
    let apart = sandbox.json("build model.toml --formats none --json --least-area 120001");
    assert_eq!(apart["connectivity"]["groups"].as_array().unwrap().len(), 3);
}

#[test]
fn what_does_not_say_whether_it_is_net_is_named() {
    let silent = STRIPS.replace("net = 0.5\n", "");
    let sandbox = Sandbox::new(&silent);
    let said = sandbox.answer("build model.toml --formats none");
    assert!(
        said.contains("net-to-gross: not known, since `net` is not given for silt"),
        "{said}"
    );
    let report = std::fs::read_to_string(sandbox.path("model-out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(
        report["units"][2]["unknown_net"],
        serde_json::json!(["silt"])
    );
    assert_eq!(report["units"][1]["net_to_gross"], 1.0);
}

#[test]
fn tables_have_the_same_bytes_each_time_and_only_those_asked_for_are_there() {
    let sandbox = Sandbox::new(STRIPS);
    sandbox.answer("build model.toml --formats none,xlsx,csv -o one");
    sandbox.answer("build model.toml --formats csv,xlsx -o two --threads 1");
    let names = [
        "model.xlsx",
        "volumes.csv",
        "facies.csv",
        "units.csv",
        "sand-bodies.csv",
        "measures.csv",
        "neighbours.csv",
        "drawn.csv",
    ];
    for name in names {
        let read = |folder: &str| std::fs::read(sandbox.path(folder).join(name)).unwrap();
        assert!(read("one") == read("two"), "{name} differs");
    }
    let count = |folder: &str| std::fs::read_dir(sandbox.path(folder)).unwrap().count();
    assert_eq!([count("one"), count("two")], [names.len() + 2; 2]);
    sandbox.answer("build model.toml --formats none -o three");
    assert_eq!(count("three"), 3);
    let neighbours = std::fs::read_to_string(sandbox.path("one/neighbours.csv")).unwrap();
    let lines: Vec<&str> = neighbours.lines().collect();
    assert_eq!(
        lines[0],
        "volume,neighbour,area_m2,facies,neighbour_facies,both_net"
    );
    assert_eq!(lines[1], "background,lower,120000.000000,shale,sand,no");
    assert_eq!(lines[2], "lower,middle,120000.000000,sand,silt,yes");
}

#[test]
fn a_least_area_below_nothing_is_refused() {
    let sandbox = Sandbox::new(STRIPS);
    let errors = sandbox.refusal("build model.toml --least-area -1", 1);
    assert!(errors.contains("least area is -1"), "{errors}");
    sandbox.refusal("build model.toml --least-area nan", 1);
}
