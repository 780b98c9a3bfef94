//! `clinothem check`: every defect, and who removes what.

use std::fmt::Write;

use super::args::ModelArgs;
use super::failure::Failure;
use super::load::{self, Loaded};
use super::print;
use crate::model::rules::Verdict;

/// Report every defect of a model file, and how its rules resolve.
///
/// Makes the draws too, so a model that passes has surfaces; no kernel is needed.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem check channel-belt.toml
  clinothem check channel-belt.toml --set feature.channel.count=40 --json")]
pub(super) struct Args {
    #[command(flatten)]
    model: ModelArgs,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// A feature's part in the rules, told on its first instance.
struct Line {
    name: String,
    kind: String,
    level: u32,
    facies: String,
    instances: usize,
    parent: Option<String>,
    removes: Vec<String>,
    spared: Vec<(String, &'static str)>,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = load::realise(&args.model, args.json)?;
    let lines = resolve(&loaded);
    if args.json {
        print::out(&json(&loaded, &lines).to_string());
    } else {
        print::out(text(&loaded, &lines).trim_end());
    }
    Ok(())
}

/// What each feature does to each older one, and to other instances of itself.
fn resolve(loaded: &Loaded) -> Vec<Line> {
    let volumes = &loaded.realisation.volumes;
    let rules = &loaded.realisation.rules;
    let of = |feature: &str| -> Vec<usize> {
        (1..volumes.len())
            .filter(|volume| volumes[*volume].feature == feature)
            .collect()
    };
    let mut features: Vec<&str> = Vec::new();
    for volume in &volumes[1..] {
        if !features.contains(&volume.feature.as_str()) {
            features.push(&volume.feature);
        }
    }
    let line = |feature: &&str| {
        let feature = *feature;
        // The youngest instance: it has met every other.
        let body = of(feature).last().copied().unwrap_or(0);
        let (mut removes, mut spared) = (Vec::new(), Vec::new());
        let holders = std::iter::once("background").chain(features.iter().copied());
        for holder in holders {
            let older = if holder == "background" {
                Some(0)
            } else {
                of(holder)
                    .into_iter()
                    .take_while(|volume| *volume < body)
                    .last()
            };
            let Some(older) = older else { continue };
            let name = if holder == feature {
                format!("older {holder}")
            } else {
                holder.to_owned()
            };
            match rules.verdict(body, older) {
                Verdict::Takes => removes.push(name),
                other => spared.push((name, other.reason())),
            }
        }
        let first = &volumes[body];
        Line {
            name: feature.to_owned(),
            kind: first.kind.clone(),
            level: first.level,
            facies: first.facies.clone(),
            instances: of(feature).len(),
            parent: first.parent.map(|parent| volumes[parent].feature.clone()),
            removes,
            spared,
        }
    };
    features.iter().map(line).collect()
}

fn text(loaded: &Loaded, lines: &[Line]) -> String {
    let mut out = String::new();
    let model = &loaded.model;
    let _ = writeln!(out, "{}: no defects", model.name);
    let _ = writeln!(
        out,
        "domain x {:?}, y {:?}, z {:?} m of {}",
        model.domain.x, model.domain.y, model.domain.z, model.facies[model.domain.facies].name
    );
    for line in lines {
        let parent = line
            .parent
            .as_ref()
            .map_or(String::new(), |parent| format!(", in each {parent}"));
        let _ = writeln!(
            out,
            "\n{} ({}, level {}, {}): {} volume{}{parent}",
            line.name,
            line.kind,
            line.level,
            line.facies,
            line.instances,
            if line.instances == 1 { "" } else { "s" }
        );
        if !line.removes.is_empty() {
            let _ = writeln!(out, "  removes {}", line.removes.join(", "));
        }
        for (name, reason) in &line.spared {
            let _ = writeln!(out, "  {name}: {reason}");
        }
    }
    for rejection in &loaded.realisation.rejections {
        let _ = writeln!(
            out,
            "\nnote: {} of {}'s draws were made again: {}",
            rejection.count, rejection.feature, rejection.reason
        );
    }
    for note in &model.notes {
        let _ = writeln!(out, "\nnote: {}: {}", note.place, note.message);
    }
    out
}

fn json(loaded: &Loaded, lines: &[Line]) -> serde_json::Value {
    let features: Vec<_> = lines
        .iter()
        .map(|line| {
            let spared: Vec<_> = line
                .spared
                .iter()
                .map(|(name, reason)| serde_json::json!({ "name": name, "why": reason }))
                .collect();
            serde_json::json!({
                "id": line.name,
                "kind": line.kind,
                "level": line.level,
                "facies": line.facies,
                "volumes": line.instances,
                "parent": line.parent,
                "removes": line.removes,
                "spares": spared,
            })
        })
        .collect();
    let notes: Vec<_> = loaded
        .model
        .notes
        .iter()
        .map(|note| serde_json::json!({ "place": note.place.to_string(), "message": note.message }))
        .collect();
    serde_json::json!({ "model": loaded.model.name, "defects": [], "features": features, "notes": notes })
}
