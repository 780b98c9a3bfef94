//! The proof finds whatever damage is done to finished topology: many kinds, in many models, more than a thousand times.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stderr,
    reason = "a test fails by panicking; the table of what finds what is printed on demand"
)]

use std::collections::BTreeMap;
use std::path::Path;

use super::damage::{KINDS, Kind, damages};
use super::{Level, Prover};
use crate::assembly::{Cancel, Engine, Options, Subject, partitioned};
use crate::model::realisation::Realisation;
use crate::model::selection::Selection;
use crate::model::{Format, Model, Source};
use crate::partition::{Partition, Topology};

/// Small models of every kind of feature and contact.
const MODELS: [&str; 20] = [
    "models/quickstart/quickstart",
    "models/contacts/apart",
    "models/contacts/end-caps",
    "models/contacts/inside",
    "models/contacts/level-tops",
    "models/contacts/overhang",
    "models/contacts/pieces",
    "models/contacts/removed",
    "models/flush-tops/flush-tops",
    "models/nodules/nodules",
    "models/parasequence/parasequence",
    "models/rules/nested",
    "models/rules/protected",
    "models/rules/removes",
    "models/strata/bounds",
    "models/strata/points",
    "models/strata/undulating",
    "models/clinoforms/clinoforms",
    "tests/cases/real-data/wrong-island",
    "tests/cases/real-data/steep-horizon-area",
];
/// Damages of one kind in one model.
const OF_KIND: usize = 4;

struct Right {
    subject: Subject,
    made: Partition,
    options: Options,
}

impl Right {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join(name)
            .with_extension("toml");
        Self::of(name, &Source::read(path).unwrap())
    }

    fn of(name: &str, source: &Source) -> Self {
        let model = Model::check(source);
        let model = model.unwrap_or_else(|defects| panic!("{defects}"));
        let subject =
            Subject::new(Realisation::new(&model, &Selection::default()).unwrap()).unwrap();
        let options = Options {
            engine: Engine::Partition,
            child: None,
            threads: 0,
            proof: Level::Fast,
            seed: 1,
        };
        let made = partitioned::partition(
            &subject.plan,
            &subject.owners,
            &partitioned::REMEDIES[0],
            &options,
            &Cancel::new(),
        )
        .unwrap();
        assert!(made.faults.is_none(), "{name}: {}", made.faults);
        Self {
            subject,
            made,
            options,
        }
    }

    fn size(&self) -> f64 {
        (self.subject.plan.high() - self.subject.plan.low()).length()
    }

    /// What finds that some topology is not right; `all` goes on after the first group that does.
    fn finders(&self, topology: Topology, all: bool) -> Vec<&'static str> {
        let made = Partition {
            topology: topology.clone(),
            ..self.made.clone()
        };
        let mut found = Vec::new();
        let candidate = partitioned::finish(&self.subject.plan, made).unwrap_or_else(|_| {
            // The kernel refuses it, but its word is not what counts: the tables alone must tell.
            if all {
                found.push("the kernel refuses it");
            }
            let mut right = partitioned::finish(&self.subject.plan, self.made.clone()).unwrap();
            right.evidence.topology = Some(topology);
            right
        });
        let prover = Prover {
            solids: &candidate.solids,
            measured: &candidate.measured,
            evidence: &candidate.evidence,
            plan: &self.subject.plan,
            owners: &self.subject.owners,
            options: &self.options,
        };
        for step in prover.steps() {
            let made = step().unwrap();
            found.extend(
                made.iter()
                    .filter(|check| !check.holds())
                    .map(|check| check.name),
            );
            if !found.is_empty() && !all {
                break;
            }
        }
        found
    }

    fn damages(&self, kind: Kind) -> Vec<Topology> {
        damages(kind, &self.made.topology, self.size(), OF_KIND)
    }
}

#[test]
fn the_fast_proof_finds_every_one_of_a_thousand_damages_and_none_where_there_is_none() {
    let mut count = 0;
    let mut missed = Vec::new();
    for name in MODELS {
        let right = Right::new(name);
        assert_eq!(
            right.finders(right.made.topology.clone(), true),
            [""; 0],
            "{name}"
        );
        for kind in KINDS {
            for (at, topology) in right.damages(kind).into_iter().enumerate() {
                count += 1;
                if right.finders(topology, false).is_empty() {
                    missed.push(format!("{name}: {kind:?} {at}"));
                }
            }
        }
    }
    assert!(
        missed.is_empty(),
        "{} of {count}: {missed:#?}",
        missed.len()
    );
    assert!(count >= 1000, "only {count} damages");
}

const FOLLOW: &str = "lines along which solids do not follow each other";
const BELONG: &str = "points along lines that belong to another volume than their solid";

/// Whether lines find every missed closed curve, of which there is one at least, and nothing in the tables contradicts it.
fn lines_alone_find_missed_curves(right: &Right) {
    let missed = right.damages(Kind::DropClosedCurve);
    assert!(!missed.is_empty());
    for topology in missed {
        let found = right.finders(topology, true);
        assert!(
            found.contains(&FOLLOW) || found.contains(&BELONG),
            "{found:?}"
        );
        assert!(
            !found.contains(&"edges at which loops or solids are open"),
            "{found:?}"
        );
    }
}

#[test]
fn a_closed_curve_of_two_horizons_that_was_missed_is_found_though_everything_fits() {
    lines_alone_find_missed_curves(&Right::new("tests/cases/real-data/wrong-island"));
}

#[test]
fn a_small_island_where_two_horizons_cross_hides_between_no_columns() {
    // Both bent by more than the island is deep; it takes a thousandth of the plan.
    let height =
        |i: u32, j: u32| -40.0 + (0.7 * f64::from(i)).sin() + 0.4 * (0.5 * f64::from(j)).cos();
    let grid = |change: &dyn Fn(u32, u32) -> f64| {
        let row = |j: u32| {
            (0..21)
                .map(|i| height(i, j) + change(i, j))
                .collect::<Vec<_>>()
        };
        format!("{:?}", (0..21).map(row).collect::<Vec<_>>())
    };
    for (i, j) in [(7, 13), (16, 4)] {
        let lower = grid(&|_, _| 0.0);
        let upper = grid(&|a, b| if (a, b) == (i, j) { -0.2 } else { 3.0 });
        let horizon = |id: &str, heights: &str| {
            format!(
                "[[feature]]\nid = \"{id}\"\nkind = \"horizon\"\nfacies = \"mud\"\n\
                 surface = {{ grid = {{ x = [0, 2000], y = [0, 2000], heights = {heights} }} }}\n"
            )
        };
        let text = format!(
            "name = \"Island\"\n[domain]\nx = [0, 2000]\ny = [0, 2000]\nz = [-80, 0]\nfacies = \"mud\"\n[facies.mud]\n{}{}",
            horizon("lower", &lower),
            horizon("upper", &upper)
        );
        let right = Right::of(
            "island",
            &Source::from_text("island.toml", &text, Format::Toml),
        );
        assert_eq!(right.finders(right.made.topology.clone(), true), [""; 0]);
        lines_alone_find_missed_curves(&right);
    }
}

#[test]
#[ignore = "prints which check finds which damage, for ARCHITECTURE.md"]
fn what_finds_what() {
    let mut table: BTreeMap<Kind, (usize, BTreeMap<&str, usize>)> = BTreeMap::new();
    let mut only: BTreeMap<&str, usize> = BTreeMap::new();
    for name in MODELS {
        let right = Right::new(name);
        for kind in KINDS {
            for topology in right.damages(kind) {
                let row = table.entry(kind).or_default();
                row.0 += 1;
                let found = right.finders(topology, true);
                if let [one] = found[..] {
                    *only.entry(one).or_default() += 1;
                }
                for finder in found {
                    *row.1.entry(finder).or_default() += 1;
                }
            }
        }
    }
    for (kind, (count, finders)) in &table {
        eprintln!("{kind:?}: {count}");
        for (finder, times) in finders {
            eprintln!("    {times:4} {finder}");
        }
    }
    eprintln!("found by one check alone: {only:#?}");
}
