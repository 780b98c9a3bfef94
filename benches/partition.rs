//! How long the partition kernel takes on the channel belt (20 channels), whole and by stage.
//!
//! `cargo bench --bench partition`
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    missing_docs,
    reason = "a benchmark fails by panicking, and has no readers but its own"
)]

use std::hint::black_box;
use std::time::Duration;

use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};
use clinothem::partition::{self, Options, Partition, Region};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use glam::DVec3;

const BELT: &str = include_str!("../models/channel-belt/channel-belt.toml");

struct Belt {
    realisation: Realisation,
    /// The block, then one shell per channel.
    regions: Vec<Region>,
    /// The volume of each shell.
    volumes: Vec<usize>,
}

impl Belt {
    fn new() -> Self {
        let source = Source::from_text("channel-belt.toml", BELT, Format::Toml);
        let model = Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let corner = |i: usize| DVec3::new(model.domain.x[i], model.domain.y[i], model.domain.z[i]);
        let mut regions = vec![Region::Block {
            low: corner(0),
            high: corner(1),
        }];
        let mut volumes = Vec::new();
        for instance in &realisation.instances {
            let sheets = instance.body.sheets().unwrap();
            regions.push(Region::Shell(sheets.into_iter().map(|s| s.1).collect()));
            volumes.push(instance.volume);
        }
        Self {
            realisation,
            regions,
            volumes,
        }
    }

    fn partition(&self, regions: Vec<Region>) -> Partition {
        let holds = |inside: &[bool], volume: usize| {
            let at = self.volumes.iter().position(|own| *own == volume);
            at.is_some_and(|at| inside[at + 1])
        };
        let labels = |inside: &[bool]| {
            let owner = || self.realisation.rules.owner(|volume| holds(inside, volume));
            inside[0].then(owner)
        };
        let made = partition::partition(regions, &labels, &Options::default()).unwrap();
        assert!(made.faults.is_none(), "{}", made.faults);
        made
    }
}

fn whole(criterion: &mut Criterion) {
    let belt = Belt::new();
    let run = |regions| belt.partition(black_box(regions));
    let copy = || belt.regions.clone();
    criterion.bench_function("partition of the channel belt", |bench| {
        bench.iter_batched(copy, run, BatchSize::LargeInput);
    });
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    criterion.bench_function("partition of the channel belt, one thread", |bench| {
        let run = |regions| one.install(|| run(regions));
        bench.iter_batched(copy, run, BatchSize::LargeInput);
    });
}

/// Each stage as the partition times it; whatever else runs is not counted.
fn stages(criterion: &mut Criterion) {
    let belt = Belt::new();
    let timings = || belt.partition(black_box(belt.regions.clone())).timings;
    let mut group = criterion.benchmark_group("partition of the channel belt, stage");
    group.sample_size(20);
    for (stage, (name, _)) in timings().into_iter().enumerate() {
        group.bench_function(name, |bench| {
            bench.iter_custom(|runs| (0..runs).map(|_| timings()[stage].1).sum::<Duration>());
        });
    }
    group.finish();
}

criterion_group!(benches, whole, stages);
criterion_main!(benches);
