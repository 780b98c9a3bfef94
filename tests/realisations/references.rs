//! References between features: what is made by what was made of others.

use clinothem::features::body::Body;
use clinothem::features::body::Trough;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

use super::{instances, model, realise};

const TEXT: &str = include_str!("../bad_models/reference.toml");

fn trough<'a>(made: &'a Realisation, name: &str) -> &'a Trough {
    let volume = made.volume(name).unwrap();
    match &made.instances[volume - 1].body {
        Body::Trough(trough) => trough,
        other => panic!("{other:?}"),
    }
}

/// The places of a channel's thalweg in plan, at its sections.
fn course(made: &Realisation, name: &str) -> Vec<glam::DVec2> {
    let trough = trough(made, name);
    let at = |v: &f64| trough.base().point(0.5, *v).truncate();
    trough.sections().iter().map(at).collect()
}

fn selected(text: &str, without: &[&str]) -> Realisation {
    let selection = Selection {
        without: without.iter().map(|&name| name.to_owned()).collect(),
        max_level: None,
    };
    let model = model(text, &[]);
    selection.check(&model).unwrap();
    Realisation::new(&model, &selection).unwrap()
}

#[test]
fn a_channel_has_the_way_of_the_one_with_its_number_and_runs_beside_it() {
    let made = realise(TEXT, &[]);
    let mut differ = 0;
    for number in 1..=3 {
        let own = course(&made, &format!("stream-{number}"));
        let other = course(&made, &format!("valley-{number}"));
        // Straight, eastwards: the right is the south.
        for (a, b) in [
            (own[0], other[0]),
            (own[own.len() - 1], other[other.len() - 1]),
        ] {
            assert!(
                (b - a - glam::DVec2::new(0.0, 4.0)).length() < 1e-9,
                "{a} {b}"
            );
        }
        differ += usize::from(other[0] != course(&made, "valley-1")[0]);
    }
    assert_eq!(differ, 2, "each of the three has a course of its own");
    assert_eq!(course(&made, "lone"), course(&made, "valley-2"));
    assert_eq!(course(&made, "rills"), course(&made, "unit/rill-2"));
}

#[test]
fn what_is_referred_to_is_drawn_even_if_it_takes_no_part() {
    let all = instances(&realise(TEXT, &[]));
    for without in [
        &["valley"][..],
        &["valley-2"],
        &["valley", "unit"],
        &["unit/rill-2"],
    ] {
        let made = selected(TEXT, without);
        let some = instances(&made);
        assert!(some.len() < all.len());
        for (name, one) in &some {
            assert_eq!(all[name], *one, "{name} without {without:?}");
        }
        for name in all.keys() {
            let is_out = without.iter().any(|out| {
                name == out
                    || name.starts_with(&format!("{out}-"))
                    || name.starts_with(&format!("{out}/"))
            });
            assert_eq!(
                some.contains_key(name),
                !is_out,
                "{name} without {without:?}"
            );
        }
        // Nothing of it is told.
        assert_eq!(made.volumes.len(), some.len() + 1);
    }
    let off = TEXT.replace("id = \"valley\"\n", "id = \"valley\"\nenabled = false\n");
    let off = instances(&realise(&off, &[]));
    assert_eq!(off["lone"], all["lone"]);
    assert!(!off.contains_key("valley-1"));
}

#[test]
fn the_order_of_the_list_does_not_change_what_is_made() {
    let (head, list) = TEXT.split_once("[[feature]]").unwrap();
    let mut features: Vec<&str> = list.split("[[feature]]").collect();
    let all = instances(&realise(TEXT, &[]));
    features.reverse();
    let text = features.iter().fold(head.to_owned(), |text, feature| {
        format!("{text}[[feature]]{feature}\n")
    });
    assert_eq!(instances(&realise(&text, &[])), all);
}
