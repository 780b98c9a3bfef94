//! Files of triangles and of heights: what is in them, that they do not depend on threads, and what is refused.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::sandbox::{STRAIGHT, Sandbox};

/// A horizon that dips to the east, and a ball in the beds above it.
const BEDS: &str = r#"
name = "Beds"
origin = [456000, 6782000, -2000]
[domain]
x = [0, 300]
y = [0, 200]
z = [-40, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "bed"
kind = "horizon"
facies = "sand"
surface = { dipping = { through = [100, 50, -20], dip_deg = 3, azimuth_deg = 90 } }
"#;

const BALL: &str = r#"
[[feature]]
id = "ball"
kind = "ellipsoid"
facies = "mud"
center = [200, 100, -10]
semi_axes = [15, 15, 4]
"#;

fn results(sandbox: &Sandbox, folder: &str) -> BTreeMap<PathBuf, Vec<u8>> {
    let folder = sandbox.path(folder);
    let files = sandbox.files().into_iter();
    let files = files
        .filter_map(|(path, bytes)| Some((path.strip_prefix(&folder).ok()?.to_owned(), bytes?)));
    files
        .filter(|(path, _)| path.as_os_str() != "run.json")
        .collect()
}

/// Corners and triangles of a PLY file of ours.
fn ply(bytes: &[u8]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let end = b"end_header\n";
    let start = bytes
        .windows(end.len())
        .position(|window| window == end)
        .unwrap()
        + end.len();
    let header = std::str::from_utf8(&bytes[..start]).unwrap();
    let count = |what: &str| -> usize {
        let line = header
            .lines()
            .find_map(|line| line.strip_prefix(what))
            .unwrap();
        line.trim().parse().unwrap()
    };
    let (points, faces) = bytes[start..].split_at(24 * count("element vertex"));
    assert_eq!(faces.len(), 13 * count("element face"));
    let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().unwrap());
    let index = |bytes: &[u8]| u32::from_le_bytes(bytes.try_into().unwrap());
    let point = |row: &[u8]| [0, 8, 16].map(|at| number(&row[at..at + 8]));
    let face = |row: &[u8]| [1, 5, 9].map(|at| index(&row[at..at + 4]));
    (
        points.chunks(24).map(point).collect(),
        faces.chunks(13).map(face).collect(),
    )
}

fn volume(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let six: f64 = triangles
        .iter()
        .map(|triangle| {
            let [[a, b, c], [d, e, f], [g, h, i]] = triangle.map(|corner| points[corner as usize]);
            a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
        })
        .sum();
    six / 6.0
}

#[test]
fn volumes_in_all_formats_are_the_same_for_any_number_of_threads_and_close() {
    let sandbox = Sandbox::new(STRAIGHT);
    let formats = "--formats glb,stl,obj,ply,ts --quiet";
    sandbox.answer(&format!("build model.toml {formats} -o one --threads 1"));
    sandbox.answer(&format!("build model.toml {formats} -o two --threads 2"));
    let files = results(&sandbox, "one");
    assert_eq!(files, results(&sandbox, "two"));
    let names: Vec<String> = files
        .keys()
        .map(|path| path.display().to_string())
        .collect();
    for name in [
        "model.glb",
        "model.obj",
        "model.mtl",
        "stl/ditch.stl",
        "ply/background.ply",
        "ts/ditch.ts",
    ] {
        assert!(names.contains(&name.to_owned()), "{name} of {names:?}");
    }
    assert!(!names.contains(&"model.step".to_owned()));
    let report = sandbox.json("build model.toml --json -o exact --formats none");
    for entry in report["volumes"].as_array().unwrap() {
        let exact = entry["volume_m3"].as_f64().unwrap();
        let name = entry["name"].as_str().unwrap();
        let (points, triangles) = ply(&files[&PathBuf::from(format!("ply/{name}.ply"))]);
        let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for [a, b, c] in &triangles {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *sides.entry([*from.min(to), *from.max(to)]).or_default() +=
                    if from < to { 1 } else { -1 };
            }
        }
        assert!(sides.values().all(|sum| *sum == 0), "{name}");
        // 0.0002 of the diagonal of 721 m, over a skin of some 600 m by 400 m, twice.
        let off = (volume(&points, &triangles) - exact).abs();
        assert!(
            off < 0.145 * 600_000.0 && off < 0.05 * exact,
            "{name}: {off} of {exact}"
        );
    }
}

#[test]
fn a_smaller_chord_makes_more_triangles_and_a_better_volume() {
    let sandbox = Sandbox::new(STRAIGHT);
    let report = sandbox.json("build model.toml --json -o exact --formats none");
    let ditch = report["volumes"]
        .as_array()
        .unwrap()
        .iter()
        .find(|v| v["name"] == "ditch")
        .unwrap();
    let exact = ditch["volume_m3"].as_f64().unwrap();
    let mut before = (0, f64::INFINITY);
    for chord in ["0.5", "0.05", "0.005"] {
        sandbox.answer(&format!(
            "build model.toml --quiet --formats ply --chord {chord} -o out"
        ));
        let (points, triangles) = ply(&results(&sandbox, "out")[&PathBuf::from("ply/ditch.ply")]);
        let off = (volume(&points, &triangles) - exact).abs();
        assert!(
            triangles.len() > before.0 && off < 0.5 * before.1,
            "{chord}: {off} of {exact}"
        );
        before = (triangles.len(), off);
    }
}

#[test]
fn heights_of_a_dipping_plane_are_those_of_its_formula_in_the_world() {
    let sandbox = Sandbox::new(BEDS);
    sandbox.answer("surfaces model.toml --quiet --formats irap,zmap,cps3,ts --spacing 50 -o out");
    let files = results(&sandbox, "out");
    let text = |name: &str| {
        let found = files
            .iter()
            .find(|(path, _)| path.to_string_lossy().starts_with(name));
        String::from_utf8(found.unwrap().1.clone()).unwrap()
    };
    let irap = text("irap/");
    let words: Vec<f64> = irap
        .split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect();
    assert_eq!(words[..4], [-996.0, 5.0, 50.0, 50.0]);
    assert_eq!(
        words[4..8],
        [456_000.0, 456_300.0, 6_782_000.0, 6_782_200.0]
    );
    let heights = &words[19..];
    assert_eq!(heights.len(), 7 * 5);
    for (at, height) in heights.iter().enumerate() {
        let x = 50.0 * (at % 7) as f64;
        let exact = -2020.0 - (x - 100.0) * 3_f64.to_radians().tan();
        assert!((height - exact).abs() < 1e-4, "{x}: {height} {exact}");
    }
    // The same numbers in columns from north to south.
    for (name, skip) in [("zmap/", "@\n"), ("cps3/", "->")] {
        let text = text(name);
        let body = &text[text.rfind(skip).unwrap() + 2..];
        let numbers: Vec<f64> = body
            .split_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect();
        for (at, height) in numbers.iter().enumerate() {
            assert!((height - heights[at / 5]).abs() < 2e-4, "{name} {at}");
        }
        assert_eq!(numbers.len(), 35);
    }
    assert!(text("ts/").contains("ZPOSITIVE Elevation") && text("ts/").contains("\nVRTX 1 456"));
    sandbox.answer(
        "surfaces model.toml --quiet --formats irap,ts --spacing 50 --local --z depth -o local",
    );
    let local = results(&sandbox, "local");
    let irap = local
        .iter()
        .find(|(path, _)| path.starts_with("irap"))
        .unwrap()
        .1;
    let first = String::from_utf8(irap.clone())
        .unwrap()
        .split_whitespace()
        .nth(19)
        .unwrap()
        .to_owned();
    let first: f64 = first.parse().unwrap();
    assert!(
        (first - (20.0 - 100.0 * 3_f64.to_radians().tan())).abs() < 1e-4,
        "{first}"
    );
}

#[test]
fn a_surface_that_lies_over_itself_has_no_grid_but_triangles_and_others_have_one() {
    let sandbox = Sandbox::new(&format!("{BEDS}{BALL}"));
    let errors = sandbox.refusal(
        "surfaces model.toml --quiet --formats irap --spacing 5 -o out",
        1,
    );
    assert!(
        errors.contains("ball") && errors.contains("not single-valued: at x ="),
        "{errors}"
    );
    sandbox.answer("surfaces model.toml --quiet --formats ply,stl,glb,obj -o out");
    sandbox.answer("surfaces model.toml --quiet --formats irap --spacing 5 --only bed -o grids");
    assert_eq!(results(&sandbox, "grids").len(), 1);
    // A ball is a ball, trimmed or whole.
    for whole in ["", "--whole"] {
        sandbox.answer(&format!(
            "surfaces model.toml --quiet --formats ply --only ball --chord 0.05 {whole} -o ball"
        ));
        let files = results(&sandbox, "ball");
        let (points, triangles) = ply(files.iter().next().unwrap().1);
        let exact = std::f64::consts::PI / 6.0 * 30.0 * 30.0 * 8.0;
        let found = volume(&points, &triangles).abs();
        assert!((found / exact - 1.0).abs() < 0.03, "{found} {exact}");
    }
}

#[test]
fn arguments_that_make_no_triangles_or_grids_are_refused() {
    let sandbox = Sandbox::new(BEDS);
    for (arguments, words) in [
        (
            "build model.toml --formats glb --chord 0",
            "0 is not above 0",
        ),
        (
            "build model.toml --formats glb --chord -1",
            "-1 is not above 0",
        ),
        (
            "build model.toml --quiet --formats glb --chord 1e-6",
            "--chord 0.000001 is below a ten-millionth of the domain's diagonal (362.8 m)",
        ),
        (
            "build model.toml --formats glb --exaggeration x",
            "not a finite number",
        ),
        (
            "surfaces model.toml --quiet --formats irap --spacing 0.001",
            "give a spacing",
        ),
        (
            "surfaces model.toml --quiet --formats ts --only nothing",
            "there is no surface `nothing`; there are bed/",
        ),
    ] {
        let errors = sandbox.refusal(arguments, 1);
        assert!(errors.contains(words), "{arguments}: {errors}");
    }
}
