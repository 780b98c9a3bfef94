//! What somebody writes who has not read the manual: each mistake is said with its place and its remedy, and what is no
//! mistake works.

use resvg::tiny_skia::Pixmap;
use serde_json::Value;

use super::underlined::underlined;
use super::{Report, run, text};

/// Standard output and standard error of a command that ends with an exit code.
fn said(command: &str, name: &str, arguments: &[&str], code: i32) -> String {
    let output = run(command, &text("newcomer", name), arguments);
    let said = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(code), "{name}: {said:?}");
    said.concat()
}

fn assert_says(said: &str, words: &[&str]) {
    for words in words {
        assert!(said.contains(words), "“{words}” is not in:\n{said}");
    }
}

/// Every defect that `check` finds: its key's path, line, and what is underlined.
fn defects(name: &str) -> Vec<(String, usize, String)> {
    let model = text("newcomer", name);
    let output = run("check", &model, &["--json"]);
    assert_eq!(output.status.code(), Some(1));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let defects = found["defects"].as_array().unwrap().iter().map(|defect| {
        let number = |key: &str| usize::try_from(defect[key].as_u64().unwrap()).unwrap();
        let (line, from, to) = (number("line"), number("column"), number("end_column"));
        let marked = &model.lines().nth(line - 1).unwrap()[from - 1..to - 1];
        (
            defect["path"].as_str().unwrap().to_owned(),
            line,
            marked.to_owned(),
        )
    });
    defects.collect()
}

#[test]
fn children_drawn_beside_their_parent_are_told_before_and_after_they_are_built() {
    let words = [
        "6 of 6 volumes of channel lie outside of their parent valley and hold nothing",
        // The parent's place: 100 ± 150 m in y, cut off by the domain, and 20 m below −100 m.
        "x 0 to 2000, y 0 to 250, z -120 to -100",
        "set its `top` and a trajectory",
    ];
    assert_says(&said("check", "empty-child", &[], 0), &words);
    let built = said("build", "empty-child", &["--formats", "none"], 0);
    assert_says(&built, &words);
    let report = Report::case("newcomer", "empty-child");
    for k in 1..=6 {
        assert_eq!(report.size(&format!("valley/channel-{k}")), 0.0);
    }
}

#[test]
fn children_that_are_placed_in_their_parent_are_as_large_as_channels_and_nothing_is_said() {
    let placed = text("newcomer", "empty-child")
        .replace("depth = 5", "depth = 5\ntop = -104")
        .replace("count = 6", "count = 1")
        .replace(
            "{ kind = \"sine-generated\", amplitude = 60, wavelength = 600, azimuth_deg = 90 }",
            "{ kind = \"line\", from = [-200, 100], to = [2200, 100] }",
        );
    let output = run("check", &placed, &[]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(!said.contains("outside of their parent"), "{said}");
    let size = Report::of(&placed, &[]).size("valley/channel");
    // The section's area is at least that of the triangle in it and at most that of the rectangle around it.
    let around = 2000.0 * 60.0 * 5.0;
    assert!((around / 2.0..around).contains(&size), "{size}");
}

#[test]
fn a_permeability_that_is_no_number_is_a_defect_where_it_stands() {
    {
        let (name, path, marked, remedy) = (
            "perm2",
            "facies.mud.permeability",
            "\"500 mD\"",
            "write the number without quotes or unit: 500",
        );
        let found = defects(name);
        assert_eq!(found.len(), 1, "{name}: {found:?}");
        let line = text("newcomer", name)
            .lines()
            .position(|line| line.starts_with("permeability"))
            .unwrap();
        assert_eq!(found[0], (path.to_owned(), line + 1, marked.to_owned()));
        for command in ["check", "build"] {
            assert_says(&said(command, name, &[], 1), &[remedy]);
        }
        assert_eq!(
            underlined(&text("newcomer", name)),
            [format!("/{}", path.replace('.', "/"))]
        );
    }
}

#[test]
fn a_permeability_that_is_a_distribution_is_drawn() {
    let report = Report::case("newcomer", "perm");
    let drawn = report.volume("background")["properties"]["permeability"].clone();
    let [x, y, z] = [0, 1, 2].map(|axis| drawn[axis].as_f64().unwrap());
    assert!(x == y && y == z && x > 0.0, "{drawn}");
    let again = Report::case("newcomer", "perm");
    assert_eq!(
        again.volume("background")["properties"]["permeability"],
        drawn
    );
    assert_eq!(underlined(&text("newcomer", "perm")), [""; 0]);
}

#[test]
fn coordinates_in_the_world_beside_an_origin_are_a_defect_that_names_the_distance() {
    // From the domain's corner (2000, 1500) to the first point (456210, 6789180).
    let distance = 454_210.0_f64.hypot(6_787_680.0).round();
    let words = [
        "no point of the surface of feature \"h\" lies in the domain",
        &format!("{distance} m away"),
        "subtract the origin [456000, 6789000]",
    ];
    for command in ["check", "build"] {
        assert_says(&said(command, "utm", &[], 1), &words);
    }
}

/// The case with the origin subtracted, as its remedy says.
fn local() -> String {
    let model = text("newcomer", "utm");
    let points = "[[210, 180, -1601.2], [1750, 260, -1596.8], [1020, 760, -1599.5], [330, 1290, -1604.1], [1640, 1320, -1600.3]]";
    let from = model.find("[[456210").unwrap();
    let to = from + model[from..].find("]]").unwrap() + 2;
    format!("{}{points}{}", &model[..from], &model[to..])
}

#[test]
fn with_the_origin_subtracted_the_horizon_lies_in_the_domain() {
    let report = Report::of(&local(), &[]);
    // The points are 35.7 to 43.2 m above the base and within 3 m of a plane; the rest is the other's.
    let (below, above) = (report.size("background"), report.size("h"));
    let plan = 2000.0 * 1500.0;
    assert!((30.0 * plan..50.0 * plan).contains(&below), "{below}");
    assert!((below + above - 120.0 * plan).abs() < 1e-6 * plan);
}

#[test]
fn a_section_or_a_map_beside_the_domain_is_an_error_and_no_blank_picture() {
    for arguments in [
        ["--from", "456000,6789000", "--to", "458000,6790500"].as_slice(),
        &["--map", "-100"],
    ] {
        let all = [arguments, &["-o", "section.png"]].concat();
        let output = run("section", &local(), &all);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{errors}");
        assert!(errors.contains("domain"), "{errors}");
    }
    let inside = ["--from", "0,700", "--to", "2000,800", "-o", "section.png"];
    assert_eq!(run("section", &local(), &inside).status.code(), Some(0));
}

#[test]
fn editors_underline_every_wrong_key_and_value_and_nothing_around_it() {
    assert_eq!(
        underlined(&text("newcomer", "bad1")),
        [
            "/facies/mud/colour",
            "/facies/mud/permeability",
            "/facies/mud/porosity",
            "/feature/0/trajectory/amplitud",
            "/feature/0/widht",
        ]
    );
    assert_eq!(
        underlined(&text("newcomer", "bad2")),
        ["/facies/mud/permeability", "/feature/0/kind"]
    );
}

#[test]
fn check_finds_all_mistakes_at_once_each_where_it_stands() {
    let marked = |name: &str| {
        let found = defects(name).into_iter();
        found
            .map(|(_, line, marked)| (line, marked))
            .collect::<Vec<_>>()
    };
    let expected = |all: &[(usize, &str)]| {
        all.iter()
            .map(|(line, words)| (*line, (*words).to_owned()))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        marked("bad1"),
        expected(&[
            (8, "8"),
            (9, "colour"),
            (10, "\"500 mD\""),
            (15, "widht"),
            (16, "-3"),
            (17, "amplitud"),
        ])
    );
    assert_eq!(
        marked("bad2"),
        expected(&[(8, "\"500 mD\""), (11, "\"chanel\"")])
    );
    assert_says(
        &said("check", "bad2", &[], 1),
        &["did you mean \"channel\"?"],
    );
}

/// How much ink (in pixels) a line between two beds takes in each column of a wall: what is darker than either.
fn ink(pixels: &Pixmap, columns: std::ops::Range<u32>) -> Vec<f64> {
    let brightness = |x: u32, y: u32| {
        let pixel = pixels.pixel(x, y).unwrap();
        f64::from(pixel.red()) + f64::from(pixel.green()) + f64::from(pixel.blue())
    };
    // Yellow above, orange below: blue tells them apart on any wall, in shade or not.
    let is_yellow = |x: u32, y: u32| {
        let pixel = pixels.pixel(x, y).unwrap();
        let [red, green] = [pixel.red(), pixel.green()].map(f64::from);
        brightness(x, y) > 300.0 && green / red > 0.82 && green / red < 0.95
    };
    let is_orange = |x: u32, y: u32| {
        let pixel = pixels.pixel(x, y).unwrap();
        let [red, green] = [pixel.red(), pixel.green()].map(f64::from);
        brightness(x, y) > 250.0 && green / red < 0.76
    };
    let across = |x: u32| {
        // From yellow to orange in less than eight pixels.
        let from = (0..pixels.height() - 10)
            .find(|&y| is_yellow(x, y) && (2..10).any(|k| is_orange(x, y + k)))?;
        let to = (from + 1..from + 10).find(|&y| is_orange(x, y) && is_orange(x, y + 1))?;
        let (above, below) = (brightness(x, from - 2), brightness(x, to + 1));
        let ink = (from - 1..=to).map(|y| {
            let bed = f64::midpoint(above, below);
            ((bed - brightness(x, y)) / bed).clamp(0.0, 1.0)
        });
        Some(ink.sum())
    };
    columns.filter_map(across).collect()
}

#[test]
fn lines_between_beds_are_of_one_width_on_every_wall() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("view.png");
    let name = file.to_str().unwrap();
    said("view", "lines", &["--output", name], 0);
    let pixels = Pixmap::load_png(&file).unwrap();
    let width = pixels.width();
    // The western wall is on the left, the southern one on the right, each with a stretch of the line.
    let walls = [
        ink(&pixels, width / 8..width * 27 / 100),
        ink(&pixels, width * 45 / 100..width * 69 / 100),
    ];
    let means = walls.each_ref().map(|wall| {
        assert!(
            wall.len() > 100,
            "the line is seen in {} columns",
            wall.len()
        );
        let mean = wall.iter().sum::<f64>() / wall.len() as f64;
        for ink in wall {
            // A rope has holes and knots.
            assert!((0.5 * mean..1.6 * mean).contains(ink), "{ink} of {mean}");
        }
        mean
    });
    let ratio = means[0] / means[1];
    // The walls' lines run at different angles across the columns.
    assert!((0.75..1.35).contains(&ratio), "{means:?}");
}

#[test]
fn a_first_honest_model_is_built_and_its_reservoir_is_in_its_valley() {
    let checked = said("check", "valley", &[], 0);
    assert_says(&checked, &["no defects", "meshing: ", "Mesh.Algorithm = 1"]);
    let report = Report::case("newcomer", "valley");
    let block = 2000.0 * 1500.0 * 120.0;
    let volumes = report.0["volumes"].as_array().unwrap();
    let sum: f64 = volumes
        .iter()
        .map(|one| one["volume_m3"].as_f64().unwrap())
        .sum();
    assert!((sum - block).abs() < 1e-6 * block);
    for k in 1..=6 {
        // 64 to 89 m × 4 to 9 m over some 2 km, less what younger ones take and what leaves the fill.
        let size = report.size(&format!("valley/fill/channel-{k}"));
        assert!((1e4..2e6).contains(&size), "channel-{k}: {size}");
    }
}
