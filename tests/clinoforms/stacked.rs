//! Sets that coincide with others, or touch them.

use glam::DVec2;

use super::formula::{Sheet, TD, by_formula};
use super::{SET, built, from_text};

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
