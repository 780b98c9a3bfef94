//! Times one engine on a model, from control nets to proven solids in memory: a line of JSON.
//!
//! `cargo run --release --example bench_engine MODEL partition|occt BREP [SETTING…]`
//!
//! The clock runs over the plan, the point evaluator, the assembly and the fast proof. Both engines run in this
//! process with all of the machine's processors: the general fuse in no child process, so that its memory counts.
//! After the clock, the solids are written as BREP.

#[cfg(feature = "occt")]
mod bench;

#[cfg(feature = "occt")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::io::Write;

    let mut args = std::env::args().skip(1);
    let (Some(model), Some(engine), Some(brep)) = (args.next(), args.next(), args.next()) else {
        return Err("a model file, partition or occt, a file for the solids, and settings".into());
    };
    let engine = match engine.as_str() {
        "partition" => clinothem::assembly::Engine::Partition,
        "occt" => clinothem::assembly::Engine::Occt,
        other => return Err(format!("no engine `{other}`; there are partition and occt").into()),
    };
    let case = bench::realise(&model, args)?;
    let result = timed::run(&case, engine, brep.as_ref())?;
    writeln!(std::io::stdout(), "{result}")?;
    Ok(())
}

#[cfg(not(feature = "occt"))]
fn main() {}

#[cfg(feature = "occt")]
mod timed {
    use std::error::Error;
    use std::path::Path;
    use std::time::Instant;

    use clinothem::assembly::{self, Assembly, Cancel, Engine, Options, Subject, proof};
    use clinothem::export::brep;
    use clinothem::export::report::{LEAST_AREA, Parts, Report};
    use clinothem::model::Model;
    use clinothem::model::plan::AssemblyPlan;
    use clinothem::model::realisation::Realisation;
    use clinothem::model::selection::Selection;
    use serde_json::{Map, Value, json};

    pub(crate) fn run(
        (model, realisation): &(Model, Realisation),
        engine: Engine,
        file: &Path,
    ) -> Result<Value, Box<dyn Error>> {
        let options = Options {
            engine,
            child: None,
            threads: 0,
            proof: proof::Level::Fast,
            seed: model.seed,
        };
        let started = Instant::now();
        let subject = Subject::new(realisation.clone())?;
        let again = |step: f64| Realisation::by_age(model, &Selection::default(), step);
        let (subject, made) =
            assembly::assemble(subject, &again, &options, &Cancel::new(), &|_, _| ())?;
        let seconds = started.elapsed().as_secs_f64();
        let Subject {
            realisation, plan, ..
        } = &subject;
        // Before the report and the file, which are in neither time nor memory.
        let mut result = result(plan, &made, seconds);
        let report = Report::new(Parts {
            model,
            realisation,
            plan,
            assembly: &made,
            wells: &[],
            level: options.proof,
            with_bounds: false,
            least_area: LEAST_AREA,
        });
        let program = &report.program;
        result["version"] = json!(format!(
            "clinothem {} on OpenCASCADE {}",
            program.version, program.occt
        ));
        brep::write(file, &made)?;
        Ok(result)
    }

    fn result(plan: &AssemblyPlan, made: &Assembly, seconds: f64) -> Value {
        let measured = &made.measured;
        let volumes: Map<String, Value> = (0..plan.names.len())
            .filter(|volume| !measured.pieces_of(*volume).is_empty())
            .map(|volume| (plan.names[volume].clone(), json!(measured.size_of(volume))))
            .collect();
        let sum: f64 = measured.pieces.iter().map(|piece| piece.size).sum();
        let stages: Map<String, Value> = made
            .timings
            .iter()
            .map(|(stage, time)| ((*stage).to_owned(), json!(time.as_secs_f64())))
            .collect();
        json!({
            "seconds": seconds,
            "stages": stages,
            "peak_mib": peak_mib(),
            "solids": measured.pieces.len(),
            "faces": measured.faces,
            "edges": measured.edges,
            "crossing_pairs": made.crossing_bodies,
            "volume_error": sum - (plan.high() - plan.low()).element_product(),
            "engine": made.engine.name(),
            "remedy": made.remedy,
            "failed_attempts": made.failed.len(),
            "proven": made.proof.holds(),
            "volumes": volumes,
        })
    }

    /// Peak resident memory of this process, where the system tells (Linux).
    fn peak_mib() -> Option<f64> {
        let status = std::fs::read_to_string("/proc/self/status").ok()?;
        let line = status
            .lines()
            .find_map(|line| line.strip_prefix("VmHWM:"))?;
        let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
        Some(kib / 1024.0)
    }
}
