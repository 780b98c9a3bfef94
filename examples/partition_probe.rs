//! Partitions the bodies of a model by the partition kernel alone and prints what it found.
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};
use clinothem::partition::{self, Options, Region};
use glam::DVec3;
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let path = args.next().ok_or("a model file, then overrides")?;
    let mut source = Source::from_text(&path, &std::fs::read_to_string(&path)?, Format::Toml);
    let mut runs = 1;
    let mut seeds = None;
    for one in args {
        if let Some(n) = one.strip_prefix("runs=") {
            runs = n.parse()?;
        } else if let Some(range) = one.strip_prefix("seeds=") {
            let (a, b) = range.split_once("..").ok_or("seeds=A..B")?;
            seeds = Some(a.parse::<u64>()?..=b.parse::<u64>()?);
        } else {
            source.set(one);
        }
    }
    if let Some(seeds) = seeds {
        let (mut bad, mut count) = (0, 0);
        for seed in seeds {
            let mut own = source.clone();
            own.set(format!("seed={seed}"));
            count += 1;
            let why = match one(&own, 1, false)? {
                (faults, error, negative)
                    if faults != "none" || error.abs() > 1e-3 || negative > 0 =>
                {
                    format!("{faults}; volume error {error:.3e}; negative {negative}")
                }
                _ => continue,
            };
            bad += 1;
            println!("seed {seed}: {why}");
        }
        println!("{bad} bad of {count}");
        return Ok(());
    }
    one(&source, runs, true)?;
    Ok(())
}

fn one(source: &Source, runs: usize, print: bool) -> Result<(String, f64, usize), Box<dyn Error>> {
    let mut last = (String::new(), 0.0, 0);
    let model = Model::check(source).map_err(|d| d.to_string())?;
    let realisation = Realisation::new(&model, &Selection::default())?;
    let corner = |i: usize| DVec3::new(model.domain.x[i], model.domain.y[i], model.domain.z[i]);
    let mut regions = vec![Region::Block {
        low: corner(0),
        high: corner(1),
    }];
    let mut volumes = Vec::new();
    for instance in &realisation.instances {
        regions.push(Region::Shell(
            instance.body.sheets()?.into_iter().map(|s| s.1).collect(),
        ));
        volumes.push(instance.volume);
    }
    let rules = &realisation.rules;
    let labels = |inside: &[bool]| {
        inside[0].then(|| {
            rules.owner(|volume| {
                volumes
                    .iter()
                    .position(|v| *v == volume)
                    .is_some_and(|at| inside[at + 1])
            })
        })
    };
    for _ in 0..runs {
        let started = Instant::now();
        let made = partition::partition(regions.clone(), &labels, &Options::default())?;
        let total = started.elapsed();
        let t = &made.topology;
        let size = (corner(1) - corner(0)).element_product();
        let sum: f64 = t.solids.iter().map(|s| s.size).sum();
        let deviation = t.edges.iter().fold(0.0_f64, |m, e| m.max(e.deviation));
        let gap = t.vertices.iter().fold(0.0_f64, |m, v| m.max(v.gap));
        last = (
            made.faults.to_string(),
            sum - size,
            t.solids.iter().filter(|s| !(s.size > 0.0)).count(),
        );
        if !print {
            continue;
        }
        println!("{total:.1?} {:?}", made.timings);
        println!("faults: {}", made.faults);
        println!(
            "solids {} faces {} edges {} vertices {} branches {} | volume error {:.3e} m3 | deviation {deviation:.1e} gap {gap:.1e}",
            t.solids.len(),
            t.faces.len(),
            t.edges.len(),
            t.vertices.len(),
            made.branches,
            sum - size
        );
    }
    Ok(last)
}
