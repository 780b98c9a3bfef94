//! Writes a model's bodies and the domain's box as BREP files, for other programs to make solids of: closed bodies as
//! solids, sides as the faces of their sheets. Prints how many there are of each, as JSON.
//!
//! `cargo run --release --example bench_bodies MODEL FOLDER [SETTING…]`

#[cfg(feature = "occt")]
mod bench;

#[cfg(feature = "occt")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::io::Write;

    use clinothem::export::bodies;
    use clinothem::features::body::Body;
    use clinothem::model::plan::AssemblyPlan;

    let mut args = std::env::args().skip(1);
    let (Some(model), Some(folder)) = (args.next(), args.next()) else {
        return Err("a model file, a folder, and settings".into());
    };
    let (_, realisation) = bench::realise(&model, args)?;
    let plan = AssemblyPlan::new(&realisation)?;
    std::fs::create_dir_all(&folder)?;
    bodies::write(folder.as_ref(), &plan)?;
    let (mut solids, mut sheets) = (0, 0);
    for body in &plan.bodies {
        match &plan.shells[body.shell].body {
            Body::Side(side) => sheets += side.sheets().len(),
            Body::Trough(_) | Body::Ellipsoid(_) | Body::Shell(_) | Body::Imported(_) => {
                solids += 1;
            }
        }
    }
    let told = serde_json::json!({ "solids": solids, "sheets": sheets });
    writeln!(std::io::stdout(), "{told}")?;
    Ok(())
}

#[cfg(not(feature = "occt"))]
fn main() {}
