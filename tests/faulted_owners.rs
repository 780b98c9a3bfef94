//! Events in the rules: the point evaluator of a faulted model against the history itself, told backwards point by point.
//!
//! The oracle knows no blocks and no copies: it asks the model without its events, and goes from each event to the place where what
//! is there came from.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::fmt::Write as _;

use clinothem::model::Interior;
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::rules::{BACKGROUND, Verdict};
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};
use glam::DVec3;
use proptest::prelude::*;

const LOW: DVec3 = DVec3::new(0.0, 0.0, -100.0);
const HIGH: DVec3 = DVec3::new(400.0, 300.0, 0.0);

const HEAD: &str = "name = \"history\"\nseed = 5\n[domain]\nx = [0, 400]\ny = [0, 300]\nz = [-100, 0]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n";

fn model(text: &str) -> Model {
    let source = Source::from_text("history", text, Format::Toml);
    Model::check(&source).unwrap()
}

/// One entry of the list.
#[derive(Clone, Debug)]
enum Entry {
    /// With whether it is onlapping.
    Horizon(f64, bool),
    /// Centre, semi-axes and what it does to what is older: 0 takes all, 1 preserves, 2 is removed by nothing.
    Nodule([f64; 3], [f64; 3], u8),
    /// Point, dip, azimuth (°), displacement (m), rake (°), and on which side of the fault before it, if there is one, it ends.
    Fault([f64; 3], f64, f64, f64, f64, Option<bool>),
}

impl Entry {
    fn write(&self, at: usize, last_fault: Option<usize>, text: &mut String) {
        match self {
            Self::Horizon(level, is_onlapping) => {
                let relation = if *is_onlapping { "onlapping" } else { "erosive" };
                write!(
                    text,
                    "[[feature]]\nid = \"e{at}\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = {{ level = {level} }}\nrelation = \"{relation}\"\n"
                )
            }
            Self::Nodule([x, y, z], [a, b, c], rule) => {
                let rule = ["", "preserve = true\n", "removed_by = []\n"][usize::from(*rule)];
                write!(
                    text,
                    "[[feature]]\nid = \"e{at}\"\nkind = \"ellipsoid\"\nfacies = \"sand\"\ncenter = [{x}, {y}, {z}]\nsemi_axes = [{a}, {b}, {c}]\n{rule}"
                )
            }
            Self::Fault([x, y, z], dip, azimuth, displacement, rake, ends) => {
                let ends = ends.zip(last_fault).map(|(is_above, fault)| {
                    let side = if is_above { "hanging-wall" } else { "footwall" };
                    format!("ends_on = {{ fault = \"e{fault}\", side = \"{side}\" }}\n")
                });
                write!(
                    text,
                    "[[feature]]\nid = \"e{at}\"\nkind = \"fault\"\nsurface = {{ dipping = {{ through = [{x}, {y}, {z}], dip_deg = {dip}, azimuth_deg = {azimuth} }} }}\ndisplacement = {displacement}\nrake_deg = {rake}\n{}",
                    ends.unwrap_or_default()
                )
            }
        }
        .unwrap();
    }
}

/// Whether a fault has a place in its hanging wall, and how that moves (Aki & Richards).
fn fault(entry: &Entry, p: DVec3) -> Option<(bool, DVec3)> {
    let Entry::Fault(through, dip, azimuth, displacement, rake, _) = entry else {
        return None;
    };
    let [dip, azimuth, rake] = [dip, azimuth, rake].map(|angle: &f64| angle.to_radians());
    let towards = DVec3::new(azimuth.sin(), azimuth.cos(), 0.0);
    let strike = DVec3::new(-azimuth.cos(), azimuth.sin(), 0.0);
    let normal = towards * dip.sin() + DVec3::Z * dip.cos();
    let down = towards * dip.cos() - DVec3::Z * dip.sin();
    let slip = *displacement * (rake.cos() * strike - rake.sin() * down);
    Some(((p - DVec3::from(*through)).dot(normal) > 0.0, slip))
}

/// The model without its faults, and which of its volumes each entry is.
struct History<'a> {
    entries: &'a [Entry],
    realisation: Realisation,
    interiors: Vec<Interior>,
    volumes: Vec<Option<usize>>,
}

impl<'a> History<'a> {
    fn new(entries: &'a [Entry], text: &str) -> Self {
        let is_fault = |at: &usize| matches!(entries[*at], Entry::Fault(..));
        let without = (0..entries.len()).filter(is_fault);
        let selection = Selection {
            without: without.map(|at| format!("e{at}")).collect(),
            ..Selection::default()
        };
        let realisation = Realisation::new(&model(text), &selection).unwrap();
        let interiors = realisation
            .instances
            .iter()
            .map(|one| Interior::of(&one.body).unwrap());
        Self {
            interiors: interiors.collect(),
            volumes: (0..entries.len())
                .map(|at| realisation.volume(&format!("e{at}")))
                .collect(),
            entries,
            realisation,
        }
    }

    /// The fault directly before one that ends on it, so that nothing has moved that one since; with the side on which this one lies.
    fn master(&self, at: usize) -> Option<(usize, bool)> {
        let Entry::Fault(.., Some(wanted)) = self.entries[at] else {
            return None;
        };
        let before = at.checked_sub(1)?;
        matches!(self.entries[before], Entry::Fault(..)).then_some((before, wanted))
    }

    /// Whether a place is in a fault's hanging wall, which reaches no farther than the fault.
    fn is_above(&self, at: usize, p: DVec3) -> bool {
        let is_above = fault(&self.entries[at], p).is_some_and(|(is_above, _)| is_above);
        let reaches = self
            .master(at)
            .is_none_or(|(master, wanted)| self.is_above(master, p) == wanted);
        is_above && reaches
    }

    /// What holds a place after the first entries. What a fault moves that ends on the one before it is that one's block, as if it filled all
    /// of space: of its master it is known on which side the place was (`side`).
    fn holder(&self, count: usize, p: DVec3, side: Option<bool>) -> usize {
        let Some(at) = count.checked_sub(1) else {
            return BACKGROUND;
        };
        if let Some((_, slip)) = fault(&self.entries[at], p) {
            if !side.unwrap_or_else(|| self.is_above(at, p)) {
                return self.holder(at, p, None);
            }
            // What it moves lies on one side of its master, wherever that brings it.
            return self.holder(at, p - slip, self.master(at).map(|(_, wanted)| wanted));
        }
        let holder = self.holder(at, p, None);
        let volume = self.volumes[at].unwrap();
        let takes = self.realisation.rules.verdict(volume, holder) == Verdict::Takes
            && self.interiors[volume - 1].contains(p);
        if takes { volume } else { holder }
    }
}

fn entries() -> impl Strategy<Value = Vec<Entry>> {
    let point = || [50.0..350.0, 50.0..250.0, -90.0..-10.0_f64];
    let horizon = (-90.0..-10.0, any::<bool>()).prop_map(|(z, onlaps)| Entry::Horizon(z, onlaps));
    let nodule = (point(), [20.0..150.0, 20.0..150.0, 5.0..40.0_f64], 0..3_u8)
        .prop_map(|(centre, axes, rule)| Entry::Nodule(centre, axes, rule));
    let fault = (
        point(),
        30.0..90.0,
        0.0..360.0,
        0.0..25.0,
        prop_oneof![3 => Just(-90.0), 1 => Just(90.0), 1 => -180.0..180.0],
        prop::option::weighted(0.3, any::<bool>()),
    )
        .prop_map(|(at, dip, azimuth, slip, rake, ends)| {
            Entry::Fault(at, dip, azimuth, slip, rake, ends)
        });
    prop::collection::vec(prop_oneof![2 => horizon, 2 => nodule, 3 => fault], 2..8)
}

fn text(entries: &[Entry]) -> String {
    let mut text = HEAD.to_owned();
    for (at, entry) in entries.iter().enumerate() {
        // Only directly behind another fault may one end on it here: see the oracle.
        let before = at.checked_sub(1);
        let master = before.filter(|before| matches!(entries[*before], Entry::Fault(..)));
        entry.write(at, master, &mut text);
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]
    #[test]
    fn a_faulted_place_is_held_by_what_held_the_place_it_came_from(
        entries in entries(),
        parts in prop::collection::vec([0.0..1.0, 0.0..1.0, 0.0..1.0_f64], 100),
    ) {
        let text = text(&entries);
        let faulted = Realisation::new(&model(&text), &Selection::default()).unwrap();
        let owners = Owners::new(&faulted).unwrap();
        let history = History::new(&entries, &text);
        for part in parts {
            let p = LOW + (HIGH - LOW) * DVec3::from(part);
            let owner = owners.at(p).unwrap();
            let name = faulted.volumes[owner].unfaulted_name();
            let expected = history.holder(entries.len(), p, None);
            prop_assert_eq!(name, &history.realisation.volumes[expected].name, "{:?}\n{}", p, text);
        }
    }
}
