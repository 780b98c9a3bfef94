//! Every committed model is assembled with the full proof, and its solids are what its rules say.
//!
//! The rules are written out by hand here, once more and differently: as what each body may take, asked
//! in order of age. Geometry (inside which shell a point lies) is the evaluator's.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::path::PathBuf;
use std::time::Duration;

use assembled::{checked, source};
use clinothem::assembly::{Engine, Options, proof, worker};
use clinothem::export::report::{Parts, Report};
use clinothem::model::Stream;
use clinothem::model::selection::Selection;
use glam::DVec3;

/// With what is asked of rules.
struct Built(assembled::Built);

impl std::ops::Deref for Built {
    type Target = assembled::Built;

    fn deref(&self) -> &assembled::Built {
        &self.0
    }
}

impl Built {
    fn new(name: &str) -> Self {
        let model = checked(&source(name));
        let options = Options {
            engine: Engine::Auto,
            child: Some(worker::Child {
                program: PathBuf::from(env!("CARGO_BIN_EXE_clinothem")),
                time_limit: Some(Duration::from_secs(600)),
            }),
            threads: 0,
            proof: proof::Level::Full,
            seed: model.seed,
        };
        let built = assembled::Built::with(model, &Selection::default(), &options);
        let built = Self(built.unwrap());
        built.assert_proven();
        built
    }

    fn report(&self) -> Report {
        Report::new(Parts {
            model: &self.model,
            realisation: &self.realisation,
            plan: &self.plan,
            assembly: &self.assembly,
            wells: &[],
            level: proof::Level::Full,
            with_bounds: false,
        })
    }

    /// The proof holds, and compared at least 1000 points with the solids.
    fn assert_proven(&self) {
        let proof = &self.assembly.proof;
        assert!(proof.holds(), "{}", proof.failures());
        let compared: u32 = proof
            .checks
            .iter()
            .filter(|check| {
                ["beside faces", "not in its solids", "points along lines"]
                    .iter()
                    .any(|name| check.name.contains(name))
            })
            .map(|check| {
                let points = check.detail.split(' ').next().unwrap();
                points.parse::<u32>().unwrap()
            })
            .sum();
        assert!(compared >= 1000, "only {compared} points");
    }

    /// Compares the solids with a rule that takes which volumes' shells hold a point, oldest first, and
    /// gives the owner's name: point by point with the evaluator, and in the sum with the solids.
    fn assert_rule(&self, rule: impl Fn(&[&str]) -> String) {
        const POINTS: u32 = 40_000;
        let (low, high) = (self.owners.extent().low(), self.owners.extent().high());
        let names: Vec<&str> = self.plan.names.iter().map(String::as_str).collect();
        let mut hits = vec![0_u32; names.len()];
        let mut stream = Stream::new(1, "test", "1", "points", 0);
        for _ in 0..POINTS {
            let unit = DVec3::new(stream.unit(), stream.unit(), stream.unit());
            let point = low + (high - low) * unit;
            let inside: Vec<&str> = (1..names.len())
                .filter(|volume| self.owners.inside(*volume, point))
                .map(|volume| names[volume])
                .collect();
            let expected = rule(&inside);
            let owner = self.owners.at(point).unwrap();
            assert_eq!(names[owner], expected, "{point} inside {inside:?}");
            hits[owner] += 1;
        }
        let domain = (high - low).element_product();
        for (volume, name) in names.iter().enumerate() {
            let share = self.assembly.measured.size_of(volume) / domain;
            let expected = share * f64::from(POINTS);
            // Six standard deviations of a binomial count: one run in 10⁸ would fail by chance.
            let bound = 6.0 * (expected * (1.0 - share)).sqrt() + 6.0;
            let miss = (f64::from(hits[volume]) - expected).abs();
            assert!(miss < bound, "{name}: {} hits, {expected:.1}", hits[volume]);
        }
    }
}

/// Asks the bodies in order of age: each takes the point from a holder that it may take it from.
fn oldest_first(inside: &[&str], may_take: impl Fn(&str, &str) -> bool) -> String {
    let mut holder = "background";
    for body in inside {
        if may_take(body, holder) {
            holder = body;
        }
    }
    holder.to_owned()
}

#[test]
fn bodies_take_only_what_their_list_admits() {
    let built = Built::new("rules/removes");
    built.assert_rule(|inside| {
        oldest_first(inside, |body, holder| match (body, holder) {
            ("south" | "north", _) | ("by-id", "south" | "background") => true,
            // The only body of level 2 is `north`.
            ("by-level", holder) => holder == "north",
            // Sand is in `south` and in `by-level`.
            ("by-facies", holder) => ["south", "by-level"].contains(&holder),
            ("by-kind", holder) => holder != "background",
            _ => false,
        })
    });
    // A plug is one piece, a plug in both channels is two, and what runs through the plain crosses it.
    assert_eq!(built.pieces("by-level"), 1);
    assert_eq!(built.pieces("by-facies"), 1);
    assert_eq!(built.pieces("by-kind"), 2);
    assert!(built.contact("by-level", "south") == 0.0);
    assert!(built.contact("by-facies", "north") == 0.0);
    assert!(built.contact("by-id", "north") > 0.0);
}

#[test]
fn protected_bodies_stay_whole_and_preserving_ones_take_only_the_plain() {
    let built = Built::new("rules/protected");
    built.assert_rule(|inside| {
        oldest_first(inside, |body, holder| match (body, holder) {
            // Nothing removes it once it is there.
            (_, "cemented") => false,
            (body, "picky") => body == "cutter",
            ("timid", holder) => holder == "background",
            _ => true,
        })
    });
    // `cemented` passes under and through everything in one piece; it cuts `timid` and `cutter` in two.
    assert_eq!(built.pieces("cemented"), 1);
    assert!(built.pieces("timid") > 1);
    assert!(built.contact("timid", "picky") > 0.0);
    assert!(built.contact("cutter", "picky") > 0.0);
}

#[test]
fn children_stay_in_their_parents_and_younger_features_cut_all_of_them() {
    let built = Built::new("rules/nested");
    built.assert_rule(|inside| {
        oldest_first(inside, |body, holder| match body.rsplit_once('/') {
            // A child takes from its parent and from whatever is in it.
            Some((parent, _)) => holder == parent || holder.starts_with(&format!("{parent}/")),
            None => true,
        })
    });
    assert_eq!(
        built.plan.names,
        [
            "background",
            "trunk-1",
            "trunk-1/thread",
            "trunk-1/thread/plug",
            "trunk-2",
            "trunk-2/thread",
            "trunk-2/thread/plug",
            "youngest"
        ],
        "what is switched off has no volume"
    );
    let report = built.report();
    let level = |name: &str| {
        let found = report.volumes.iter().find(|volume| volume.name == name);
        found.map(|volume| (volume.level, volume.parent.clone()))
    };
    let parent = |name: &str| Some(name.to_owned());
    assert_eq!(level("trunk-2"), Some((1, None)));
    assert_eq!(level("trunk-2/thread"), Some((2, parent("trunk-2"))));
    assert_eq!(
        level("trunk-2/thread/plug"),
        Some((3, parent("trunk-2/thread")))
    );
    for name in ["trunk-2/thread", "trunk-2/thread/plug"] {
        assert!(built.size(name) > 0.0, "{name}");
    }
}

#[test]
fn what_is_drawn_lies_where_its_distribution_allows() {
    let built = Built::new("rules/distributions");
    built.assert_rule(|inside| oldest_first(inside, |_, _| true));
    let report = built.report();
    for (feature, key, low, high) in [
        ("drawn", "width", 25.0, 70.0),
        ("drawn", "depth", 4.0, 8.0),
        ("drawn", "top", -12.0, -2.0),
        ("drawn", "asymmetry", -0.2, 0.2),
        ("drawn", "trajectory.center.y", 100.0, 200.0),
        ("meander", "trajectory.amplitude", 20.0, 40.0),
        ("meander", "trajectory.wavelength", 250.0, 300.0),
        ("meander", "trajectory.azimuth_deg", 80.0, 100.0),
    ] {
        let volumes = report.volumes.iter().filter(|v| v.feature == feature);
        for volume in volumes {
            let drawn = &volume.drawn;
            let value = drawn.get(key).copied();
            assert!(
                value.is_some_and(|value| (low..=high).contains(&value)),
                "{} {key}: {value:?} among {drawn:?}",
                volume.name
            );
        }
    }
    for volume in &report.volumes {
        if let Some(azimuth) = volume.drawn.get("trajectory.azimuth_deg")
            && volume.feature == "drawn"
        {
            assert!([60.0, 120.0].contains(azimuth), "{azimuth}");
        }
        if volume.feature == "meander" {
            let width = volume.drawn["width"];
            assert!([25.0, 30.0, 35.0].contains(&width), "{width}");
        }
    }
}

#[test]
fn tops_that_lie_exactly_on_the_domains_top_and_on_each_other_are_faces_there() {
    let built = Built::new("flush-tops/flush-tops");
    built.assert_rule(|inside| oldest_first(inside, |_, _| true));
    // At the surface the channels' tops are parts of the domain's skin: 60 m wide and 400 m / cos long.
    let outer = &built.assembly.measured.outer;
    let length = (400.0_f64.powi(2) + 80.0_f64.powi(2)).sqrt();
    let both = outer[&built.volume("surface-old")] + outer[&built.volume("surface-young")];
    assert!(both > 60.0 * length, "{both}");
    // No mud lies between the buried tops: each is level with the other and touches the other's bank only.
    assert!(built.contact("buried-old", "buried-young") > 0.0);
    assert_eq!(built.pieces("background"), 1);
    assert!(!built.plan.decisions.is_empty());
}

#[test]
fn channels_that_wander_widen_overhang_and_end_are_assembled() {
    let built = Built::new("wandering/wandering");
    built.assert_rule(|inside| oldest_first(inside, |_, _| true));
    // The abandoned channel ends inside: between its end and the western wall there is only mud or younger.
    let abandoned = built.volume("abandoned");
    let pieces = built.assembly.measured.pieces_of(abandoned);
    let west = pieces
        .iter()
        .map(|piece| piece.bounds.0.x)
        .fold(f64::INFINITY, f64::min);
    assert!((350.0..392.0).contains(&west), "{west}");
    // An overhang: somewhere the undercut channel lies under mud that lies beside it at its top.
    let undercut = built.volume("undercut");
    let extent = built.owners.extent();
    let (low, high) = (extent.low(), extent.high());
    let inside = |x: f64, z: f64| built.owners.inside(undercut, DVec3::new(x, 300.0, z));
    let steps =
        |from: f64, to: f64| (0..4000).map(move |i| from + (to - from) * f64::from(i) / 4e3);
    let top = -9.3 - 1e-6;
    let rim = steps(low.x, high.x).find(|x| inside(*x, top)).unwrap();
    let reach = steps(low.x, high.x)
        .find(|x| inside(*x, top - 2.0))
        .unwrap();
    assert!(reach < rim - 0.2, "{reach} {rim}");
}

#[test]
fn nodules_are_whole_where_nothing_may_remove_them() {
    use std::f64::consts::PI;
    let built = Built::new("nodules/nodules");
    built.assert_rule(|inside| {
        oldest_first(inside, |body, holder| match body.rsplit_once('/') {
            // A nodule of a channel grew in its sand …
            Some((parent, _)) => holder == parent,
            // … and stays when something younger comes.
            None => !holder.contains('/'),
        })
    });
    let contacts = |name: &str| -> Vec<&str> {
        let names = built.plan.names.iter().map(String::as_str);
        names
            .filter(|other| built.contact(name, other) > 0.0)
            .collect()
    };
    let drawn = |name: &str, key: &str| {
        let instance = &built.realisation.instances[built.volume(name) - 1];
        let found = instance.drawn.iter().find(|(known, _)| known == key);
        found.map(|(_, value)| *value).unwrap()
    };
    let whole = |a: f64, b: f64, c: f64| 4.0 / 3.0 * PI * a * b * c;
    let assert_size = |name: &str, expected: f64| {
        let size = built.size(name);
        // The integrals of the faces are asked for a millionth.
        assert!(
            (size - expected).abs() < 1e-6 * expected,
            "{name}: {size} {expected}"
        );
        assert_eq!(built.pieces(name), 1, "{name}");
    };
    assert_eq!(contacts("whole"), ["channel-2"]);
    assert_size("whole", whole(12.0, 6.0, 2.0));
    // Across a bank, in mud and in the sand of both channels.
    assert_eq!(contacts("bank"), ["background", "channel-1", "channel-2"]);
    assert_size("bank", whole(15.0, 8.0, 3.0));
    // Of channel-1 nothing is left around this one: channel-2 came and could not remove it.
    let left = "channel-1/nodule-3";
    assert_eq!(contacts(left), ["channel-2"]);
    let [a, b, c] = ["a", "b", "c"].map(|axis| drawn(left, &format!("semi_axes.{axis}")));
    assert_size(left, whole(a, b, c));
    // One that reaches out of its channel ends at the channel's bank.
    let cut = "channel-1/nodule-1";
    let [a, b, c] = ["a", "b", "c"].map(|axis| drawn(cut, &format!("semi_axes.{axis}")));
    assert!(
        built.size(cut) < 0.95 * whole(a, b, c),
        "{}",
        built.size(cut)
    );
}

#[test]
fn the_quickstart_is_what_its_rules_say() {
    let built = Built::new("quickstart/quickstart");
    built.assert_rule(|inside| oldest_first(inside, |_, _| true));
}

#[test]
fn what_lies_in_channels_is_proven_with_everything_that_the_kernel_can_say_of_it() {
    // Long, meandering faces: of these the kernel's own lines miss most passages.
    let built = Built::new("plugs/plugs");
    let oxbow = built.size("meander/oxbow");
    assert!(oxbow > 0.0 && oxbow < built.size("meander"));
    assert_eq!(built.pieces("meander/lag"), 1);
    let built = Built::new("fig08a-point-bars/fig08a-point-bars");
    for bar in 2..=4 {
        for package in 1..=4 {
            let name = format!("channel/bar-{bar}/accretion-{package}");
            assert_eq!(built.pieces(&name), 1, "{name}");
        }
    }
}
