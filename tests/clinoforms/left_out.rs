//! What is left out leaves its place to others.

use clinothem::assembly::Engine;
use clinothem::model::realisation::Realisation;

use super::assembled::{Built, without};
use super::formula::{by_formula, sheets};
use super::{SET, belts, built, from_text};

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
