//! `clinothem check`: every defect, and who removes what.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::args::ModelArgs;
use super::failure::Failure;
use super::load::{self, Loaded};
use super::print;
use crate::export::data::{DataEntry, ImportedEntry};
use crate::export::wells::entries::{tops, tops_in_words};
use crate::model::rules::{Rules, Verdict, VolumeRules};
use crate::model::{Feature, FeatureKind, HorizonSurface, Model, Quantity, meshing, remarks};

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
    /// The feature that it goes along.
    along: Option<String>,
    /// Whether there is but one of the parent, a horizon's unit.
    parent_is_unit: bool,
    /// The feature whose volume it divides, if that is all that it may take.
    divides: Option<String>,
    removes: Vec<String>,
    spared: Vec<(String, &'static str)>,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = load::realise(&args.model, args.json)?;
    let lines = resolve(&loaded.realisation.volumes, &loaded.realisation.rules);
    let remarks = remarks(&loaded)?;
    if args.json {
        print::out(&json(&loaded, &lines, &remarks).to_string())
    } else {
        print::out(text(&loaded, &lines, &remarks).trim_end())
    }
}

/// What is to be said of the realisation.
fn remarks(loaded: &Loaded) -> Result<Vec<String>, Failure> {
    let realisation = &loaded.realisation;
    let outside = remarks::outside_parents(realisation);
    let empty = remarks::empty(realisation, &loaded.owners()?);
    let empty = remarks::say_empty(realisation, &empty, remarks::Known::ByPoints, &outside);
    let outside = outside.into_iter().map(|remark| remark.text);
    Ok(outside.chain(empty).collect())
}

/// What each feature does to each older one, and to other instances of itself.
fn resolve(volumes: &[VolumeRules], rules: &Rules) -> Vec<Line> {
    let mut features: Vec<&str> = Vec::new();
    let mut of: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let wholes = volumes.iter().enumerate().skip(1);
    // What is in a block is as it is outside of it.
    let is_told = |(_, rules): &(usize, &VolumeRules)| {
        rules.piece_of.is_none() && rules.block.within.is_none() && !rules.block.is_ground
    };
    for (volume, rules) in wholes.filter(is_told) {
        let own = of.entry(&rules.feature).or_default();
        if own.is_empty() {
            features.push(&rules.feature);
        }
        own.push(volume);
    }
    let resolved = Resolved {
        volumes,
        rules,
        features: &features,
        of,
    };
    features
        .iter()
        .map(|feature| resolved.line(feature))
        .collect()
}

/// The volumes and their rules, and the features in order of age.
struct Resolved<'a> {
    volumes: &'a [VolumeRules],
    rules: &'a Rules,
    features: &'a [&'a str],
    /// The volumes of each feature, in order.
    of: BTreeMap<&'a str, Vec<usize>>,
}

impl Resolved<'_> {
    fn of(&self, feature: &str) -> &[usize] {
        self.of.get(feature).map_or(&[], Vec::as_slice)
    }

    /// The features from which a volume takes, and those that it leaves, with the reason.
    fn fate_of_older(
        &self,
        feature: &str,
        body: usize,
    ) -> (Vec<String>, Vec<(String, &'static str)>) {
        let (mut removes, mut spared) = (Vec::new(), Vec::new());
        let holders = std::iter::once("background").chain(self.features.iter().copied());
        for holder in holders {
            let older = if holder == "background" {
                Some(0)
            } else {
                let own = self.of(holder);
                let older = own.partition_point(|volume| *volume < body);
                own[..older].last().copied()
            };
            let Some(older) = older else { continue };
            let name = if holder == feature {
                format!("older {holder}")
            } else {
                holder.to_owned()
            };
            match self.rules.verdict(body, older) {
                Verdict::Takes if self.volumes[body].from == Some(older) => {}
                Verdict::Takes => removes.push(name),
                other => spared.push((name, other.reason())),
            }
        }
        (removes, spared)
    }

    fn line(&self, feature: &str) -> Line {
        let volumes = self.volumes;
        let own = self.of(feature);
        let first = own.first().copied().unwrap_or(0);
        // The youngest instance: it has met every other. Of what divides, only the first meets what others hold.
        let body = match volumes[first].from {
            None => own.last().copied().unwrap_or(0),
            Some(_) => first,
        };
        let (removes, spared) = self.fate_of_older(feature, body);
        let mut facies: Vec<&str> = Vec::new();
        for volume in own {
            if !facies.contains(&volumes[*volume].facies.as_str()) {
                facies.push(&volumes[*volume].facies);
            }
        }
        let parent = volumes[body].parent.map(|parent| &volumes[parent]);
        let along = volumes[body].along.map(|along| &volumes[along]);
        Line {
            name: feature.to_owned(),
            kind: volumes[body].kind.clone(),
            level: volumes[body].level,
            facies: facies.join(", "),
            instances: own.len(),
            parent: parent.map(|parent| parent.feature.clone()),
            along: along.map(|along| along.feature.clone()),
            parent_is_unit: parent.is_some_and(|parent| parent.kind == "horizon"),
            divides: volumes[body].from.map(|from| volumes[from].feature.clone()),
            removes,
            spared,
        }
    }
}

/// A feature's part in the rules, as text.
fn paragraph(line: &Line) -> String {
    let mut out = String::new();
    let parent = line.parent.as_ref().map_or(String::new(), |parent| {
        let each = if line.parent_is_unit { "" } else { "each " };
        format!(", in {each}{parent}")
    });
    let along = line
        .along
        .as_ref()
        .map_or(String::new(), |along| format!(", along each {along}"));
    let _ = writeln!(
        out,
        "\n{} ({}, level {}, {}): {} volume{}{parent}{along}",
        line.name,
        line.kind,
        line.level,
        line.facies,
        line.instances,
        if line.instances == 1 { "" } else { "s" }
    );
    if let Some(unit) = &line.divides {
        let _ = writeln!(out, "  divides {unit}");
    }
    if !line.removes.is_empty() {
        let _ = writeln!(out, "  removes {}", line.removes.join(", "));
    }
    for (name, reason) in &line.spared {
        let _ = writeln!(out, "  {name}: {reason}");
    }
    out
}

fn text(loaded: &Loaded, lines: &[Line], remarks: &[String]) -> String {
    let mut out = String::new();
    let model = &loaded.model;
    let _ = writeln!(out, "{}: no defects", model.name);
    let _ = writeln!(
        out,
        "domain x {:?}, y {:?}, z {:?} m of {}",
        model.domain.x, model.domain.y, model.domain.z, model.facies[model.domain.facies].name
    );
    let bounds = [("base", &model.domain.base), ("top", &model.domain.top)];
    for (name, surface) in bounds {
        if let Some(surface) = surface {
            let _ = writeln!(out, "its {name}: {}", described(surface));
        }
    }
    for line in lines {
        out.push_str(&paragraph(line));
    }
    for event in events(model) {
        let _ = writeln!(out, "\n{event}");
    }
    let blocks = blocks(&loaded.realisation.volumes);
    if !blocks.is_empty() {
        let _ = writeln!(out, "  blocks: {}", blocks.join(", "));
    }
    for (name, file) in model.files() {
        let _ = writeln!(out, "\ndata of {name}: {}", file.described());
    }
    for (name, solid) in model.solids() {
        let _ = writeln!(out, "\nsolid of {name}: {}", solid.described());
    }
    for words in tops_in_words(&tops(model, &loaded.realisation)) {
        let _ = writeln!(out, "\ntops: {words}");
    }
    for rejection in &loaded.realisation.rejections {
        let _ = writeln!(
            out,
            "\nnote: {} of {}'s draws were made again: {}",
            rejection.count, rejection.feature, rejection.reason
        );
    }
    for note in loaded.notes().iter().chain(remarks) {
        let _ = writeln!(out, "\nnote: {note}");
    }
    for advice in meshing::advice(&loaded.realisation) {
        let _ = writeln!(out, "\nmeshing: {advice}");
    }
    out
}

/// What moves what is older, in words, the oldest first.
fn events(model: &Model) -> Vec<String> {
    let events = model
        .features
        .iter()
        .filter(|one| one.enabled && one.kind.nature().is_event());
    let words = |event: &Feature| {
        let does = match &event.kind {
            FeatureKind::Fault(_) => {
                "parts all that is older in blocks, and moves its hanging wall"
            }
            _ => "moves all that is older",
        };
        format!("{} ({}): {does}", event.id, event.kind.name())
    };
    events.map(words).collect()
}

/// The blocks that faults part.
fn blocks(volumes: &[VolumeRules]) -> Vec<&str> {
    let mut blocks: Vec<&str> = Vec::new();
    for volume in volumes {
        let block = volume.block.name.as_str();
        if !block.is_empty() && !blocks.contains(&block) {
            blocks.push(block);
        }
    }
    blocks
}

fn json(loaded: &Loaded, lines: &[Line], remarks: &[String]) -> serde_json::Value {
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
                "along": line.along,
                "divides": line.divides,
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
    let data: Vec<_> = loaded
        .model
        .files()
        .map(|(of, file)| DataEntry::of(of, file))
        .collect();
    serde_json::json!({ "model": loaded.model.name, "defects": [], "features": features,
        "events": events(&loaded.model),
        "blocks": blocks(&loaded.realisation.volumes),
        "decisions": loaded.realisation.decisions, "notes": notes,
        "remarks": remarks,
        "data": data,
        "imported": loaded.model.solids().map(|(of, solid)| ImportedEntry::of(of, solid)).collect::<Vec<_>>(),
        "tops": tops(&loaded.model, &loaded.realisation),
        "meshing": meshing::advice(&loaded.realisation) })
}

/// A surface in a few words.
fn described(surface: &HorizonSurface) -> String {
    let number = |quantity: &Quantity| match quantity.support() {
        (low, high) if low == high => format!("{low}"),
        (low, high) => format!("{low} to {high}"),
    };
    match surface {
        HorizonSurface::Level(level) => format!("level at {} m", number(level)),
        HorizonSurface::Dipping {
            dip_deg,
            azimuth_deg,
            ..
        } => format!(
            "dipping by {}° towards {}°",
            number(dip_deg),
            number(azimuth_deg)
        ),
        HorizonSurface::Grid { heights, .. } => {
            let columns = heights.first().map_or(0, Vec::len);
            format!("a grid of {} × {columns} heights", heights.len())
        }
        HorizonSurface::Points { points, tolerance } => {
            format!("within {tolerance} m of {} points", points.len())
        }
        HorizonSurface::Net { net, tolerance } => {
            let rows = &net.net.points;
            let columns = rows.first().map_or(0, Vec::len);
            format!(
                "within {tolerance} m of a net of {} × {columns} points",
                rows.len()
            )
        }
        // What became of it stands among the data.
        HorizonSurface::File(file) => format!("from {}", file.file),
        // Not of the domain's base or top.
        HorizonSurface::Above { .. } => "as thick above another horizon as given".to_owned(),
    }
}

#[cfg(test)]
#[path = "check_tests.rs"]
mod tests;
