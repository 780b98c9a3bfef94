//! `clinothem locate`: which volume holds a point, and why.

use std::collections::BTreeMap;

use glam::DVec3;

use super::args::{ModelArgs, finite};
use super::failure::Failure;
use super::{load, print};

/// Tell which volume holds a point, and which bodies had a say.
///
/// Needs no kernel: the answer comes from the control nets and the rules.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:
  clinothem locate channel-belt.toml 500 500 -20")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// Easting (m).
    #[arg(value_parser = finite, allow_negative_numbers = true)]
    x: f64,
    /// Northing (m).
    #[arg(value_parser = finite, allow_negative_numbers = true)]
    y: f64,
    /// Elevation (m, up).
    #[arg(value_parser = finite, allow_negative_numbers = true)]
    z: f64,
    /// How near a face counts as on it (m).
    #[arg(long, value_parser = finite, allow_negative_numbers = true, default_value = "1e-6")]
    tolerance: f64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if !(args.tolerance > 0.0) {
        return Err(Failure::Wrong(format!(
            "the tolerance is {}; it must be above 0",
            args.tolerance
        )));
    }
    let loaded = load::realise(&args.model, args.json)?;
    let owners = loaded.owners()?;
    let point = DVec3::new(args.x, args.y, args.z);
    let Some(location) = owners.locate(point, args.tolerance) else {
        let domain = &loaded.model.domain;
        return Err(Failure::Wrong(format!(
            "the point {}, {}, {} lies outside the domain: x {:?}, y {:?}, z {:?}",
            args.x, args.y, args.z, domain.x, domain.y, domain.z
        )));
    };
    let volumes = &loaded.realisation.volumes;
    let name = |volume: usize| volumes[volume].name.as_str();
    let rock = &loaded.realisation.properties[location.owner];
    if args.json {
        let history: Vec<_> = location
            .history
            .iter()
            .map(|(volume, verdict)| {
                serde_json::json!({ "volume": name(*volume), "verdict": format!("{verdict:?}") })
            })
            .collect();
        let boundary: Vec<&str> = location
            .boundary
            .iter()
            .map(|volume| name(*volume))
            .collect();
        let properties: BTreeMap<&str, serde_json::Value> = rock
            .values
            .iter()
            .map(|(name, property)| (name.as_str(), property.to_json()))
            .collect();
        let answer = serde_json::json!({
            "point": [args.x, args.y, args.z],
            "volume": name(location.owner),
            "facies": volumes[location.owner].facies,
            "properties": properties,
            "boundary_of": boundary,
            "history": history,
        });
        return print::out(&answer.to_string());
    }
    let facies = &volumes[location.owner].facies;
    let mut lines = vec![format!("{} ({facies})", name(location.owner))];
    for (property, value) in &rock.values {
        let numbers: Vec<String> = value.numbers().iter().map(f64::to_string).collect();
        lines.push(format!("{property}: {}", numbers.join(" ")));
    }
    if !location.boundary.is_empty() {
        let names: Vec<&str> = location
            .boundary
            .iter()
            .map(|volume| name(*volume))
            .collect();
        lines.push(format!("on the boundary of {}", names.join(" and ")));
    }
    if !location.history.is_empty() {
        lines.push(format!("starting from {}:", name(0)));
    }
    for (volume, verdict) in &location.history {
        lines.push(format!("  {} {}", name(*volume), verdict.reason()));
    }
    print::out(&lines.join("\n"))
}
