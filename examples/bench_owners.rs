//! Says which volume holds each point, by the point evaluator alone: what cells of other programs are told apart by.
//!
//! `cargo run --release --example bench_owners MODEL [SETTING…] < POINTS`
//!
//! A line `x y z` per point (m) comes in on standard input; the volume's name goes out, an empty line outside of the domain.

mod bench;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::io::{BufRead, Write};

    use clinothem::model::owner::Owners;
    use glam::DVec3;

    let mut args = std::env::args().skip(1);
    let model = args.next().ok_or("a model file, and settings")?;
    let (_, realisation) = bench::realise(&model, args)?;
    let owners = Owners::new(&realisation)?;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let numbers = line.split_whitespace().map(str::parse);
        let &[x, y, z] = numbers.collect::<Result<Vec<f64>, _>>()?.as_slice() else {
            return Err(format!("`{line}` is no point: three numbers are").into());
        };
        let name = owners
            .at(DVec3::new(x, y, z))
            .map_or("", |volume| &realisation.volumes[volume].name);
        writeln!(out, "{name}")?;
    }
    Ok(())
}
