//! Connectivity of sandbodies, exact and on grids whose cells are halved again and again: Fig. 1 of Jacquemyn, Jackson &
//! Hampson (2019) in numbers.
//!
//! `cargo run --release --example grid_or_surface FOLDER [MODEL [FIRST LAST [HALVINGS]]]`
//!
//! For the seeds FIRST to LAST of a model: groups of net solids that share faces, as the report of a build has them; and groups of
//! cells that are net by their middle and share faces. The first cells are an eighth of the domain wide and as high as a twenty-fifth
//! of their width. Writes `grid-or-surface.csv`, `.svg` and `.png` to FOLDER, and the means to standard output.

#[cfg(feature = "occt")]
#[path = "../bench/mod.rs"]
mod bench;
#[cfg(feature = "occt")]
mod cells;
#[cfg(feature = "occt")]
mod plot;

#[cfg(feature = "occt")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    comparison::run()
}

#[cfg(not(feature = "occt"))]
fn main() {}

#[cfg(feature = "occt")]
mod comparison {
    use std::error::Error;
    use std::io::Write;
    use std::path::Path;

    use clinothem::assembly::{self, Cancel, Engine, Options, Subject, proof};
    use clinothem::export::picture::rasterised;
    use clinothem::export::report::{LEAST_AREA, Parts, Report};
    use clinothem::model::Model;
    use clinothem::model::realisation::Realisation;
    use clinothem::model::selection::Selection;
    use glam::DVec3;

    use super::bench;
    use super::cells::{Connectivity, groups};
    use super::plot::{self, Compared};

    const MODEL: &str = "models/fig01-grid-or-surface/fig01-grid-or-surface.toml";
    /// Cells along x and y of the coarsest grid.
    const COARSEST: usize = 8;
    /// Width over height of cells.
    const FLATNESS: f64 = 25.0;

    pub(super) fn run() -> Result<(), Box<dyn Error>> {
        let args: Vec<String> = std::env::args().skip(1).collect();
        let folder = args.first().ok_or("a folder for the results")?;
        let model = args.get(1).map_or(MODEL, String::as_str);
        let number =
            |at: usize, without: u64| args.get(at).map_or(Ok(without), |text| text.parse());
        let (first, last, halvings) = (number(2, 1)?, number(3, 20)?, number(4, 4)?);
        let mut all = Vec::new();
        let mut sizes = Vec::new();
        for seed in first..=last {
            let settings = [format!("seed={seed}")];
            let (model, realisation) = bench::realise(model, settings.into_iter())?;
            let (exact, subject) = exact(&model, realisation)?;
            let mut grids = Vec::new();
            sizes.clear();
            for halving in 0..=u32::try_from(halvings)? {
                let counts = counts(&subject, halving);
                sizes.push(size(&subject, counts));
                grids.push(on_grid(&subject, counts));
            }
            all.push(Compared { seed, exact, grids });
        }
        write(folder.as_ref(), &all, &sizes)
    }

    /// What the surfaces say.
    fn exact(
        model: &Model,
        realisation: Realisation,
    ) -> Result<(Connectivity, Subject), Box<dyn Error>> {
        let options = Options {
            engine: Engine::Partition,
            child: None,
            threads: 0,
            proof: proof::Level::Fast,
            seed: model.seed,
        };
        let again = |step: f64| Realisation::by_age(model, &Selection::default(), step);
        let subject = Subject::new(realisation)?;
        let (subject, assembly) =
            assembly::assemble(subject, &again, &options, &Cancel::new(), &|_, _| ())?;
        let report = Report::new(Parts {
            model,
            realisation: &subject.realisation,
            plan: &subject.plan,
            assembly: &assembly,
            wells: &[],
            level: options.proof,
            with_bounds: false,
            least_area: LEAST_AREA,
        });
        let groups = report.connectivity.groups.iter();
        let sizes: Vec<f64> = groups.map(|group| group.net_volume_m3).collect();
        let block = subject.plan.extent.volume();
        Ok((Connectivity::of(&sizes, block), subject))
    }

    fn span(subject: &Subject) -> DVec3 {
        subject.plan.high() - subject.plan.low()
    }

    fn size(subject: &Subject, counts: [usize; 3]) -> DVec3 {
        span(subject) / DVec3::from_array(counts.map(|count| count as f64))
    }

    /// Cells along x, y and z.
    fn counts(subject: &Subject, halving: u32) -> [usize; 3] {
        let span = span(subject);
        let across = COARSEST << halving;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a number of cells, at least one"
        )]
        let as_many = |length: f64, size: f64| (length / size).round().max(1.0) as usize;
        let width = span.x / across as f64;
        [
            across,
            as_many(span.y, width),
            as_many(span.z, width / FLATNESS),
        ]
    }

    /// What a grid says: a cell is what its middle is.
    fn on_grid(subject: &Subject, counts: [usize; 3]) -> Connectivity {
        let size = size(subject, counts);
        let low = subject.plan.low();
        let properties = &subject.realisation.properties;
        let is_net: Vec<bool> = properties
            .iter()
            .map(|rock| rock.scalar("net").is_some_and(|net| net > 0.0))
            .collect();
        let found = groups(counts, |cell| {
            let middle = DVec3::from_array(cell.map(|at| at as f64 + 0.5));
            let owner = subject.owners.at(low + middle * size);
            owner.is_some_and(|volume| is_net[volume])
        });
        let cell = size.element_product();
        let sizes: Vec<f64> = found.iter().map(|cells| *cells as f64 * cell).collect();
        Connectivity::of(&sizes, subject.plan.extent.volume())
    }

    /// Table and plot, and what is printed.
    fn write(folder: &Path, all: &[Compared], sizes: &[DVec3]) -> Result<(), Box<dyn Error>> {
        std::fs::create_dir_all(folder)?;
        let mut table = csv::Writer::from_path(folder.join("grid-or-surface.csv"))?;
        table.write_record([
            "seed",
            "cell_width_m",
            "cell_height_m",
            "bodies",
            "net_to_gross",
            "largest_share",
            "gamma",
        ])?;
        for one in all {
            let exact = (String::new(), String::new(), &one.exact);
            let grids = sizes.iter().zip(&one.grids);
            let grids = grids.map(|(size, grid)| (size.x.to_string(), size.z.to_string(), grid));
            for (width, height, of) in std::iter::once(exact).chain(grids) {
                table.write_record([
                    one.seed.to_string(),
                    width,
                    height,
                    of.bodies.to_string(),
                    of.net_to_gross.to_string(),
                    of.largest_share.to_string(),
                    of.gamma.to_string(),
                ])?;
            }
        }
        table.flush()?;
        let widths: Vec<f64> = sizes.iter().map(|size| size.x).collect();
        let svg = plot::svg(all, &widths)?;
        std::fs::write(folder.join("grid-or-surface.svg"), &svg)?;
        let (width, height) = plot::SIZE;
        let png = rasterised(&svg, [width, height], 1.0)?;
        std::fs::write(folder.join("grid-or-surface.png"), png)?;
        let mut out = std::io::stdout().lock();
        writeln!(out, "cells (m)    bodies  N/G     largest  Γ       |ΔΓ|")?;
        let mean =
            |of: &dyn Fn(&Compared) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
        for at in 0..=sizes.len() {
            let of = |one: &Compared| *one.grids.get(at).unwrap_or(&one.exact);
            let name = sizes.get(at).map_or_else(
                || "exact".to_owned(),
                |size| format!("{} × {}", size.x, size.z),
            );
            writeln!(
                out,
                "{name:12} {:6.2}  {:.4}  {:.4}   {:.4}  {:.4}",
                mean(&|one| of(one).bodies as f64),
                mean(&|one| of(one).net_to_gross),
                mean(&|one| of(one).largest_share),
                mean(&|one| of(one).gamma),
                mean(&|one| (of(one).gamma - one.exact.gamma).abs()),
            )?;
        }
        Ok(())
    }
}
