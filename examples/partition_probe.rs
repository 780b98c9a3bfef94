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
    for one in args {
        if let Some(n) = one.strip_prefix("runs=") {
            runs = n.parse()?;
        } else {
            source.set(one);
        }
    }
    let model = Model::check(&source).map_err(|d| d.to_string())?;
    let realisation = Realisation::new(&model, &Selection::default())?;
    let corner = |i: usize| DVec3::new(model.domain.x[i], model.domain.y[i], model.domain.z[i]);
    let mut regions = vec![Region::Block { low: corner(0), high: corner(1) }];
    let mut volumes = Vec::new();
    for instance in &realisation.instances {
        regions.push(Region::Shell(instance.body.sheets()?.into_iter().map(|s| s.1).collect()));
        volumes.push(instance.volume);
    }
    let rules = &realisation.rules;
    let labels = |inside: &[bool]| inside[0].then(|| rules.owner(|volume| {
        volumes.iter().position(|v| *v == volume).is_some_and(|at| inside[at + 1])
    }));
    for _ in 0..runs {
        let started = Instant::now();
        let made = partition::partition(regions.clone(), &labels, &Options::default())?;
        let total = started.elapsed();
        let t = &made.topology;
        let size = (corner(1) - corner(0)).element_product();
        let sum: f64 = t.solids.iter().map(|s| s.size).sum();
        let deviation = t.edges.iter().fold(0.0_f64, |m, e| m.max(e.deviation));
        let gap = t.vertices.iter().fold(0.0_f64, |m, v| m.max(v.gap));
        println!("{total:.1?} {:?}", made.timings);
        println!("faults: {}", made.faults);
        println!("solids {} faces {} edges {} vertices {} branches {} | volume error {:.3e} m3 | deviation {deviation:.1e} gap {gap:.1e}",
            t.solids.len(), t.faces.len(), t.edges.len(), t.vertices.len(), made.branches, sum - size);
    }
    Ok(())
}
