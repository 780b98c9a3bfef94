//! Comparisons with the point evaluator: integrals of `owner`, points beside faces, points in solids.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::{Check, DOMAIN, ProofError, Prover};
use crate::assembly::kernel::{Classifier, FaceSample, Position, Threads, face_samples};
use crate::model::Stream;
use crate::model::rules::BACKGROUND;

/// Points beside faces: both sides of at least this many samples.
const BESIDE_FACES: usize = 250;
/// Sample points for each volume's integral of `owner`.
const PER_VOLUME: usize = 400;
/// Sample points all over the domain.
const OVERALL: usize = 4000;
/// Probability that an integral of `owner` misses a right volume by more than its bound.
const DOUBT: f64 = 1e-9;
/// How near to a face points in the tip of a wedge are asked for, in tolerances: owners are exact to rounding.
const WEDGE: f64 = 1e-2;
/// Samples of every face, so that one that happens to lie on a touching body is outvoted.
const LEAST_A_FACE: usize = 2;

/// What one point beside a face says.
struct Beside {
    face: usize,
    /// Where it belongs elsewhere, in words.
    wrong: Option<String>,
    /// Whether a body, or the domain's skin, that the face does not belong to comes this near.
    touched: bool,
}

impl Prover<'_> {
    /// Each volume agrees with an integral of `owner`, and whatever owns a sampled point has a solid.
    pub(super) fn sampled_volumes(&self) -> Vec<Check> {
        let mut boxes = vec![(BACKGROUND, self.plan.low(), self.plan.high(), OVERALL)];
        // Bodies of one volume have one box.
        let mut places: BTreeMap<usize, usize> = BTreeMap::new();
        for body in &self.plan.bodies {
            let (low, high) = self.plan.shells[body.shell].body.bounds();
            let (low, high) = (low.max(self.plan.low()), high.min(self.plan.high()));
            let whole = self.plan.rules.whole(body.volume);
            let place = *places.entry(whole).or_insert(boxes.len());
            match boxes.get_mut(place) {
                None => boxes.push((whole, low, high, PER_VOLUME)),
                Some((_, lowest, highest, count)) => {
                    *lowest = lowest.min(low);
                    *highest = highest.max(high);
                    *count += PER_VOLUME;
                }
            }
        }
        let statements = boxes.len() as f64;
        let results: Vec<(f64, f64, Vec<usize>)> = boxes
            .par_iter()
            .map(|&(volume, low, high, count)| {
                let mut seen: Vec<usize> = self
                    .points("volumes", volume, low, high)
                    .take(count)
                    .filter_map(|point| self.owners.at(point))
                    .collect();
                let hits = seen.iter().filter(|owner| **owner == volume).count();
                seen.sort_unstable();
                seen.dedup();
                let size = (high - low).element_product();
                let share = self.measured.size_of(volume) / size;
                let miss = (hits as f64 / count as f64 - share).abs();
                (miss, bernstein(share, count as f64, statements), seen)
            })
            .collect();
        let worst = results
            .iter()
            .zip(&boxes)
            .max_by(|a, b| (a.0.0 / a.0.1).total_cmp(&(b.0.0 / b.0.1)))
            .map_or((0.0, BACKGROUND), |(result, sampled)| {
                (result.0 / result.1, sampled.0)
            });
        let mut homeless: Vec<&str> = results
            .iter()
            .flat_map(|result| &result.2)
            .filter(|owner| self.measured.pieces_of(**owner).is_empty())
            .map(|owner| self.name(*owner))
            .collect();
        homeless.sort_unstable();
        homeless.dedup();
        let total: usize = boxes.iter().map(|sampled| sampled.3).sum();
        vec![
            Check {
                name: "volumes agree with the integral of the point evaluator (miss / bound)",
                measured: worst.0,
                bound: 1.0,
                detail: format!("{total} points, worst {}", self.name(worst.1)),
            },
            Check {
                name: "owners of sampled points without a solid",
                measured: homeless.len() as f64,
                bound: 0.0,
                detail: homeless.join(", "),
            },
        ]
    }

    /// Points 10 to 1000 tolerances beside faces belong to the solids on those sides.
    pub(super) fn beside_faces(&self) -> Result<Check, ProofError> {
        let tolerance = self.tolerance();
        let faces = self.solids.faces().len().max(1);
        let each = BESIDE_FACES.div_ceil(faces).max(LEAST_A_FACE);
        let samples = face_samples(self.solids, each, Threads::All)?;
        // [the face looks out of this owner's solid, it looks into this one's]
        let mut sides = vec![[None; 2]; faces];
        for solid in self.solids.solids() {
            for &(face, reversed) in &solid.faces {
                sides[face][usize::from(reversed)] = Some(solid.owner);
            }
        }
        let beside: Vec<Beside> = samples
            .par_iter()
            .enumerate()
            .flat_map_iter(|(i, sample)| {
                // A golden-section sequence spreads the distances over the two decades.
                let spread = (i as f64 * 0.618_033_988_749_895).fract();
                let reach = tolerance * 10_f64.powf(1.0 + 2.0 * spread);
                let sides = &sides[sample.face];
                [(-1.0, sides[0]), (1.0, sides[1])]
                    .map(|(sign, expected)| self.beside(sample, sign * reach, expected))
            })
            .collect();
        let mut wrong = Vec::new();
        for face in beside.chunk_by(|a, b| a.face == b.face) {
            let disagree: Vec<&Beside> = face.iter().filter(|one| one.wrong.is_some()).collect();
            // Where something else only touches the face its points say nothing; the others decide.
            let touched = disagree.iter().all(|one| one.touched);
            if !(touched && 2 * disagree.len() < face.len()) {
                wrong.extend(disagree.iter().filter_map(|one| one.wrong.clone()));
            }
        }
        Ok(Check {
            name: "points beside faces that belong elsewhere",
            measured: wrong.len() as f64,
            bound: 0.0,
            detail: detail(beside.len(), &wrong),
        })
    }

    /// Compares the owner of a point at a signed distance from a face with the solid on that side.
    fn beside(&self, sample: &FaceSample, reach: f64, expected: Option<usize>) -> Beside {
        let (point, normal) = (
            DVec3::from_array(sample.point),
            DVec3::from_array(sample.normal),
        );
        let agrees = |reach: f64| self.owners.at(point + normal * reach) == expected;
        // A face thinner than the distance has something else there: look nearer.
        let right = agrees(reach) || agrees((10.0 * self.tolerance()).copysign(reach));
        let wrong = (!right).then(|| {
            let name = expected.map_or("outside", |owner| self.name(owner));
            format!("{name} at {point:.4}")
        });
        let touched = wrong.is_some() && {
            let first_shell = 1 + self.evidence.lids;
            let origins = &self.solids.faces()[sample.face].origins;
            let of_face = |volume: usize| {
                let bodies = self.plan.bodies.iter().filter(|body| body.volume == volume);
                bodies
                    .flat_map(|body| origins.iter().map(move |origin| (body, origin)))
                    .any(|(body, origin)| origin.argument == first_shell + body.shell)
            };
            let at_skin = self.plan.extent.is_near_skin(point, reach.abs());
            at_skin && !origins.iter().any(|origin| origin.argument == DOMAIN)
                || self
                    .owners
                    .near(point, reach.abs())
                    .any(|volume| !of_face(volume))
        };
        // Where sheets end tangentially, what lies between them is thinner than any distance: beside the edge of a
        // wedge only a point at the face itself tells.
        let in_wedge = touched && agrees((WEDGE * self.tolerance()).copysign(reach));
        Beside {
            face: sample.face,
            wrong: wrong.filter(|_| !in_wedge),
            touched,
        }
    }

    /// Points of every volume lie inside that volume's solids.
    pub(super) fn within_solids(&self) -> Result<Check, ProofError> {
        let tolerance = self.tolerance();
        let volumes = 1 + self.plan.bodies.len();
        let each = self.options.proof.classified().div_ceil(volumes);
        let mut wrong = Vec::new();
        let mut count = 0;
        for volume in 0..self.plan.names.len() {
            let pieces = self.measured.pieces_of(volume);
            if pieces.is_empty() {
                continue;
            }
            let mut classifiers = Vec::with_capacity(pieces.len());
            for piece in pieces {
                classifiers.push((
                    piece.bounds,
                    Classifier::new(&self.solids.shape_of(piece.solid)?)?,
                ));
            }
            let bounds = pieces.iter().fold(
                (DVec3::INFINITY, DVec3::NEG_INFINITY),
                |(low, high), piece| (low.min(piece.bounds.0), high.max(piece.bounds.1)),
            );
            let found: Vec<DVec3> = self
                .points("solids", volume, bounds.0, bounds.1)
                .take(200 * each)
                .filter(|point| self.owners.at(*point) == Some(volume))
                .take(each)
                .collect();
            for point in found {
                count += 1;
                let mut inside = false;
                for ((low, high), classifier) in &mut classifiers {
                    let near =
                        point.cmpge(*low - tolerance).all() && point.cmple(*high + tolerance).all();
                    inside |=
                        near && classifier.contains(point.to_array(), tolerance)? != Position::Out;
                }
                if !inside {
                    wrong.push(format!("{} at {point:.4}", self.name(volume)));
                }
            }
        }
        Ok(Check {
            name: "points of a volume that are not in its solids",
            measured: wrong.len() as f64,
            bound: 0.0,
            detail: detail(count, &wrong),
        })
    }

    /// An endless sequence of points in a box.
    fn points(
        &self,
        purpose: &str,
        volume: usize,
        low: DVec3,
        high: DVec3,
    ) -> impl Iterator<Item = DVec3> {
        let mut stream = Stream::new(self.options.seed, "proof", &volume.to_string(), purpose, 0);
        std::iter::repeat_with(move || {
            let unit = DVec3::new(stream.unit(), stream.unit(), stream.unit());
            low + (high - low) * unit
        })
    }
}

fn detail(count: usize, wrong: &[String]) -> String {
    let mut words = vec![format!("{count} points")];
    words.extend(wrong.iter().take(5).cloned());
    words.join(", ")
}

/// How far the share of hits may be from the true share, by Bernstein's inequality, so that all
/// statements together are wrong with the probability [`DOUBT`].
fn bernstein(share: f64, count: f64, statements: f64) -> f64 {
    let doubt = (2.0 * statements / DOUBT).ln();
    let third = doubt / (3.0 * count);
    let share = share.clamp(0.0, 1.0);
    third + (third * third + 2.0 * share * (1.0 - share) * doubt / count).sqrt()
}
