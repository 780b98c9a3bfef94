//! Writes a channel belt's bodies and the domain's box as BREP files, for other programs to make solids of.
//!
//! `cargo run --release --example bench_bodies MODEL COUNT FOLDER`

#[cfg(feature = "occt")]
mod belt;

#[cfg(feature = "occt")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use clinothem::export::bodies;
    use clinothem::model::plan::AssemblyPlan;

    let mut args = std::env::args().skip(1);
    let (Some(model), Some(count), Some(folder)) = (args.next(), args.next(), args.next()) else {
        return Err("a model file, the number of channels, and a folder".into());
    };
    let (_, realisation) = belt::realise(&model, count.parse()?)?;
    let plan = AssemblyPlan::new(&realisation)?;
    std::fs::create_dir_all(&folder)?;
    bodies::write(folder.as_ref(), &plan)?;
    Ok(())
}

#[cfg(not(feature = "occt"))]
fn main() {}
