//! What is said of models that are right, and still not what their author meant.

use serde_json::Value;

use crate::sandbox::{STRAIGHT, Sandbox};

/// Standard error of a command that succeeds.
fn said(sandbox: &Sandbox, arguments: &str) -> String {
    let output = sandbox.run(arguments);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{arguments}: {errors}");
    errors
}

fn report(sandbox: &Sandbox) -> Value {
    serde_json::from_slice(&std::fs::read(sandbox.path("out/report.json")).unwrap()).unwrap()
}

/// Children of a valley in the south-west that are drawn over the whole domain.
const CHILDREN: &str = r#"
name = "Empty children"
[domain]
x = [0, 2000]
y = [0, 1500]
z = [-140, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "valley"
kind = "channel"
facies = "mud"
width = 300
depth = 20
top = -100
trajectory = { kind = "line", from = [-200, 100], to = [2200, 100] }
[[feature]]
id = "channel"
kind = "channel"
parent = "valley"
count = 6
facies = "sand"
width = 60
depth = 5
trajectory = { kind = "sine-generated", amplitude = 60, wavelength = 600, azimuth_deg = 90 }
"#;

#[test]
fn children_that_miss_their_parent_are_counted_with_what_to_set() {
    let sandbox = Sandbox::new(CHILDREN);
    let words = "6 of 6 volumes of channel lie outside of their parent valley and hold nothing";
    let checked = sandbox.answer("check model.toml");
    assert!(checked.contains(words), "{checked}");
    assert!(
        checked.contains("set its `top` and a trajectory (`center`"),
        "{checked}"
    );
    // 100 ± 150 m in y, 20 m below −100 m: the parent as it is written, cut off by the domain.
    assert!(
        checked.contains("x 0 to 2000, y 0 to 250, z -120 to -100"),
        "{checked}"
    );
    let built = said(&sandbox, "build model.toml -o out");
    assert!(built.contains(words), "{built}");
    let report = report(&sandbox);
    assert!(report["notes"].to_string().contains(words), "{report}");
    assert_eq!(report["empty"], Value::Array(Vec::new()), "told once");
    assert_eq!(checked.matches("hold nothing").count(), 1, "{checked}");
    assert_eq!(said(&sandbox, "build model.toml -o out --quiet"), "");
}

#[test]
fn a_child_beside_a_slanting_parent_is_outside_though_their_boxes_meet() {
    // The parent runs from the south-west to the north-east; the child lies in the north-west.
    let text = CHILDREN
        .replace(
            "from = [-200, 100], to = [2200, 100]",
            "from = [-200, -150], to = [2200, 1650]",
        )
        .replace("count = 6", "top = -102")
        .replace(
            "kind = \"sine-generated\", amplitude = 60, wavelength = 600, azimuth_deg = 90",
            "kind = \"line\", from = [100, 1300], to = [400, 1300]",
        );
    let checked = Sandbox::new(&text).answer("check model.toml");
    let words = "valley/channel lies outside of its parent valley and holds nothing";
    assert!(checked.contains(words), "{checked}");
    // 900 m to the east and 400 m to the south it lies across the valley.
    let inside = text.replace(
        "[100, 1300], to = [400, 1300]",
        "[1000, 900], to = [1300, 900]",
    );
    let checked = Sandbox::new(&inside).answer("check model.toml");
    assert!(!checked.contains("outside of"), "{checked}");
}

#[test]
fn children_within_their_parent_are_not_spoken_of() {
    let inside = CHILDREN
        .replace(
            "width = 60\ndepth = 5",
            "width = 60\ndepth = 5\ntop = { uniform = [-112, -101] }",
        )
        .replace(
            "azimuth_deg = 90 }",
            "azimuth_deg = 90, center = [1000, { uniform = [60, 140] }] }",
        );
    let sandbox = Sandbox::new(&inside);
    let checked = sandbox.answer("check model.toml");
    assert!(!checked.contains("hold nothing"), "{checked}");
    assert_eq!(said(&sandbox, "build model.toml -o out"), "");
}

#[test]
fn a_volume_that_younger_ones_remove_wholly_is_told_by_check_and_build() {
    // A second channel, wider and deeper, on the course of the first.
    let buried = format!(
        "{STRAIGHT}[[feature]]\nid = \"valley\"\nkind = \"channel\"\nfacies = \"mud\"\nwidth = 200\ndepth = 15\ntop = -2\n\
         trajectory = {{ kind = \"line\", from = [-50, 200], to = [650, 200] }}\n"
    );
    let sandbox = Sandbox::new(&buried);
    let checked = sandbox.answer("check model.toml");
    assert!(
        checked.contains("note: ditch seems to hold nothing"),
        "{checked}"
    );
    let built = said(&sandbox, "build model.toml -o out");
    assert!(built.contains("note: ditch holds nothing"), "{built}");
    let report = report(&sandbox);
    let solids = report["volumes"][1]["solids"].as_array().unwrap();
    assert_eq!(
        (report["volumes"][1]["name"].as_str(), solids.len()),
        (Some("ditch"), 0)
    );
}

#[test]
fn a_unit_that_clinoforms_divide_is_not_called_empty() {
    let sandbox = Sandbox::of("parasequence/parasequence.toml");
    let checked = sandbox.answer("check model.toml");
    assert!(checked.contains("  divides "), "{checked}");
    assert!(!checked.contains("flooding seems"), "{checked}");
    // The units have no solids of their own, and that is what dividing means.
    let report = sandbox.json("build model.toml --json --formats none -o out");
    let volumes = report["volumes"].as_array().unwrap();
    let solid = |volume: &Value| !volume["solids"].as_array().unwrap().is_empty();
    assert!(
        volumes
            .iter()
            .any(|volume| volume["kind"] == "horizon" && !solid(volume))
    );
    let said = report["empty"].to_string();
    assert!(!said.contains("flooding holds"), "{said}");
    // Belts of clinothems that lie basinward of the domain.
    let without = |set: &str| {
        let of_set = volumes.iter().filter(|volume| volume["feature"] == set);
        let count = of_set.filter(|volume| !solid(volume)).count();
        format!("{count} of ")
    };
    for set in ["lower", "upper"] {
        let words = format!("volumes of {set} hold nothing");
        let (before, _) = said.split_once(&words).unwrap();
        assert!(before.contains(&without(set)), "{said}");
    }
}

#[test]
fn a_build_prints_the_notes_that_check_prints_unless_it_is_quiet() {
    let sandbox = Sandbox::new(&format!("{STRAIGHT}[facies.coal]\n"));
    let note = "nothing is of the facies `coal`";
    assert!(sandbox.answer("check model.toml").contains(note));
    let built = said(&sandbox, "build model.toml -o out");
    assert_eq!(built.matches(note).count(), 1, "{built}");
    assert!(
        built.contains("note: model.toml:"),
        "with its place: {built}"
    );
    assert!(report(&sandbox)["notes"].to_string().contains(note));
    assert_eq!(said(&sandbox, "build model.toml -o out --quiet"), "");
}

/// A horizon from well tops.
fn tops(points: &str) -> String {
    format!(
        "name = \"UTM\"\norigin = [456000, 6789000]\n[domain]\nx = [0, 2000]\ny = [0, 1500]\nz = [-1640, -1520]\nfacies = \"a\"\n\
         [facies.a]\n[facies.b]\n[[feature]]\nid = \"h\"\nkind = \"horizon\"\nfacies = \"b\"\n\
         surface = {{ points = [{points}], tolerance = 0.1 }}\n"
    )
}

#[test]
fn tops_in_world_coordinates_are_refused_with_the_origin_to_subtract() {
    let sandbox = Sandbox::new(&tops(
        "[456210, 6789180, -1601.2], [457750, 6789260, -1596.8], [457020, 6789760, -1599.5]",
    ));
    for command in ["check", "build", "section"] {
        let errors = sandbox.refusal(&format!("{command} model.toml"), 1);
        assert!(
            errors.contains("no point of the surface of feature \"h\" lies in the domain"),
            "{errors}"
        );
        assert!(
            errors.contains("subtract the origin [456000, 6789000]"),
            "{errors}"
        );
    }
    // The same without the origin: what is right, and nothing to say.
    let sandbox = Sandbox::new(&tops(
        "[210, 180, -1601.2], [1750, 260, -1596.8], [1020, 760, -1599.5]",
    ));
    assert!(!sandbox.answer("check model.toml").contains("note"));
}

#[test]
fn tops_beside_the_domain_are_noted_and_depths_without_a_sign_are_told() {
    let beside = Sandbox::new(&tops(
        "[2100, 180, -1601], [2900, 260, -1597], [2500, 760, -1600]",
    ));
    let checked = beside.answer("check model.toml");
    assert!(
        checked.contains("the nearest, (2100, 180), is 100 m away"),
        "{checked}"
    );
    assert!(said(&beside, "build model.toml -o out").contains("is 100 m away"));
    let unsigned = Sandbox::new(&tops(
        "[210, 180, 1601.2], [1750, 260, 1596.8], [1020, 760, 1599.5]",
    ));
    let checked = unsigned.answer("check model.toml");
    assert!(checked.contains("lies above the domain"), "{checked}");
    assert!(
        checked.contains("turn the sign of its heights"),
        "{checked}"
    );
}

#[test]
fn a_section_beside_the_domain_is_refused_and_one_that_touches_it_is_drawn() {
    let sandbox = Sandbox::new(STRAIGHT);
    for line in [
        "--from 700,0 --to 800,400",
        "--from 456000,6789000 --to 456600,6789400",
        "--fence -100,-100 --fence -50,600 --fence -10,700",
    ] {
        let errors = sandbox.refusal(&format!("section model.toml {line}"), 1);
        assert!(errors.contains("meets nothing of the model"), "{errors}");
        assert!(errors.contains("x [0.0, 600.0]"), "{errors}");
    }
    sandbox.answer("section model.toml --from 500,0 --to 700,0");
}
