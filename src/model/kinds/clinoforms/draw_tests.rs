//! Tests of what is drawn for strata.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

use super::*;
use crate::model::draws::{Key, Rejected, attempt};
use crate::model::values::quantity::Quantity;
use crate::model::{FeatureKind, Format, Model, Source};

const KEY: Key<'_> = Key {
    seed: 3,
    stratum: None,
    feature: "set",
    instance: "1",
    attempt: 0,
};

/// Eastwards over a domain that is 1000 m long and as wide as asked; sheets 300 m apart, two belts.
fn model(width: f64, more: &str) -> Model {
    let text = format!(
        r#"
name = "set"
[domain]
x = [0, 1000]
y = [0, {width}]
z = [-20, 0]
facies = "sand"
[facies.sand]
[[feature]]
id = "set"
kind = "clinoforms"
facies = "sand"
azimuth_deg = 90
first = 50
spacing = 300
length = 400
belts = [
  {{ name = "near", facies = "sand", width = 100, interfingering = 40 }},
  {{ name = "far", facies = "sand" }},
]
{more}
"#
    );
    let source = Source::from_text("set.toml", text, Format::Toml);
    Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"))
}

fn spec(model: &Model) -> &ClinoformsSpec {
    let FeatureKind::Clinoforms(spec) = &model.features[0].kind else {
        panic!("a set")
    };
    spec
}

fn draw(model: &Model, spec: &ClinoformsSpec) -> Result<DrawnSet, Rejected> {
    let [base, top] = model.domain.z.map(|z| Horizon::flat(z).unwrap());
    let make = |draws: &mut Draws<'_>| spec.draw(&model.domain, [&base, &top], 0.0, draws);
    attempt(KEY, make).map(|made| made.0)
}

/// The nodes of many boundaries, and Q.
fn nodes(model: &Model) -> (Vec<Vec<[f64; 2]>>, f64) {
    let (low, high) = model.domain.corners();
    let [base, top] = model.domain.z.map(|z| Horizon::flat(z).unwrap());
    let frame = ClinoformFrame::new(low, high, 90.0_f64.to_radians()).unwrap();
    let mut draws = Draws {
        key: KEY,
        drawn: Vec::new(),
    };
    let set = Set {
        spec: spec(model),
        turns: turns(spec(model), &frame, &mut draws).unwrap(),
        frame,
        unit: ClinoformUnit::new(base, top, low, high).unwrap(),
        shoreline: Shoreline {
            dip: 3000.0,
            strike: 6000.0,
        },
        exponent: 2.0,
        toe: 0.0,
        nudge: 0.0,
    };
    let all = (0..200).map(|k| set.nodes(&draws, &format!("near-{k}.wander")));
    (all.collect(), set.frame.reach())
}

#[test]
fn a_boundary_turns_seven_to_fourteen_times_whatever_the_size_of_the_domain() {
    // In an extent of 782.3 m along strike every 60 to 120 m.
    for width in [2000.0, 782.3 / 1.1, 90.0] {
        let intervals = [60.0, 120.0].map(|interval| interval * 1.1 * width / 782.3);
        let (all, reach) = nodes(&model(width, ""));
        // Half the width, and a tenth more.
        assert!((reach - 0.55 * width).abs() < 1e-12 * width);
        let (mut shortest, mut longest) = (f64::INFINITY, 0.0_f64);
        for nodes in &all {
            let (first, last) = (nodes[0][0], nodes[nodes.len() - 1][0]);
            assert!(first <= -reach && first >= -reach - 1.001 * intervals[1]);
            assert!(last >= reach && nodes[nodes.len() - 2][0] < reach);
            assert!((7..=15).contains(&nodes.len()));
            for pair in nodes.windows(2) {
                let interval = pair[1][0] - pair[0][0];
                shortest = shortest.min(interval);
                longest = longest.max(interval);
            }
        }
        let [least, most] = intervals;
        assert!(shortest >= 0.999 * least && shortest < least + 0.02 * most);
        assert!(longest <= 1.001 * most && longest > 0.98 * most);
    }
}

#[test]
fn a_zigzag_goes_from_side_to_side_and_a_smooth_boundary_anywhere_between() {
    let (all, _) = nodes(&model(2000.0, "interfingering = \"zigzag\""));
    let mut first = [0, 0];
    for nodes in &all {
        first[usize::from(nodes[0][1] > 0.0)] += 1;
        for pair in nodes.windows(2) {
            assert_eq!(pair[0][1].abs(), 0.5);
            assert_eq!(pair[0][1], -pair[1][1]);
        }
    }
    // Six standard deviations of 200 throws of a coin: 42.
    assert!(first.iter().all(|count| *count > 58), "{first:?}");
    let (all, _) = nodes(&model(2000.0, ""));
    let (mut count, mut sum, mut alike, mut pairs) = (0.0, 0.0, 0.0, 0.0);
    for nodes in &all {
        for pair in nodes.windows(2) {
            alike += f64::from(u8::from(pair[0][1] * pair[1][1] > 0.0));
            pairs += 1.0;
        }
        // The first lies on a side.
        for [_, value] in &nodes[1..] {
            assert!(value.abs() <= 0.5);
            count += 1.0;
            sum += value.abs();
        }
    }
    // Uniform: the mean of |x| is ¼ with a standard deviation of 0.144, and neighbours have one sign as often as not.
    let bound = |deviation: f64, n: f64| 6.0 * deviation / f64::sqrt(n);
    assert!((sum / count - 0.25).abs() < bound(0.144, count));
    assert!((alike / pairs - 0.5).abs() < bound(0.5, pairs));
}

#[test]
fn every_boundary_wanders_on_its_own() {
    let model = model(2000.0, "sheets = 2");
    let set = draw(&model, spec(&model)).unwrap();
    assert_eq!((set.sheets.len(), set.boundaries.len()), (2, 3));
    let off = |at: usize, q: f64| {
        let (sheet, boundary) = (&set.sheets[at].sheet, &set.boundaries[at][0].sheet);
        // Ruled from the younger sheet along 40 m of dip in 20 m of height; 100 m from the shoreline u is ¼.
        let z = -20.0 + 20.0 * 0.75 * 0.75;
        boundary.d(q, z) - sheet.d_top(q)
    };
    let mut differing = 0;
    for k in 0..100 {
        let q = -900.0 + 18.0 * f64::from(k);
        let [one, other] = [0, 1].map(|at| off(at, q));
        // The range is 40 m from peak to peak, and the line lies on the sheet, which falls by 0.075 m per metre there.
        for own in [one, other] {
            assert!((own - 100.0).abs() < 24.0, "{own}");
        }
        differing += i32::from((one - other).abs() > 1.0);
    }
    assert!(differing > 60, "{differing}");
}

#[test]
fn a_set_that_does_not_prograde_or_has_more_than_500_sheets_is_refused() {
    let model = model(100.0, "");
    for (step, words) in [
        (0.0, "spacing-2 is 0 m"),
        (-5.0, "spacing-2 is -5 m"),
        // 1000 m and the belly of the ellipses hold 501 sheets at less than 2 m, and fewer than 500 at 2.2 m.
        (1.9, "more than 500 sheets"),
    ] {
        let mut spec = spec(&model).clone();
        spec.belts.clear();
        spec.spacing = Quantity::Constant(step);
        let rejected = draw(&model, &spec).unwrap_err();
        assert!(rejected.message.contains(words), "{}", rejected.message);
    }
    let mut fine = spec(&model).clone();
    fine.belts.clear();
    fine.spacing = Quantity::Constant(2.2);
    let count = draw(&model, &fine).unwrap().sheets.len();
    // Those whose shoreline has not left the domain: up to 1000 m at the corners, 50 m from the first.
    assert!((430..435).contains(&count), "{count}");
}

#[test]
fn a_boundary_turns_as_often_as_the_model_says() {
    let (all, reach) = nodes(&model(2000.0, "turns = [60, 120]\n"));
    for nodes in &all {
        for pair in nodes.windows(2) {
            assert!((60.0 - 1e-9..120.0 + 1e-9).contains(&(pair[1][0] - pair[0][0])));
        }
        assert!(nodes.len() as f64 > 2.0 * reach / 120.0);
    }
    let model = model(2000.0, "turns = [1, 2]\n");
    let Err(rejected) = draw(&model, spec(&model)) else {
        panic!("2200 turns")
    };
    assert!(rejected.message.contains("give a greater distance"));
}
