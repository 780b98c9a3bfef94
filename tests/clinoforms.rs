//! Clinoform sets as solids, made by the partition kernel alone and proven in full.
//!
//! The oracle is the formula of the sheets itself (two ellipses, a power in between), integrated on a grid of points
//! from the numbers that were drawn: no spline and no kernel.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use assembled::{Built, checked, source, without};
use clinothem::assembly::{Engine, measure::Piece};
use clinothem::model::Model;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::{DVec2, DVec3};

fn built(model: Model) -> Built {
    Built::new(model, &Selection::default(), Engine::Partition).unwrap()
}

fn from_text(text: &str) -> Model {
    assembled::from_text(text, &[])
}

fn of_file(name: &str, seed: u64) -> Model {
    let mut model = checked(&source(&format!("{name}/{name}")));
    model.seed = seed;
    model
}

fn drawn(realisation: &Realisation, parameter: &str) -> f64 {
    let all = realisation.instances.iter().flat_map(|one| &one.drawn);
    let mut found = all.filter(|(name, _)| name == parameter);
    found
        .next()
        .unwrap_or_else(|| panic!("{parameter} was not drawn"))
        .1
}

const SET: &str = r#"
name = "set"
seed = 5
[domain]
x = [0, 900]
y = [0, 400]
z = [-20, 0]
facies = "sand"
[facies.sand]
[[feature]]
id = "set"
kind = "clinoforms"
facies = "sand"
azimuth_deg = AZIMUTH
sheets = 4
first = { uniform = [100, 150] }
spacing = { uniform = [40, 120] }
length = { uniform = [150, 700] }
"#;

/// A sheet's formula.
struct Sheet {
    origin: f64,
    length: f64,
}

const TD: f64 = 3000.0;
const TS: f64 = 6000.0;

impl Sheet {
    /// The sheet's part of the unit's height.
    fn height(&self, d: f64, q: f64) -> f64 {
        let ellipse = |td: f64, ts: f64| self.origin + td * (1.0 - (q / ts).powi(2)).sqrt();
        let (top, base) = (ellipse(TD, TS), ellipse(TD + self.length, TS + self.length));
        let s = ((base - d) / (base - top)).clamp(0.0, 1.0);
        s.powi(2)
    }
}

/// Sizes of all clinothems, oldest first, by sums over a grid of points.
fn by_formula(sheets: &[Sheet], azimuth: f64, low: DVec3, high: DVec3) -> Vec<f64> {
    const CELLS: [u32; 2] = [1800, 800];
    let dip = DVec2::new(azimuth.sin(), azimuth.cos());
    let strike = DVec2::new(dip.y, -dip.x);
    let middle = (low + high).truncate() / 2.0;
    let size = high - low;
    let cell = size.x * size.y / f64::from(CELLS[0] * CELLS[1]);
    let mut sums = vec![0.0; sheets.len() + 1];
    for i in 0..CELLS[0] {
        for j in 0..CELLS[1] {
            let part = DVec2::new(
                (f64::from(i) + 0.5) / f64::from(CELLS[0]),
                (f64::from(j) + 0.5) / f64::from(CELLS[1]),
            );
            let at = low.truncate() + part * size.truncate() - middle;
            let (d, q) = (at.dot(dip), at.dot(strike));
            let mut below = 0.0_f64;
            for (k, sheet) in sheets.iter().enumerate() {
                // A younger sheet ends where it meets an older one.
                let above = sheet.height(d, q).max(below);
                sums[k] += (above - below) * size.z * cell;
                below = above;
            }
            sums[sheets.len()] += (1.0 - below) * size.z * cell;
        }
    }
    sums
}

/// The four sheets of `SET` as they were drawn, and the block's corners.
fn sheets(made: &Built, azimuth: f64) -> (Vec<Sheet>, DVec3, DVec3) {
    let extent = made.owners.extent();
    let (low, high) = (extent.low(), extent.high());
    let sheets = sheets_of(&made.realisation, azimuth, [low, high]);
    (sheets, low, high)
}

fn sheets_of(realisation: &Realisation, azimuth: f64, [low, high]: [DVec3; 2]) -> Vec<Sheet> {
    let dip = DVec2::new(azimuth.to_radians().sin(), azimuth.to_radians().cos());
    let half = (high - low).truncate() / 2.0;
    let up_dip = -(half.x * dip.x.abs() + half.y * dip.y.abs());
    let mut origin = up_dip - TD;
    let sheets = (1..=4).map(|k| {
        origin += match k {
            1 => drawn(realisation, "first"),
            _ => drawn(realisation, &format!("spacing-{k}")),
        };
        let length = drawn(realisation, &format!("length-{k}"));
        Sheet { origin, length }
    });
    sheets.collect()
}

#[test]
fn clinothems_have_the_sizes_that_their_formula_gives_for_any_direction() {
    let mut landings = 0;
    for azimuth in [0.0_f64, 90.0, 137.0, 180.0, 270.0, 320.0] {
        let made = built(from_text(&SET.replace("AZIMUTH", &azimuth.to_string())));
        let (sheets, low, high) = sheets(&made, azimuth);
        let toe = |sheet: &Sheet| sheet.origin + sheet.length;
        landings += sheets
            .windows(2)
            .filter(|two| toe(&two[1]) < toe(&two[0]))
            .count();
        let wanted = by_formula(&sheets, azimuth.to_radians(), low, high);
        let names = ["background", "set-1", "set-2", "set-3", "set-4"];
        let block = (high - low).element_product();
        for (name, wanted) in names.iter().zip(wanted) {
            let size = made.size(name);
            // The sum over points is good to about 1e-6 of the block.
            assert!(
                (size - wanted).abs() < 5e-6 * block,
                "{azimuth}°: {name} is {size}, not {wanted}"
            );
        }
        assert!(made.assembly.failed.is_empty());
    }
    assert!(
        landings > 5,
        "too few sheets that land on older ones: {landings}"
    );
}

/// Whether the toes of two sheets cross at a strike that the domain has at that place.
fn toes_cross(sheets: &[Sheet], azimuth: f64, [low, high]: [DVec3; 2]) -> bool {
    let dip = DVec2::new(azimuth.sin(), azimuth.cos());
    let strike = DVec2::new(dip.y, -dip.x);
    let half = (high - low).truncate() / 2.0;
    let toe = |sheet: &Sheet, q: f64| {
        sheet.origin + (TD + sheet.length) * (1.0 - (q / (TS + sheet.length)).powi(2)).sqrt()
    };
    let reach = half.length();
    let steps = 2000;
    let crosses = |a: &Sheet, b: &Sheet| {
        (0..steps).any(|k| {
            let q = |k: i32| reach * (2.0 * f64::from(k) / f64::from(steps) - 1.0);
            let off = |q: f64| toe(a, q) - toe(b, q);
            let place = toe(a, q(k)) * dip + q(k) * strike;
            place.abs().cmplt(0.98 * half).all() && off(q(k)) * off(q(k + 1)) < 0.0
        })
    };
    (0..sheets.len()).any(|i| (0..i).any(|j| crosses(&sheets[i], &sheets[j])))
}

#[test]
fn clinothems_whose_toes_cross_on_their_base_have_the_sizes_that_their_formula_gives() {
    let mut crossing = 0;
    for seed in 1..400 {
        let azimuth = f64::from(seed * 37 % 360);
        let text = SET
            .replace("seed = 5", &format!("seed = {seed}"))
            .replace("x = [0, 900]", "x = [0, 6000]")
            .replace("y = [0, 400]", "y = [0, 5000]")
            .replace("[100, 150]", "[2500, 3000]")
            .replace("AZIMUTH", &azimuth.to_string());
        let model = from_text(&text);
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let (low, high) = (realisation.extent.low(), realisation.extent.high());
        let sheets = sheets_of(&realisation, azimuth, [low, high]);
        if !toes_cross(&sheets, azimuth.to_radians(), [low, high]) {
            continue;
        }
        crossing += 1;
        let made = built(model);
        let wanted = by_formula(&sheets, azimuth.to_radians(), low, high);
        let names = ["background", "set-1", "set-2", "set-3", "set-4"];
        let block = (high - low).element_product();
        for (name, wanted) in names.iter().zip(wanted) {
            let size = made.size(name);
            // The sum over points is good to about 1e-6 of the block.
            assert!(
                (size - wanted).abs() < 5e-6 * block,
                "seed {seed}, {azimuth}°: {name} is {size}, not {wanted}"
            );
        }
        assert!(made.assembly.failed.is_empty(), "seed {seed}");
        if crossing == 6 {
            return;
        }
    }
    panic!("only {crossing} sets have toes that cross");
}

/// Two sets of four sheets in one unit, the second one with a first step and a length of its own.
fn twice(first: f64, length: f64, toe: &str) -> String {
    let set = |id: &str, first: f64, length: f64| {
        format!(
            "[[feature]]\nid = \"{id}\"\nkind = \"clinoforms\"\nfacies = \"sand\"\nazimuth_deg = 320\nsheets = 4\n\
             first = {first}\nspacing = 150\nlength = {length}\n{toe}"
        )
    };
    let (domain, _) = SET.split_once("[[feature]]").unwrap();
    format!(
        "{domain}{}{}",
        set("a", 100.0, 400.0),
        set("b", first, length)
    )
}

#[test]
fn a_set_that_is_there_already_leaves_nothing_to_the_same_one_again() {
    for toe in ["", "toe = 0.3\n", "exponent = 1.5\n"] {
        let text = twice(100.0, 400.0, toe);
        let (alone, _) = text.rsplit_once("[[feature]]").unwrap();
        let (alone, both) = (built(from_text(alone)), built(from_text(&text)));
        for name in ["background", "a-1", "a-2", "a-3", "a-4"] {
            assert_eq!(both.size(name), alone.size(name), "{name}");
        }
        for k in 1..=4 {
            assert_eq!(both.size(&format!("b-{k}")), 0.0);
        }
    }
}

#[test]
fn sets_stacked_on_each_other_with_their_toes_at_one_place_are_each_half_as_high() {
    let text = twice(100.0, 400.0, "");
    let stacked = text.replace(
        "[[feature]]\nid = \"b\"",
        "[[feature]]\nid = \"h\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = -10 }\n\
         [[feature]]\nid = \"b\"\nparent = \"h\"",
    );
    let made = built(from_text(&stacked));
    let alone = built(from_text(text.rsplit_once("[[feature]]").unwrap().0));
    let names = [("background", "h")];
    let sheets = ["1", "2", "3", "4"].map(|k| (format!("a-{k}"), format!("h/b-{k}")));
    let all = names.map(|(a, b)| (a.to_owned(), b.to_owned()));
    for (lower, upper) in all.iter().chain(&sheets) {
        let half = alone.size(lower) / 2.0;
        for name in [lower, upper] {
            let size = made.size(name);
            assert!((size - half).abs() < 1e-3, "{name} is {size}, not {half}");
        }
    }
}

#[test]
fn sets_stacked_on_each_other_with_the_same_belts_are_each_half_as_high() {
    let belts = "belts = [\n  { name = \"near\", facies = \"sand\", width = 60 },\n  { name = \"far\", facies = \"sand\" },\n]\n";
    let text = twice(100.0, 400.0, belts);
    let stacked = text.replace(
        "[[feature]]\nid = \"b\"",
        "[[feature]]\nid = \"h\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = -10 }\n\
         [[feature]]\nid = \"b\"\nparent = \"h\"",
    );
    let made = built(from_text(&stacked));
    let alone = built(from_text(text.rsplit_once("[[feature]]").unwrap().0));
    for k in 1..=4 {
        for belt in ["near", "far"] {
            let half = alone.size(&format!("a-{k}/{belt}")) / 2.0;
            assert!(half > 1e4);
            for name in [format!("a-{k}/{belt}"), format!("h/b-{k}/{belt}")] {
                let size = made.size(&name);
                // By age they are moved by a tenth of a millimetre at the most, on faces of 700 m × 10 m.
                assert!((size - half).abs() < 1.0, "{name} is {size}, not {half}");
            }
        }
    }
}

#[test]
fn belts_as_wide_as_clinoforms_are_apart_end_where_the_next_one_begins() {
    // The second belt of a clinothem reaches from its own shoreline to the next one.
    let belts = "belts = [{ name = \"near\", facies = \"sand\", width = 40 }, { name = \"far\", facies = \"sand\", width = 40 }, \
                 { name = \"rest\", facies = \"sand\" }]\n";
    let text = SET
        .replace("AZIMUTH", "270")
        .replace("spacing = { uniform = [40, 120] }", "spacing = 80")
        .replace("first = { uniform = [100, 150] }", "first = 200");
    let plain = built(from_text(&text));
    let made = built(from_text(&(text + belts)));
    for k in 1..=4 {
        let parts = ["near", "far", "rest"].map(|belt| made.size(&format!("set-{k}/{belt}")));
        let wanted = plain.size(&format!("set-{k}"));
        // By age clinoforms are moved by a millionth of the domain's size at most.
        assert!((parts.iter().sum::<f64>() - wanted).abs() < 1e-6 * wanted + 20.0 * 400.0 * 1e-3);
        assert!(parts.iter().all(|part| *part > 1e3), "{parts:?}");
    }
}

#[test]
fn of_a_unit_that_is_nowhere_there_are_no_clinoforms() {
    for level in [-20, -25] {
        let text = SET.replace("AZIMUTH", "320")
            + "[[feature]]\nid = \"below\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = -8 }\n\
               [[feature]]\nid = \"cover\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = { level = LEVEL }\n";
        let text = text
            .replace(
                "kind = \"clinoforms\"",
                "kind = \"clinoforms\"\nparent = \"below\"",
            )
            .replace("LEVEL", &level.to_string());
        // The set comes after the horizon whose unit it divides.
        let (head, rest) = text.split_once("[[feature]]").unwrap();
        let (set, rest) = rest.split_once("[[feature]]").unwrap();
        let (below, cover) = rest.split_once("[[feature]]").unwrap();
        let text = format!("{head}[[feature]]{below}[[feature]]{set}[[feature]]{cover}")
            .replace("z = [-20, 0]", "z = [-40, 0]");
        let made = built(from_text(&text));
        assert_eq!(made.realisation.volume("below/set-1"), None);
        assert_eq!(made.size("below"), 0.0);
        let cover = 900.0 * 400.0 * -f64::from(level);
        assert!((made.size("cover") - cover).abs() < 1e-3);
        let told = &made.plan.decisions;
        assert!(
            told.iter()
                .any(|text| text.contains("set has no clinoforms")),
            "{told:?}"
        );
    }
}

#[test]
fn a_longer_set_with_the_same_shorelines_adds_nothing_to_the_one_that_is_there() {
    let text = twice(100.0, 500.0, "");
    let alone = built(from_text(text.rsplit_once("[[feature]]").unwrap().0));
    let both = built(from_text(&text));
    for name in ["background", "a-1", "a-2", "a-3", "a-4"] {
        let (size, wanted) = (both.size(name), alone.size(name));
        assert!(
            (size - wanted).abs() < 1.0,
            "{name} is {size}, not {wanted}"
        );
    }
    for k in 1..=4 {
        assert!(both.size(&format!("b-{k}")) < 1.0);
    }
}

#[test]
fn sets_whose_toes_touch_at_one_point_are_told_apart_by_age() {
    // 50 m farther landward, and 50 m longer: the toes are the same where the ellipses have their apex, and nowhere else.
    let made = built(from_text(&twice(50.0, 450.0, "")));
    let extent = made.owners.extent();
    let (low, high) = (extent.low(), extent.high());
    let azimuth = 320.0_f64.to_radians();
    let dip = DVec2::new(azimuth.sin(), azimuth.cos());
    let half = (high - low).truncate() / 2.0;
    let start = -(half.x * dip.x.abs() + half.y * dip.y.abs()) - TD;
    let sheet = |first: f64, length: f64| Sheet {
        origin: start + first,
        length,
    };
    // The second set's first sheet lies below the first one's; the oldest clinothem ends at the lower of both.
    let below = by_formula(
        &[sheet(50.0, 450.0), sheet(100.0, 400.0)],
        azimuth,
        low,
        high,
    );
    let block = (high - low).element_product();
    for (name, wanted) in [("background", below[0]), ("b-1", below[1])] {
        let size = made.size(name);
        assert!(
            (size - wanted).abs() < 5e-6 * block,
            "{name} is {size}, not {wanted}"
        );
    }
}

/// Sheets 120 apart, the first one 130 from the west, each 400 long, with three belts.
fn belts() -> String {
    let belts = r#"
belts = [
  { name = "near", facies = "sand", width = 60 },
  { name = "middle", facies = "sand", width = 50 },
  { name = "far", facies = "sand" },
]"#;
    let text = SET
        .replace("AZIMUTH", "90")
        .replace("{ uniform = [40, 120] }", "120")
        .replace("{ uniform = [100, 150] }", "130")
        .replace("{ uniform = [150, 700] }", "400");
    text + belts
}

#[test]
fn belts_change_at_their_widths_from_the_shoreline_of_the_younger_sheet() {
    let made = built(from_text(&belts()));
    // Eastwards: the shoreline's apex is at x = 130, in the middle of y; the sheets are 120 apart.
    for (clinothem, shoreline) in [(0, 130.0), (1, 250.0), (2, 370.0), (3, 490.0)] {
        for (width, belt, next) in [(60.0, "near", "middle"), (110.0, "middle", "far")] {
            let x = shoreline + width;
            let u = (x - shoreline) / 400.0;
            // Just below the younger sheet.
            let z = -20.0 + 20.0 * (1.0 - u) * (1.0 - u) - 0.01;
            for (x, belt) in [(x - 0.01, belt), (x + 0.01, next)] {
                let owner = made.owners.at(DVec3::new(x, 200.0, z)).unwrap();
                let name = &made.realisation.volumes[owner].name;
                assert_eq!(*name, format!("set-{clinothem}/{belt}"), "x = {x}");
            }
        }
    }
}

#[test]
fn facies_belts_and_clinoforms_of_table_1_are_proven_in_full() {
    for seed in [7, 11] {
        let made = built(of_file("parasequence", seed));
        assert_eq!(made.assembly.engine, Engine::Partition);
        assert!(made.assembly.failed.is_empty(), "seed {seed}");
        // Belts of one clinothem, whichever of them are in the domain, and every solid, are something.
        assert!(made.assembly.measured.pieces.len() > 8, "seed {seed}");
    }
}

#[test]
fn the_coastal_model_is_proven_in_full_and_its_plain_stays_below_its_parasequences() {
    let made = built(of_file("coastal", 2));
    assert!(made.assembly.failed.is_empty());
    let [x, y, z] = made.model.domain.size();
    let (plain, shore): (Vec<_>, Vec<_>) = made
        .assembly
        .measured
        .pieces
        .iter()
        .partition(|piece| !made.realisation.volumes[piece.volume].name.contains('/'));
    let sum = |pieces: &[&Piece]| pieces.iter().map(|p| p.size).sum::<f64>();
    let of_shore = x * y * 21.336;
    assert!((sum(&shore) - of_shore).abs() < 1e-8 * of_shore);
    assert!((sum(&plain) - x * y * (z - 21.336)).abs() < 1e-8 * of_shore);
    // What lies under the transgression is seen from above it: channels and belts share parts of it.
    let between = made.assembly.measured.contacts.keys().filter(|(a, b)| {
        let kind = |volume: &usize| made.realisation.volumes[*volume].kind.as_str();
        [kind(a), kind(b)] == ["channel", "clinoforms"]
    });
    assert!(between.count() > 0);
}

#[test]
fn sheets_flatter_than_can_be_told_apart_are_refused() {
    let set = SET.replace("AZIMUTH", "90");
    let flat = from_text(&(set.clone() + "exponent = 3\ntoe = 0"));
    let flat = Realisation::new(&flat, &Selection::default()).unwrap_err();
    assert!(flat.to_string().contains("give a toe above 0"), "{flat}");
    // Left out, the toe is not tangent then.
    let steeper = built(from_text(&(set + "exponent = 3")));
    assert!(steeper.assembly.failed.is_empty());
}

#[test]
fn a_set_whose_top_takes_no_part_reaches_up_to_the_next_horizon_that_does() {
    let horizon = |id: &str, level: f64| {
        format!(
            "[[feature]]\nid = \"{id}\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = {{ level = {level} }}\n"
        )
    };
    let text = SET.replace("AZIMUTH", "137") + &horizon("lid", -9.0) + &horizon("roof", -4.0);
    let named = text.replace("sheets = 4", "sheets = 4\ntop = \"lid\"");
    let names = ["background", "set-1", "set-2", "set-3", "set-4"];
    for (text, ids, top, words) in [
        (&text, &[][..], -9.0, None),
        (&text, &["roof"], -9.0, None),
        (&text, &["lid"], -4.0, Some("up to roof: lid,")),
        (&named, &["lid"], -4.0, Some("up to roof: lid,")),
        (
            &named,
            &["roof", "lid"],
            0.0,
            Some("up to the domain's top: lid,"),
        ),
    ] {
        let made = Built::new(from_text(text), &without(ids), Engine::Partition).unwrap();
        assert!(made.assembly.failed.is_empty());
        let (sheets, low, high) = sheets(&made, 137.0);
        let high = high.with_z(top);
        let wanted = by_formula(&sheets, 137.0_f64.to_radians(), low, high);
        let block = (high - low).element_product();
        for (name, wanted) in names.iter().zip(wanted) {
            let size = made.size(name);
            assert!(
                (size - wanted).abs() < 5e-6 * block,
                "{ids:?}: {name} is {size}, not {wanted}"
            );
        }
        let told = made.realisation.decisions.join("\n");
        assert!(
            words.map_or(told.is_empty(), |words| told.contains(words)),
            "{told}"
        );
    }
}

#[test]
fn the_place_of_a_clinothem_that_is_left_out_goes_to_those_that_its_neighbours_sheets_bound() {
    let text = SET.replace("AZIMUTH", "320");
    let all = built(from_text(&text));
    for left_out in 1..=4_usize {
        let own = format!("set-{left_out}");
        let made = Built::new(from_text(&text), &without(&[&own]), Engine::Partition).unwrap();
        assert!(made.assembly.failed.is_empty());
        assert_eq!(made.realisation.volume(&own), None);
        let (mut sheets, low, high) = sheets(&all, 320.0);
        sheets.remove(left_out - 1);
        let wanted = by_formula(&sheets, 320.0_f64.to_radians(), low, high);
        let mut names = vec!["background", "set-1", "set-2", "set-3", "set-4"];
        names.remove(left_out);
        for (name, wanted) in names.into_iter().zip(wanted) {
            let size = made.size(name);
            let block = (high - low).element_product();
            assert!(
                (size - wanted).abs() < 5e-6 * block,
                "without {own}: {name} is {size}, not {wanted}"
            );
        }
    }
    let too_many = Realisation::new(&from_text(&text), &without(&["set-5"]));
    let words = too_many.unwrap_err().to_string();
    assert!(
        words.contains("`set-5`") && words.contains("its last clinothem is `set-4`"),
        "{words}"
    );
}

#[test]
fn the_place_of_a_belt_that_is_left_out_goes_to_the_belt_landward_of_it() {
    let all = built(from_text(&belts()));
    let made =
        |name: &str| Built::new(from_text(&belts()), &without(&[name]), Engine::Partition).unwrap();
    let size = |made: &Built, name: &str| {
        let volume = made.realisation.volume(name);
        volume.map_or(0.0, |volume| made.assembly.measured.size_of(volume))
    };
    let volumes = |made: &Built| -> Vec<String> {
        let all = made.realisation.volumes.iter();
        all.map(|one| one.name.clone()).collect()
    };
    let one = made("set-1/middle");
    assert!(size(&all, "set-1/middle") > 1000.0);
    for name in volumes(&all) {
        let wanted = match name.as_str() {
            "set-1/near" => size(&all, "set-1/near") + size(&all, "set-1/middle"),
            "set-1/middle" => 0.0,
            other => size(&all, other),
        };
        let own = size(&one, &name);
        assert!(
            (own - wanted).abs() < 1e-6 * wanted.max(1.0),
            "{name}: {own} {wanted}"
        );
    }
    // A whole clinothem goes to the older one; the oldest to the unit.
    for (left_out, older) in [("set-2", "set-1"), ("set-0", "background")] {
        let one = made(left_out);
        let of = |made: &Built, clinothem: &str| -> f64 {
            let names = volumes(made).into_iter();
            let own = names
                .filter(|name| name == clinothem || name.starts_with(&format!("{clinothem}/")));
            own.map(|name| size(made, &name)).sum()
        };
        assert!(of(&all, left_out) > 1000.0);
        assert_eq!(of(&one, left_out), 0.0);
        let wanted = of(&all, left_out) + of(&all, older);
        let own = of(&one, older);
        assert!((own - wanted).abs() < 1e-9 * wanted, "{own} {wanted}");
    }
}
