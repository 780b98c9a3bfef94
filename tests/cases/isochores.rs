//! Horizons given by their thickness above another one: volumes in closed form.

use super::Report;
use super::spline::{Grid, integral};

/// The plan: 1 km × 800 m (m²).
const PLAN: f64 = 8e5;
/// What the continuation below 0 may take from a wedge, as a fraction of the largest volume.
const ENDS: f64 = 2e-4;

/// A domain from -100 m to 0 with horizons, each with a facies of its own.
fn model(domain: &str, horizons: &[(&str, &str)]) -> String {
    let mut text = format!(
        "name = \"isochores\"\n[domain]\nx = [0, 1000]\ny = [0, 800]\nz = [-100, 0]\nfacies = \"rock\"\n{domain}\n[facies.rock]\n"
    );
    for (id, rest) in horizons {
        let own =
            format!("[[feature]]\nid = \"{id}\"\nkind = \"horizon\"\nfacies = \"rock\"\n{rest}\n");
        text.push_str(&own);
    }
    text
}

/// Heights that undulate by some metres: 6 columns, 5 rows.
const BENT: &str = "grid = { x = [0, 1000], y = [0, 800], heights = [
    [-70, -64, -66, -71, -73, -70], [-68, -62, -63, -69, -72, -71], [-66, -63, -61, -66, -70, -72],
    [-69, -66, -64, -65, -68, -70], [-72, -70, -66, -64, -66, -69]] }";
/// 20 m in the west, nothing from the middle on.
const WEDGE: &str =
    "{ grid = { x = [0, 1000], y = [0, 800], heights = [[20, 10, 0, 0, 0], [20, 10, 0, 0, 0]] } }";
/// 15 m in the south, nothing from the middle on.
const SOUTHERN: &str = "{ grid = { x = [0, 1000], y = [0, 800], heights = [[15, 15], [7.5, 7.5], [0, 0], [0, 0], [0, 0]] } }";

fn bent() -> String {
    format!("surface = {{ {BENT} }}")
}

fn above(other: &str, thickness: &str, relation: &str) -> String {
    format!(
        "surface = {{ above = \"{other}\", thickness = {thickness} }}\nrelation = \"{relation}\""
    )
}

/// What lies below the bent horizon (m³).
fn below_bent() -> f64 {
    let table: toml::Table = format!("surface = {{ {BENT} }}").parse().unwrap();
    let grid = Grid::of(&table["surface"]);
    integral(&[&grid], |z| z[0] + 100.0)
}

#[test]
fn beds_of_constant_thickness_have_it_everywhere() {
    let text = model(
        "",
        &[
            ("h1", &bent()),
            ("h2", &above("h1", "12.5", "erosive")),
            ("h3", &above("h2", "0.25", "onlapping")),
        ],
    );
    let below = below_bent();
    let sizes = [
        ("background", below),
        ("h1", 12.5 * PLAN),
        ("h2", 0.25 * PLAN),
        ("h3", 100.0 * PLAN - below - 12.75 * PLAN),
    ];
    Report::of(&text, &[]).assert_sizes(&sizes, 1e-7);
    // Left out, a horizon is still the reference of those above it.
    let without = [
        ("background", below),
        ("h1", 12.75 * PLAN),
        ("h3", 100.0 * PLAN - below - 12.75 * PLAN),
    ];
    Report::of(&text, &["--without", "h2"]).assert_sizes(&without, 1e-7);
    let without = [
        ("background", below + 12.5 * PLAN),
        ("h2", 0.25 * PLAN),
        ("h3", 100.0 * PLAN - below - 12.75 * PLAN),
    ];
    Report::of(&text, &["--without", "h1"]).assert_sizes(&without, 1e-7);
}

#[test]
fn a_bed_ends_where_its_thickness_is_none_and_what_is_below_stays_as_it_is() {
    let below = below_bent();
    let wedge = 20.0 * 500.0 / 2.0 * 800.0;
    for relation in ["erosive", "onlapping"] {
        let text = model(
            "",
            &[("h1", &bent()), ("h2", &above("h1", WEDGE, relation))],
        );
        let report = Report::of(&text, &[]);
        report.assert_sizes(
            &[
                ("background", below),
                ("h1", wedge),
                ("h2", 100.0 * PLAN - below - wedge),
            ],
            ENDS,
        );
        let miss = report.size("background") / below - 1.0;
        assert!(miss.abs() < 1e-6, "{relation}: {miss}");
        assert_eq!((report.pieces("h1"), report.pieces("background")), (1, 1));
        assert!(report.decides("between h1 and h2 is absent", "x from 500 to 1000"));
    }
}

#[test]
fn where_two_beds_end_each_ends_by_itself() {
    let text = model(
        "",
        &[
            ("h1", &bent()),
            ("h2", &above("h1", WEDGE, "erosive")),
            ("h3", &above("h2", SOUTHERN, "erosive")),
        ],
    );
    let below = below_bent();
    let (wedge, southern) = (20.0 * 500.0 / 2.0 * 800.0, 15.0 * 400.0 / 2.0 * 1000.0);
    let report = Report::of(&text, &[]);
    report.assert_sizes(
        &[
            ("background", below),
            ("h1", wedge),
            ("h2", southern),
            ("h3", 100.0 * PLAN - below - wedge - southern),
        ],
        1e-3,
    );
    assert_eq!((report.pieces("h1"), report.pieces("h2")), (1, 1));
    let miss = report.size("background") / below - 1.0;
    assert!(miss.abs() < 1e-6, "{miss}");
}

#[test]
fn a_body_below_a_bed_that_ends_is_cut_where_the_bed_is_absent_too() {
    // A level channel from the western to the eastern wall, 6 m below the reference at its top.
    let level = "surface = { level = -60 }";
    let channel = "[[feature]]\nid = \"c\"\nkind = \"channel\"\nfacies = \"rock\"\nwidth = 60\ndepth = 8\ntop = -55\n\
         trajectory = { kind = \"line\", from = [-100, 400], to = [1100, 400] }\n";
    let base = model("", &[("h1", level)]);
    let upper = format!(
        "[[feature]]\nid = \"h2\"\nkind = \"horizon\"\nfacies = \"rock\"\n{}\n",
        above("h1", WEDGE, "erosive")
    );
    let report = Report::of(&format!("{base}{channel}{upper}"), &[]);
    // Below the level the channel is whole; above it, as far as the wedge is thick.
    let alone = Report::of(&format!("{base}{channel}"), &[]);
    let below = 40.0 * PLAN - alone.size("background");
    let cut = report.size("c");
    assert!(cut > below && cut < alone.size("c"), "{below} {cut}");
    assert!((report.size("background") - alone.size("background")).abs() < 1e-3);
    // In the west, where the wedge is 5 m or thicker, it has its section; 3 m of it are below the level in the east.
    let whole = alone.size("c") / 1000.0;
    assert!(cut > 375.0 * whole && cut < 500.0 * whole + 500.0 * below / 1000.0);
}

/// Thickness of a cone (m): 20 m at the centre, falling evenly to nothing 300 m from it.
fn cone(x: f64, y: f64) -> f64 {
    (20.0 * (1.0 - (x - 500.0).hypot(y - 400.0) / 300.0)).max(0.0)
}

/// A bed with a cone's thickness above a bent horizon has the cone's volume, but for a share, and nothing else changes.
fn assert_cone(thickness: &str, share: f64) {
    let text = model(
        "",
        &[("h1", &bent()), ("h2", &above("h1", thickness, "erosive"))],
    );
    let report = Report::of(&text, &[]);
    let cone = std::f64::consts::PI * 300.0 * 300.0 * 20.0 / 3.0;
    let miss = report.size("h1") / cone - 1.0;
    assert!(miss.abs() < share, "{miss}");
    assert_eq!((report.pieces("h1"), report.pieces("h2")), (1, 1));
    assert!((report.size("background") / below_bent() - 1.0).abs() < 1e-6);
}

#[test]
fn a_dome_of_thickness_at_points_ends_at_its_foot() {
    let mut points = Vec::new();
    for i in 0..=25 {
        for j in 0..=20 {
            let (x, y) = (40.0 * f64::from(i), 40.0 * f64::from(j));
            let thickness = cone(x, y);
            points.push(format!("[{x}, {y}, {thickness}]"));
        }
    }
    let thickness = format!("{{ points = [{}], tolerance = 1 }}", points.join(", "));
    assert_cone(&thickness, 0.03);
}

#[test]
fn a_cone_of_thickness_on_a_grid_ends_at_its_foot() {
    let rows: Vec<String> = (0..=40)
        .map(|j| {
            let row: Vec<String> = (0..=50)
                .map(|i| {
                    let (x, y) = (20.0 * f64::from(i), 20.0 * f64::from(j));
                    cone(x, y).to_string()
                })
                .collect();
            format!("[{}]", row.join(", "))
        })
        .collect();
    let thickness = format!(
        "{{ grid = {{ x = [0, 1000], y = [0, 800], heights = [{}] }} }}",
        rows.join(", ")
    );
    assert_cone(&thickness, 2e-3);
}

#[test]
fn a_thickness_that_is_drawn_is_in_the_report_and_the_same_whatever_is_left_out() {
    let thickness = "{ uniform = [5, 15] }";
    let text = model(
        "",
        &[("h1", &bent()), ("h2", &above("h1", thickness, "erosive"))],
    );
    let drawn = |report: &Report| {
        let features = report.volume("h2").clone();
        features["drawn"]["surface.thickness"].as_f64().unwrap()
    };
    let all = Report::of(&text, &[]);
    let own = drawn(&all);
    assert!((5.0..15.0).contains(&own));
    assert!((all.size("h1") / PLAN - own).abs() < 1e-6);
    let alone = Report::of(&text, &["--without", "h1"]);
    assert_eq!(drawn(&alone), own);
}

#[test]
fn below_the_least_thickness_a_bed_is_absent() {
    // A level, and an export of it that differs by centimetres in the east.
    let noisy = "surface = { grid = { x = [0, 1000], y = [0, 800], heights = [
        [-50, -62, -70.02, -70, -70.03, -70], [-50, -62, -70, -70.01, -70, -69.98], [-50, -62, -69.99, -70, -70.02, -70],
        [-50, -62, -70, -70.02, -69.99, -70], [-50, -62, -70, -70, -70.01, -70]] } }";
    let text = model(
        "least_thickness = 0.05",
        &[("h1", "surface = { level = -70 }"), ("h2", noisy)],
    );
    let report = Report::of(&text, &[]);
    assert_eq!(report.pieces("h1"), 1);
    let words = "between h1 and h2 is absent, and the surface of h1 stays";
    assert!(report.decides(words, "x from 400 to 1000"));
    let miss = report.size("background") / (30.0 * PLAN) - 1.0;
    assert!(miss.abs() < 1e-6, "{miss}");
    // 20 m in the west and 8 m after 200 m: straight on, the bed ends after a third of a kilometre.
    let bed = 20.0 * (1000.0 / 3.0) / 2.0 * 800.0;
    let miss = report.size("h1") / bed - 1.0;
    assert!(miss.abs() < 1e-2, "{miss}");
}

#[test]
fn no_thickness_anywhere_is_no_bed() {
    let zero = "{ grid = { x = [0, 1000], y = [0, 800], heights = [[0, 0, 0], [0, 0, 0]] } }";
    for thickness in ["0", zero] {
        let text = model(
            "",
            &[("h1", &bent()), ("h2", &above("h1", thickness, "erosive"))],
        );
        let below = below_bent();
        let report = Report::of(&text, &[]);
        assert!((report.size("background") / below - 1.0).abs() < 1e-6);
        assert!((report.size("h2") / (100.0 * PLAN - below) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn the_beds_of_the_committed_model_are_as_thick_as_it_says() {
    let text = include_str!("../../models/isochores/isochores.toml");
    let report = Report::of(text, &["--proof", "full"]);
    let plan = 3000.0 * 2000.0;
    let case: toml::Table = text.parse().unwrap();
    let structure = Grid::of(&case["feature"][0]["surface"]);
    let below = integral(&[&structure], |z| z[0] + 130.0);
    let (sheet, wedge) = (12.0 * plan, 18.0 * 1500.0 / 2.0 * 2000.0);
    let lobe = std::f64::consts::PI * 800.0 * 800.0 * 15.0 / 2.0;
    let sizes = [
        ("background", below),
        ("sheet-sand", sheet),
        ("shale", wedge),
        ("lobe", lobe),
        ("cover", 110.0 * plan - below - sheet - wedge - lobe),
    ];
    // The lobe's foot is told by nodes 200 m from each other, and the splines of two beds that end cross there.
    report.assert_sizes(&sizes, 1.5e-3);
    for (name, _) in sizes {
        assert_eq!(report.pieces(name), 1, "{name}");
    }
    assert!((report.size("background") / below - 1.0).abs() < 1e-7);
    assert!(report.decides("between shale and lobe is absent", "3000000 m²"));
}
