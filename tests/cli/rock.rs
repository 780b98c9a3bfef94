//! Rock properties in every file, and totals of blocks whose volumes are known.

use occt_bridge::read_step;
use serde_json::{Value, json};

use super::sandbox::Sandbox;

/// Two beds: 12 m of sand on 8 m of mud over 600 by 400 m; the sand dips by nothing, its permeability is a tensor.
const BEDS: &str = r#"
name = "Beds"
[domain]
x = [0, 600]
y = [0, 400]
z = [-20, 0]
facies = "mud"
[facies.mud]
net = false
porosity = 0.05
permeability = 0.5
[facies.sand]
net = 0.75
porosity = 0.25
sw = 0.2
permeability = { dip = 400, strike = 100, normal = 10 }
[[feature]]
id = "sand"
kind = "horizon"
facies = "sand"
surface = { level = -12 }
"#;

#[test]
fn totals_are_those_of_beds_of_known_thickness() {
    let sandbox = Sandbox::new(BEDS);
    let report = sandbox.json("build model.toml -o out --json --bounds");
    let (sand, mud) = (600.0 * 400.0 * 12.0, 600.0 * 400.0 * 8.0);
    let near = |value: &Value, expected: f64| {
        let value = value.as_f64().unwrap();
        assert!((value / expected - 1.0).abs() < 1e-12, "{value} {expected}");
    };
    let totals = &report["totals"];
    near(&totals["net_volume_m3"], 0.75 * sand);
    near(&totals["pore_volume_m3"], 0.25 * sand + 0.05 * mud);
    near(&totals["net_pore_volume_m3"], 0.25 * 0.75 * sand);
    near(&totals["hydrocarbon_volume_m3"], 0.25 * 0.75 * 0.8 * sand);
    near(&totals["means"]["porosity"], 0.6 * 0.25 + 0.4 * 0.05);
    assert_eq!(totals["unknown"], json!({ "sw": ["mud"] }));
    near(&report["net_to_gross"], 0.45);
    // Level layers: strike to the east, dip to the north.
    near(
        &totals["means"]["permeability"][0][0],
        0.6 * 100.0 + 0.4 * 0.5,
    );
    near(
        &totals["means"]["permeability"][1][1],
        0.6 * 400.0 + 0.4 * 0.5,
    );
    let bounds = &totals["permeability_bounds"];
    near(&bounds["harmonic_md"][2], 1.0 / (0.6 / 10.0 + 0.4 / 0.5));
    near(&bounds["arithmetic_md"][2], 0.6 * 10.0 + 0.4 * 0.5);
    let facies = report["facies"].as_array().unwrap();
    near(&facies[1]["net"], 0.75);
    assert_eq!(facies[0]["net"], 0.0);
    near(
        &facies[1]["totals"]["hydrocarbon_volume_m3"],
        0.25 * 0.75 * 0.8 * sand,
    );
    let plain = sandbox.json("build model.toml -o out --json");
    assert_eq!(
        plain["totals"].get("permeability_bounds"),
        None,
        "only if asked for"
    );
    let said = sandbox.answer("build model.toml -o out");
    assert!(
        said.contains("pore volume: 816 000 m³, mean porosity 0.1700"),
        "{said}"
    );
}

#[test]
fn every_property_is_in_the_report_the_table_step_and_locate() {
    let drawn = BEDS.replace(
        "porosity = 0.25",
        "porosity = { uniform = [0.2, 0.3] }\nage = 65",
    );
    let sandbox = Sandbox::new(&drawn);
    let report = sandbox.json("build model.toml -o out --json");
    let sand = &report["volumes"][1];
    let porosity = sand["properties"]["porosity"].as_f64().unwrap();
    assert!((0.2..0.3).contains(&porosity));
    assert_eq!(sand["drawn"]["properties.porosity"], porosity);
    assert_eq!(
        sand["properties"],
        json!({
            "net": 0.75, "porosity": porosity, "age": 65.0, "sw": 0.2,
            "permeability": [[100.0, 0.0, 0.0], [0.0, 400.0, 0.0], [0.0, 0.0, 10.0]],
        })
    );
    let table = std::fs::read_to_string(sandbox.path("out/volumes.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    let cell = |row: usize, name: &str| {
        let column = rows[0].iter().position(|title| *title == name).unwrap();
        rows[row][column]
    };
    // A tensor along the axes has no more columns than these.
    let permeability =
        |row: usize| ["x", "y", "z"].map(|axis| cell(row, &format!("permeability_{axis}_md")));
    assert_eq!(permeability(2), ["100.0", "400.0", "10.0"]);
    assert_eq!(permeability(1), ["0.5", "0.5", "0.5"]);
    assert!(!rows[0].contains(&"permeability_xy_md"));
    assert_eq!(cell(2, "porosity").parse::<f64>().unwrap(), porosity);
    assert_eq!((cell(2, "age"), cell(1, "age")), ("65.0", ""));
    let parts = read_step(&sandbox.path("out/model.step")).unwrap();
    assert_eq!(parts.len(), 2);
    let step = std::fs::read_to_string(sandbox.path("out/model.step")).unwrap();
    let description = format!(
        "'facies=sand; net=0.75; porosity={porosity}; age=65; sw=0.2; permeability_mD=100,400,10,0,0,0'"
    );
    assert!(step.contains(&description), "{description}");
    let located = sandbox.json("locate model.toml 100 100 -5 --json");
    assert_eq!(located["properties"], sand["properties"]);
    let said = sandbox.answer("locate model.toml 100 100 -15");
    assert!(said.contains("permeability: 0.5 0.5 0.5"), "{said}");
}
