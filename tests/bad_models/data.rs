//! Surfaces from files: keys that say nothing, files that are not there, data that are elsewhere, upside down or broken.

use std::path::Path;

use clinothem::model::{Defects, Format, Model, Source};

use super::edited;

const MODEL: &str = r#"
name = "Data"
origin = [456000, 6782000]
[domain]
x = [0, 300]
y = [0, 200]
z = [-1100, -900]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "top"
kind = "horizon"
facies = "sand"
surface = { file = "top.xyz", tolerance = 0.5 }
"#;

/// Columns of x, y and z over the domain and beyond it, as a function of local coordinates has them.
fn written(mut at: impl FnMut(f64, f64) -> [f64; 3]) -> String {
    let mut lines = Vec::new();
    for i in -2..=8 {
        for j in -2..=6 {
            let [x, y, z] = at(50.0 * f64::from(i), 50.0 * f64::from(j));
            lines.push(format!("{x} {y} {z}\n"));
        }
    }
    lines.concat()
}

fn height(x: f64, y: f64) -> f64 {
    -1000.0 + 0.1 * x - 0.05 * y
}

fn good() -> String {
    written(|x, y| [456_000.0 + x, 6_782_000.0 + y, height(x, y)])
}

fn check(folder: &Path, text: &str) -> Result<Model, Defects> {
    Model::check(&Source::from_text("data.toml", text, Format::Toml).in_folder(folder))
}

/// What is said of a model whose file holds this.
fn said(model: &str, file: &str) -> (Defects, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("top.xyz"), file).unwrap();
    let defects = check(folder.path(), model).expect_err(model);
    let words: Vec<&str> = defects
        .iter()
        .flat_map(|defect| [defect.message(), defect.remedy()])
        .collect();
    let words = words.join("\n");
    (defects, words)
}

/// The keys that are broken here alone.
pub(crate) const KEYS_OF_FILES: &[&str] = &[
    "columns",
    "file",
    "format",
    "null",
    "plan_unit",
    "positive",
    "unit",
    "world",
];

/// Finds this in the model, puts that in its place, expects these words.
#[rustfmt::skip]
const KEYS: &[(&str, &str, &[&str])] = &[
    ("\"top.xyz\"", "▸\"nowhere.xyz\"", &["there is no such file", "begins at the model file's folder"]),
    ("\"top.xyz\"", "▸\".\"", &["this is no file"]),
    ("\"top.xyz\"", "▸7", &["expected text", "double quotes"]),
    ("surface = { file = \"top.xyz\", tolerance = 0.5 }", "surface = ▸{ file = \"top.xyz\" }", &["neither `tolerance` nor `smooth`", "tolerance = 0.5"]),
    ("surface = { file", "surface = ▸{ smooth = 1, file", &["a `tolerance` and a `smooth`"]),
    ("tolerance = 0.5", "tolerance = ▸0", &["is 0; it must be above 0"]),
    ("tolerance = 0.5", "smooth = ▸-1", &["is -1; it must be above 0"]),
    ("tolerance = 0.5", "tolerance = 0.5, format = ▸\"zmpa\"", &["no format \"zmpa\"", "did you mean"]),
    ("tolerance = 0.5", "tolerance = 0.5, positive = ▸\"downwards\"", &["positive \"downwards\"", "\"down\" for depths"]),
    ("tolerance = 0.5", "tolerance = 0.5, unit = ▸\"feet\"", &["no unit \"feet\"", "\"ft\" (0.3048 m)"]),
    ("tolerance = 0.5", "tolerance = 0.5, plan_unit = ▸\"miles\"", &["unit \"miles\""]),
    ("tolerance = 0.5", "tolerance = 0.5, world = ▸\"yes\"", &["expected true or false"]),
    ("tolerance = 0.5", "tolerance = 0.5, null = ▸\"none\"", &["stands for no data", "null = -999.25"]),
    ("tolerance = 0.5", "tolerance = 0.5, columns = ▸{ x = 1, y = 2 }", &["has no `z`", "columns = { x ="]),
    ("file = \"top.xyz\", tolerance = 0.5", "level = -1000, unit = ▸\"ft\"", &["a `unit` without `file`", "remove it"]),
    ("surface = { file", "surface = ▸{ level = -1000, file", &["has 2 forms: level, file"]),
    ("tolerance = 0.5", "tolerance = 0.5, ▸postive = \"down\"", &["unknown key `postive`", "did you mean `positive`?"]),
];

#[test]
fn keys_that_say_nothing_are_told_with_place_and_remedy() {
    for (find, replace, words) in KEYS {
        let (text, place) = edited(MODEL, find, replace);
        let (defects, all) = said(&text, &good());
        let first = defects.iter().next().unwrap().place();
        assert_eq!(
            Some((first.line, first.column)),
            place,
            "{replace}\n{defects}"
        );
        for word in *words {
            assert!(all.contains(word), "{replace}: {word}\n{defects}");
        }
        assert_eq!(defects.count(), 1, "{defects}");
    }
    for key in KEYS_OF_FILES {
        let broken = format!(", {key} = ▸");
        let is_broken = |row: &(&str, &str, &[&str])| row.1.contains(&broken);
        let is_file = *key == "file";
        assert!(is_file || KEYS.iter().any(is_broken), "{key}");
    }
}

#[test]
fn data_that_are_elsewhere_upside_down_or_in_feet_are_told_with_what_to_write() {
    let local = written(|x, y| [x, y, height(x, y)]);
    let feet = written(|x, y| [456_000.0 + x, 6_782_000.0 + y, height(x, y) / 0.3048]);
    let depths = written(|x, y| [456_000.0 + x, 6_782_000.0 + y, -height(x, y)]);
    let no_origin = MODEL.replace("origin = [456000, 6782000]\n", "");
    let not_world = MODEL.replace("tolerance = 0.5", "tolerance = 0.5, world = false");
    let down = MODEL.replace("tolerance = 0.5", "tolerance = 0.5, positive = \"down\"");
    let nulls = format!("{}456100 6782100 -99999\n", good());
    let outlier = format!("{}456101 6782101 -1090\n", good());
    let above = format!("{}456100 6782100 -980\n", good());
    for (model, file, words) in [
        (MODEL, &local, "write world = false"),
        (&not_world, &good(), "leave `world = false` out"),
        (&no_origin, &good(), "origin = [455900, 6781900]"),
        (MODEL, &depths, "write positive = \"down\""),
        (&down, &good(), "write positive = \"up\""),
        (MODEL, &feet, "write unit = \"ft\""),
        (MODEL, &nulls, "write null = -99999"),
        (MODEL, &outlier, "misses the height at line"),
        (MODEL, &above, "heights above one another"),
        (
            MODEL,
            &"456000 6782000 -1000\n456100 6782100 -1000\n".to_owned(),
            "lie on one line",
        ),
    ] {
        let (_, all) = said(model, file);
        assert!(all.contains(words), "{words}\n{all}");
    }
    // Noise that is greater than was said.
    let mut sign = 1.0;
    let rough = written(|x, y| {
        sign = -sign;
        [456_000.0 + x, 6_782_000.0 + y, height(x, y) + 3.0 * sign]
    });
    let (_, all) = said(&MODEL.replace("tolerance", "smooth"), &rough);
    assert!(
        all.contains("scatter by") && all.contains("write smooth = "),
        "{all}"
    );
}

#[test]
fn broken_files_are_told_with_their_line_at_the_place_that_names_them() {
    for (file, words) in [
        ("", "the file is empty"),
        (
            "456000 6782000 -1000\n456100 67821o0 -1000\n",
            "line 2: \"67821o0\" is no number",
        ),
        (
            "-996 3 50 50\n0 100 0 100\n3 0 0 0\n0 0 0 0 0 0 0\n1 2 3 4 5 6 7\n",
            "ends at line 5 with 7 of 9 heights",
        ),
        (
            "@a, GRID, 1\n10, -999, , 2, 1\n2, 2, 0, 9\n",
            "line 3: expected NROW, NCOL",
        ),
        (
            "FSASCI 0 1 \"Computed\" 0 1E30\nFSLIMI 0 1 0 1 0 1\n1 2 3 4\n",
            "FSNROW is missing",
        ),
        (
            "GOCAD TSurf 1\nVRTX 1 0 0 0\nTRGL 1 2 3\nEND\n",
            "line 3: there is no vertex 2",
        ),
        (
            "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\n1 2 3 4\n",
            "cellsize is missing",
        ),
        ("X,Z,Depth\n1,2,3\n", "no column is \"y\""),
        ("<html>\n<p>404\n", "begins no format that is known"),
        ("II*\0", "a GeoTIFF"),
    ] {
        let (defects, all) = said(MODEL, file);
        assert!(all.contains(words), "{words}\n{all}");
        let place = defects.iter().next().unwrap().place();
        assert_eq!((place.line, place.column), (15, 20), "{defects}");
    }
}

#[test]
fn good_data_are_taken_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("top.xyz"), good()).unwrap();
    let model = check(folder.path(), MODEL).unwrap_or_else(|defects| panic!("{defects}"));
    assert!(model.notes.is_empty(), "{:?}", model.notes);
    let (of, file) = model.files().next().unwrap();
    assert_eq!((of, file.format, file.heights), ("top", "XYZ", 99));
    let at = file.fitted.horizon.height(120.0, 70.0);
    assert!((at - height(120.0, 70.0)).abs() < 1e-6, "{at}");
    // In feet, as depths, about another datum, in local coordinates.
    let feet = written(|x, y| [x, y, (25.0 - height(x, y)) / 0.3048]);
    std::fs::write(folder.path().join("top.xyz"), feet).unwrap();
    let other = MODEL.replace(
        "tolerance = 0.5",
        "tolerance = 0.5, positive = \"down\", unit = \"ft\", world = false",
    );
    let other = other.replace("z = [-1100, -900]", "z = [-1125, -925]");
    let model = check(folder.path(), &other).unwrap_or_else(|defects| panic!("{defects}"));
    let at = model
        .files()
        .next()
        .unwrap()
        .1
        .fitted
        .horizon
        .height(120.0, 70.0);
    assert!((at - height(120.0, 70.0) + 25.0).abs() < 1e-6, "{at}");
}

/// A model with a bed whose thickness comes from `thickness.xyz`, beside the surface below it.
const BED: &str = r#"
[[feature]]
id = "bed"
kind = "horizon"
facies = "mud"
surface = { above = "top", thickness = { file = "thickness.xyz", tolerance = 0.5 } }
"#;

#[rustfmt::skip]
const THICKNESSES: &[(&str, &str, &[&str])] = &[
    ("\"thickness.xyz\"", "▸\"nowhere.xyz\"", &["there is no such file", "the thickness below the surface of feature \"bed\""]),
    ("file = \"thickness.xyz\", tolerance", "file = \"thickness.xyz\", positive = ▸\"down\", tolerance", &["a thickness points nowhere", "remove it"]),
    ("{ file = \"thickness.xyz\", tolerance = 0.5 }", "▸{ file = \"thickness.xyz\" }", &["neither `tolerance` nor `smooth`"]),
    ("file = \"thickness.xyz\", tolerance", "points = [[0, 0, 1], [9, 0, 1], [0, 9, 1]], unit = ▸\"ft\", tolerance", &["a `unit` without `file`"]),
    ("{ file = \"thickness.xyz\", tolerance = 0.5 }", "▸{ file = \"thickness.xyz\", points = [[0, 0, 1], [9, 0, 1], [0, 9, 1]], tolerance = 0.5 }", &["has 2 forms: points, file"]),
    ("file = \"thickness.xyz\", tolerance", "file = \"thickness.xyz\", ▸unti = \"ft\", tolerance", &["unknown key `unti`", "did you mean `unit`?"]),
];

#[test]
fn thicknesses_from_files_that_say_nothing_or_are_none_are_told() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("top.xyz"), good()).unwrap();
    let model = format!("{MODEL}{BED}");
    let with = |thickness: &dyn Fn(f64, f64) -> f64| {
        let file = written(|x, y| [456_000.0 + x, 6_782_000.0 + y, thickness(x, y)]);
        std::fs::write(folder.path().join("thickness.xyz"), file).unwrap();
    };
    with(&|x, _| 0.05 * (x + 100.0));
    assert!(check(folder.path(), &model).is_ok());
    for (find, replace, words) in THICKNESSES {
        let (text, place) = edited(&model, find, replace);
        let defects = check(folder.path(), &text).expect_err(&text);
        let first = defects.iter().next().unwrap();
        let own = (first.place().line, first.place().column);
        assert_eq!(Some(own), place, "{replace}\n{defects}");
        let all = format!("{}\n{}", first.message(), first.remedy());
        for word in *words {
            assert!(all.contains(word), "{replace}: {word}\n{defects}");
        }
    }
    // What no thickness can be: nulls, and feet in a domain that is 200 m high.
    for (thickness, words) in [
        (
            &(|x: f64, _: f64| if x > 250.0 { -999.25 } else { 5.0 }) as &dyn Fn(f64, f64) -> f64,
            "write null = -999.25",
        ),
        (&|x: f64, _: f64| 250.0 + 0.1 * x, "write unit = \"ft\""),
    ] {
        with(thickness);
        let said = check(folder.path(), &model).expect_err(words).to_string();
        assert!(said.contains(words), "{said}");
    }
}
