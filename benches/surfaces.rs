//! How long surfaces and point queries of the channel belt take, without the kernel.
//!
//! `cargo bench --bench surfaces`
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    missing_docs,
    reason = "a benchmark fails by panicking, and has no readers but its own"
)]

use std::hint::black_box;

use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source, Stream};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;

const BELT: &str = include_str!("../models/channel-belt/channel-belt.toml");

fn belt() -> Model {
    let source = Source::from_text("channel-belt.toml", BELT, Format::Toml);
    Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"))
}

fn surfaces(criterion: &mut Criterion) {
    let model = belt();
    let selection = Selection::default();
    let realise = || Realisation::new(black_box(&model), &selection).unwrap();
    criterion.bench_function("channel belt: draws and surfaces", |bench| {
        bench.iter(realise);
    });
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    criterion.bench_function("channel belt: draws and surfaces, one thread", |bench| {
        bench.iter(|| one.install(realise));
    });
    let realisation = realise();
    criterion.bench_function("channel belt: point evaluator made ready", |bench| {
        bench.iter(|| Owners::new(black_box(&realisation)).unwrap());
    });
}

/// Points asked in one go.
const POINTS: usize = 10_000;

fn owner(criterion: &mut Criterion) {
    let model = belt();
    let realisation = Realisation::new(&model, &Selection::default()).unwrap();
    let owners = Owners::new(&realisation).unwrap();
    let (low, high) = (owners.extent().low(), owners.extent().high());
    let mut stream = Stream::new(1, "bench", "1", "points", 0);
    let points: Vec<DVec3> = (0..POINTS)
        .map(|_| low + (high - low) * DVec3::new(stream.unit(), stream.unit(), stream.unit()))
        .collect();
    let mut group = criterion.benchmark_group("channel belt");
    group.throughput(Throughput::Elements(POINTS as u64));
    group.bench_function("owner of 10 000 points, one thread", |bench| {
        bench.iter_batched(
            || &points,
            |points| {
                points
                    .iter()
                    .filter_map(|point| owners.at(*point))
                    .sum::<usize>()
            },
            BatchSize::LargeInput,
        );
    });
    group.finish();
}

criterion_group!(benches, surfaces, owner);
criterion_main!(benches);
