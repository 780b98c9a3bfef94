//! What a report says of wells.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use crate::features::well::Path;
use crate::model::Model;
use crate::model::realisation::Realisation;
use crate::model::wells::log::{Crossing, Interval, Logger, Touch, WellLog};
use crate::model::wells::spec::{TopSpec, WellSpec};
use crate::nurbs::interpolate::Parametrization;

/// A well, and what it passes through. Depths are metres.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct WellEntry {
    /// Its name; a lateral's is that of its mother, a slash and its own.
    pub name: String,
    /// The well that it leaves, if it is a lateral.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leaves: Option<String>,
    /// How its stations are joined.
    pub path: &'static str,
    /// Elevation of its depth reference above mean sea level (m).
    pub datum_m: f64,
    /// First and last measured depth (m).
    pub md_m: [f64; 2],
    /// Its ends in the model's coordinates (m).
    pub ends: [[f64; 3]; 2],
    /// The file that its survey comes from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SurveySourceEntry>,
    /// How good its survey is.
    pub survey: SurveyEntry,
    /// Where it is open to the rock, by measured depth (m).
    pub completions_m: Vec<[f64; 2]>,
    /// Its length in the domain (m).
    pub length_in_domain_m: f64,
    /// What holds it, from its head to its end.
    pub intervals: Vec<IntervalEntry>,
    /// Where it goes from one volume to another.
    pub crossings: Vec<CrossingEntry>,
    /// Where it touches a surface between volumes without passing it.
    pub touches: Vec<TouchEntry>,
    /// Where it runs along a surface, by measured depth (m): there it belongs to the youngest volume beside it.
    pub along_m: Vec<[f64; 2]>,
    /// Length in each volume that it passes through, in the order of the volumes.
    pub volumes: Vec<LengthEntry>,
    /// Length in each facies, in the order of the model file.
    pub facies: Vec<LengthEntry>,
}

/// A file that a survey comes from.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SurveySourceEntry {
    /// The file, as the model names it.
    pub file: String,
    /// The SHA-256 of what it holds.
    pub sha256: String,
    /// How it is written.
    pub format: &'static str,
    /// How many rows it has.
    pub rows: usize,
}

/// How good a survey is.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SurveyEntry {
    /// Its stations.
    pub stations: usize,
    /// Least, mean and greatest distance between them (m).
    pub spacing_m: [f64; 3],
    /// The sharpest turn between two of them (degrees for each 30 m).
    pub dogleg_deg_30m: f64,
    /// The measured depth of the lower one of these (m).
    pub dogleg_md_m: f64,
    /// All turns together over the length (degrees for each m).
    pub tortuosity_deg_m: f64,
    /// By what part the way is longer than a straight line between its ends.
    pub excess: f64,
    /// By what part the length of the path between two stations differs most from their difference in measured depth.
    pub misfit: f64,
}

/// A part of a well in one volume.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct IntervalEntry {
    /// The volume; null outside of the domain.
    pub volume: Option<String>,
    /// Its facies.
    pub facies: Option<String>,
    /// Measured depth at its upper and its lower end (m).
    pub md_m: [f64; 2],
    /// Depth below mean sea level at both (m).
    pub tvdss_m: [f64; 2],
    /// Its length along the hole (m).
    pub length_m: f64,
    /// How much of it is open to the rock (m).
    pub perforated_m: f64,
    /// Whether it is shorter than a millimetre, and so perhaps a matter of rounding.
    pub thin: bool,
}

/// A place where a well goes from one volume to another.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct CrossingEntry {
    /// Measured depth (m).
    pub md_m: f64,
    /// The place (m).
    pub at: [f64; 3],
    /// Depth below mean sea level (m).
    pub tvdss_m: f64,
    /// The volume that it leaves; null outside of the domain.
    pub from: Option<String>,
    /// The volume that it enters.
    pub to: Option<String>,
    /// The surfaces that it passes: whose they are, and what.
    pub surfaces: Vec<String>,
}

/// A place where a well touches a surface.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct TouchEntry {
    /// Measured depth (m).
    pub md_m: f64,
    /// The place (m).
    pub at: [f64; 3],
    /// The volumes that meet there.
    pub volumes: Vec<String>,
}

/// How long a well is in something.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct LengthEntry {
    /// What.
    pub name: String,
    /// Length along the hole (m).
    pub length_m: f64,
    /// How much of it is open to the rock (m).
    pub perforated_m: f64,
}

/// A horizon picked in a well, and how far the model's is from it.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct TopEntry {
    /// The well.
    pub well: String,
    /// The horizon.
    pub horizon: String,
    /// Measured depth (m).
    pub md_m: f64,
    /// The place (m).
    pub at: [f64; 3],
    /// How far the horizon lies above the top (m); null if it takes no part.
    pub misfit_m: Option<f64>,
}

/// The tops of a model, in the order of their file.
pub fn tops(model: &Model, realisation: &Realisation) -> Vec<TopEntry> {
    let entry = |top: &TopSpec| TopEntry {
        well: model.wells[top.well].name.clone(),
        horizon: model.features[top.horizon].id.clone(),
        md_m: top.md,
        at: top.point.to_array(),
        misfit_m: top.misfit(realisation).above,
    };
    model.tops.iter().map(entry).collect()
}

/// Of each horizon with tops: how many, the mean of what it lies above them, and the most that it is off (m).
pub fn tops_in_words(tops: &[TopEntry]) -> Vec<String> {
    let mut horizons: Vec<&str> = Vec::new();
    for top in tops {
        if !horizons.contains(&top.horizon.as_str()) {
            horizons.push(&top.horizon);
        }
    }
    let words = |horizon: &&str| {
        let own: Vec<&TopEntry> = tops.iter().filter(|top| top.horizon == *horizon).collect();
        let known: Vec<f64> = own.iter().filter_map(|top| top.misfit_m).collect();
        if known.is_empty() {
            return format!("{horizon} has {} tops and takes no part", own.len());
        }
        let mean = known.iter().sum::<f64>() / known.len() as f64;
        let most = known.iter().map(|misfit| misfit.abs()).fold(0.0, f64::max);
        format!(
            "{horizon} lies {mean:+.2} m above its {} tops in the mean, and is {most:.2} m off at most",
            known.len()
        )
    };
    horizons.iter().map(words).collect()
}

/// Makes entries of wells.
pub struct Wells<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its realisation.
    pub realisation: &'a Realisation,
}

impl Wells<'_> {
    /// The entries of all wells of the model.
    pub fn all(&self, logger: &Logger<'_>) -> Vec<WellEntry> {
        let wells = self.model.wells.iter();
        wells
            .map(|well| self.entry(well, &well.log(logger)))
            .collect()
    }

    /// The entry of a well, of the model's or another one.
    pub fn entry(&self, spec: &WellSpec, log: &WellLog) -> WellEntry {
        let well = &spec.well;
        let (first, last) = well.range();
        let quality = well.quality();
        let inside = log.intervals.iter().filter(|one| one.volume.is_some());
        WellEntry {
            name: spec.name.clone(),
            leaves: spec
                .mother
                .map(|mother| self.model.wells[mother].name.clone()),
            path: path_name(spec.path),
            datum_m: spec.datum,
            md_m: [first, last],
            ends: [well.point(first), well.point(last)].map(|p| p.to_array()),
            source: spec.source.as_ref().map(|source| SurveySourceEntry {
                file: source.file.clone(),
                sha256: source.sha256.clone(),
                format: source.format,
                rows: source.rows,
            }),
            survey: SurveyEntry {
                stations: well.stations().len(),
                spacing_m: quality.spacing,
                dogleg_deg_30m: quality.dogleg_deg_30m,
                dogleg_md_m: quality.dogleg_md,
                tortuosity_deg_m: quality.tortuosity_deg_m,
                excess: quality.excess,
                misfit: quality.misfit,
            },
            completions_m: spec.completions.clone(),
            length_in_domain_m: inside.map(Interval::length).sum(),
            intervals: log
                .intervals
                .iter()
                .map(|one| self.interval(spec, one))
                .collect(),
            crossings: log
                .crossings
                .iter()
                .map(|one| self.crossing(spec, one))
                .collect(),
            touches: log.touches.iter().map(|one| self.touch(one)).collect(),
            along_m: log.along.clone(),
            volumes: lengths(spec, log, |volume| volume, |volume| self.name(volume)),
            facies: lengths(
                spec,
                log,
                |volume| self.facies_index(volume),
                |facies| {
                    self.model
                        .facies
                        .get(facies)
                        .map_or_else(String::new, |facies| facies.name.clone())
                },
            ),
        }
    }

    fn name(&self, volume: usize) -> String {
        self.realisation.volumes[volume].name.clone()
    }

    fn facies_index(&self, volume: usize) -> usize {
        let own = &self.realisation.volumes[volume].facies;
        let mut all = self.model.facies.iter();
        all.position(|facies| facies.name == *own)
            .unwrap_or(usize::MAX)
    }

    fn interval(&self, spec: &WellSpec, one: &Interval) -> IntervalEntry {
        IntervalEntry {
            volume: one.volume.map(|volume| self.name(volume)),
            facies: one
                .volume
                .map(|volume| self.realisation.volumes[volume].facies.clone()),
            md_m: one.md,
            tvdss_m: one.ends.map(|point| spec.tvdss(point)),
            length_m: one.length(),
            perforated_m: spec.open(one.md),
            thin: one.is_thin(),
        }
    }

    fn crossing(&self, spec: &WellSpec, one: &Crossing) -> CrossingEntry {
        let surface = |(volume, role): &(Option<usize>, &'static str)| match volume {
            Some(volume) => format!("{} of {}", role, self.name(*volume)),
            None => (*role).to_owned(),
        };
        CrossingEntry {
            md_m: one.md,
            at: one.point.to_array(),
            tvdss_m: spec.tvdss(one.point),
            from: one.from.map(|volume| self.name(volume)),
            to: one.to.map(|volume| self.name(volume)),
            surfaces: one.surfaces.iter().map(surface).collect(),
        }
    }

    fn touch(&self, one: &Touch) -> TouchEntry {
        TouchEntry {
            md_m: one.md,
            at: one.point.to_array(),
            volumes: one
                .volumes
                .iter()
                .map(|volume| self.name(*volume))
                .collect(),
        }
    }
}

/// How long a well is in whatever volumes are counted as.
fn lengths(
    spec: &WellSpec,
    log: &WellLog,
    key: impl Fn(usize) -> usize,
    name: impl Fn(usize) -> String,
) -> Vec<LengthEntry> {
    let mut sums: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
    for one in &log.intervals {
        if let Some(volume) = one.volume {
            let sum = sums.entry(key(volume)).or_default();
            sum.0 += one.length();
            sum.1 += spec.open(one.md);
        }
    }
    let entry = |(key, (length_m, perforated_m))| LengthEntry {
        name: name(key),
        length_m,
        perforated_m,
    };
    sums.into_iter().map(entry).collect()
}

/// What a path is called in reports.
fn path_name(path: Path) -> &'static str {
    match path {
        Path::Spline(Parametrization::ChordLength) => "spline, chord-length",
        Path::Spline(Parametrization::Centripetal) => "spline, centripetal",
        Path::MinimumCurvature => "minimum-curvature",
    }
}
