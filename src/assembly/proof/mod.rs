//! The proof that an assembly is right, made in every run.
//!
//! None of it trusts the kernel's own word: volumes are integrals, sides are topology, owners are the
//! point evaluator's. A general fuse can lose nine tenths of a model with every solid valid; the volume
//! sum, the faces without a neighbour and the owners all find it.

mod closed;
#[cfg(test)]
mod damage;
#[cfg(test)]
mod damage_tests;
mod extrema;
mod lines;
mod samples;
mod scene;
mod spline;
mod tree;

use glam::DVec3;

use super::kernel::{BridgeError, Cancel, DOMAIN, Solids, Threads, defects};
use super::measure::Measured;
pub use super::options::Level;
use super::options::Options;
use crate::model::owner::Owners;
use crate::model::plan::AssemblyPlan;
use crate::partition::Topology;
use scene::Scene;

/// The model's tolerance, as a share of the domain's diagonal: ten times what curves are followed to.
const TOLERANCE: f64 = 1e-10;
/// Mean distance by which the skin may be off in the sum of volumes, as a share of the domain's diagonal. Far below
/// [`TOLERANCE`]: inner faces cancel, so only the ends of fitted curves on the skin count (measured: up to 2e-9 m in a
/// domain of a kilometre), and a lost sliver of 0.05 m³ in a belt of 1000 m × 1000 m × 60 m must show.
const SUM_TOLERANCE: f64 = 3e-12;
/// Roundings of the farthest coordinate, by which planes are off too.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;
/// How near to an edge a line says nothing, as a share of the domain's diagonal: what edges may be off.
const NEAR: f64 = 1e-9;
/// Relative error of the kernel's integrals.
const KERNEL_VOLUME: f64 = 1e-6;
/// One statement of the proof.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Check {
    /// What is checked.
    pub name: &'static str,
    /// What was found.
    pub measured: f64,
    /// The most that is allowed.
    pub bound: f64,
    /// In words: over what, and what failed.
    pub detail: String,
}

impl Check {
    /// Whether the statement holds; what is not a number does not.
    pub fn holds(&self) -> bool {
        self.measured <= self.bound
    }
}

/// All statements.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Proof {
    /// The statements, in the order of their making.
    pub checks: Vec<Check>,
}

impl Proof {
    /// Whether every statement holds.
    pub fn holds(&self) -> bool {
        self.checks.iter().all(Check::holds)
    }

    /// The statements that do not hold, in words.
    pub fn failures(&self) -> String {
        let failed = self.checks.iter().filter(|check| !check.holds());
        let words = |check: &Check| {
            format!(
                "{}: {:.6e} is above {:.6e} ({})",
                check.name, check.measured, check.bound, check.detail
            )
        };
        failed.map(words).collect::<Vec<_>>().join("; ")
    }
}

/// Why the proof could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ProofError {
    /// Stopped on request.
    #[error("stopped on request")]
    Cancelled,
    /// The kernel failed.
    #[error("the proof could not be made: {0}")]
    Kernel(String),
}

impl From<BridgeError> for ProofError {
    fn from(error: BridgeError) -> Self {
        Self::Kernel(error.to_string())
    }
}

/// What an engine knows of its own result.
pub(super) struct Evidence {
    /// Lids among the arguments.
    pub(super) lids: usize,
    /// The tables that the kernel and the files are given, if the engine has them.
    pub(super) topology: Option<Topology>,
    /// What the engine states itself.
    pub(super) checks: Vec<Check>,
}

impl Evidence {
    /// Of an engine that knows nothing: the kernel is asked.
    pub(super) fn of_kernel(lids: usize) -> Self {
        Self {
            lids,
            topology: None,
            checks: Vec::new(),
        }
    }
}

/// A group of statements, to be made.
type Step<'a> = Box<dyn Fn() -> Result<Vec<Check>, ProofError> + 'a>;

/// Makes the proof.
pub(super) struct Prover<'a> {
    pub(super) solids: &'a Solids,
    pub(super) measured: &'a Measured,
    pub(super) evidence: &'a Evidence,
    pub(super) plan: &'a AssemblyPlan,
    pub(super) owners: &'a Owners,
    pub(super) options: &'a Options,
}

impl Prover<'_> {
    /// All groups of statements, the cheap ones first.
    fn steps(&self) -> Vec<Step<'_>> {
        let mut steps: Vec<Step<'_>> = vec![
            Box::new(|| Ok(self.evidence.checks.clone())),
            Box::new(|| {
                Ok(vec![
                    self.volume_sum(),
                    self.positive_volumes(),
                    self.outer_area(),
                ])
            }),
            Box::new(|| Ok(vec![self.sharing()])),
        ];
        let topology = self.evidence.topology.as_ref();
        if let Some(topology) = topology {
            steps.push(Box::new(|| {
                Ok(vec![self.closure(topology), self.deviation(topology)])
            }));
            steps.push(Box::new(|| {
                let scene = self.scene(topology);
                let mut checks = vec![self.nesting(&scene)];
                checks.extend(self.lines(&scene)?);
                Ok(checks)
            }));
        }
        steps.push(Box::new(|| Ok(self.sampled_volumes())));
        // Lines through every face have asked what lies beside it.
        if topology.is_none() {
            steps.push(Box::new(|| Ok(vec![self.beside_faces()?])));
        }
        // What an engine of ours has made is judged by its tables; of a fuse's result the kernel is asked.
        let is_ours = topology.is_some();
        if !is_ours || self.options.proof == Level::Full {
            steps.push(Box::new(|| Ok(vec![self.validity()?])));
            steps.push(Box::new(|| Ok(vec![self.within_solids()?])));
        }
        if is_ours && self.options.proof == Level::Full {
            steps.push(Box::new(|| Ok(vec![self.kernel_volumes()?])));
        }
        steps
    }

    /// All statements, up to the first group that does not hold.
    pub(super) fn prove(
        &self,
        cancel: &Cancel,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Proof, ProofError> {
        let steps = self.steps();
        let mut checks = Vec::new();
        for (i, step) in steps.iter().enumerate() {
            if cancel.is_cancelled() {
                return Err(ProofError::Cancelled);
            }
            progress(i as f64 / steps.len() as f64);
            let made = step()?;
            let broken = made.iter().any(|check| !check.holds());
            checks.extend(made);
            if broken {
                break;
            }
        }
        progress(1.0);
        Ok(Proof { checks })
    }

    fn name(&self, volume: usize) -> &str {
        &self.plan.names[volume]
    }

    /// The model's tolerance (m); where the kernel has made the solids not below its own.
    fn tolerance(&self) -> f64 {
        let (low, high) = (self.plan.low(), self.plan.high());
        let farthest = low.abs().max(high.abs()).max_element();
        let own = TOLERANCE * (high - low).length() + ROUNDINGS * farthest;
        if self.evidence.topology.is_some() {
            own
        } else {
            own.max(super::splines::EXACT)
        }
    }

    /// Finished topology, to be followed by lines.
    fn scene<'b>(&self, topology: &'b Topology) -> Scene<'b> {
        let (low, high) = (self.plan.low(), self.plan.high());
        let farthest = low.abs().max(high.abs()).max_element();
        let near = NEAR * (high - low).length() + ROUNDINGS * farthest;
        Scene::new(topology, near)
    }

    /// Mean distance by which the skin may be off in the sum of volumes (m).
    fn off(&self) -> f64 {
        let (low, high) = (self.plan.low(), self.plan.high());
        let farthest = low.abs().max(high.abs()).max_element();
        SUM_TOLERANCE * (high - low).length() + ROUNDINGS * farthest
    }

    /// Volumes sum to the domain's.
    fn volume_sum(&self) -> Check {
        let domain = self.plan.extent.volume();
        let sum: f64 = self.measured.pieces.iter().map(|piece| piece.size).sum();
        Check {
            name: "volumes sum to the domain's (m³)",
            measured: (sum - domain).abs(),
            bound: 2.0 * self.off() * self.measured.area + self.measured.volume_error,
            detail: format!("{} solids", self.measured.pieces.len()),
        }
    }

    /// No solid is inside out or empty.
    fn positive_volumes(&self) -> Check {
        let wrong: Vec<_> = self
            .measured
            .pieces
            .iter()
            .filter(|piece| !(piece.size > 0.0))
            .collect();
        let names: Vec<_> = wrong.iter().map(|piece| self.name(piece.volume)).collect();
        Check {
            name: "solids without a positive volume",
            measured: wrong.len() as f64,
            bound: 0.0,
            detail: names.join(", "),
        }
    }

    /// The faces that bound one solid are the domain's skin.
    fn outer_area(&self) -> Check {
        let skin = self.plan.extent.skin();
        let sum: f64 = self.measured.outer.values().sum();
        Check {
            name: "outer faces cover the domain's skin (m²)",
            measured: (sum - skin).abs(),
            bound: 1e-8 * skin + self.measured.outer_error + self.plan.extent.skin_error(),
            detail: format!("{skin} m²"),
        }
    }

    /// Every face inside the domain has a solid on each side; every other lies on the domain's skin.
    fn sharing(&self) -> Check {
        let mut wrong = Vec::new();
        let mut sides = vec![[0_u32; 2]; self.solids.faces().len()];
        for solid in self.solids.solids() {
            for &(face, reversed) in &solid.faces {
                sides[face][usize::from(reversed)] += 1;
            }
        }
        for (face, sides) in self.solids.faces().iter().zip(&sides) {
            let skin = face.origins.iter().any(|origin| origin.argument == DOMAIN);
            let right = match sides {
                [1, 1] => !skin,
                [1, 0] | [0, 1] => skin,
                _ => false,
            };
            if !right {
                let owners = face
                    .solids
                    .iter()
                    .map(|solid| self.name(self.solids.solids()[*solid].owner));
                wrong.push(owners.collect::<Vec<_>>().join("/"));
            }
        }
        let count = wrong.len();
        wrong.truncate(8);
        Check {
            name: "faces that are not shared by exactly two solids",
            measured: count as f64,
            bound: 0.0,
            detail: if wrong.is_empty() {
                format!("{} faces", sides.len())
            } else {
                format!("of {}", wrong.join(", "))
            },
        }
    }

    /// The kernel's integrals give the same volumes.
    fn kernel_volumes(&self) -> Result<Check, ProofError> {
        let tolerance = self.tolerance();
        let measured = Measured::of_solids(self.solids, self.plan)?;
        let of_solid = |of: &Measured| {
            // Thin pieces have much area for their volume: that of their box is a fair measure of it.
            let area = |(low, high): (DVec3, DVec3)| {
                let size = high - low;
                2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
            };
            let mut sizes: Vec<(usize, usize, f64, f64)> = of
                .pieces
                .iter()
                .map(|piece| (piece.solid, piece.volume, piece.size, area(piece.bounds)))
                .collect();
            sizes.sort_by_key(|size| size.0);
            sizes
        };
        let (ours, theirs) = (of_solid(self.measured), of_solid(&measured));
        let worst = ours
            .iter()
            .zip(&theirs)
            .map(|(a, b)| {
                let bound = KERNEL_VOLUME * a.2.abs() + 10.0 * tolerance * a.3;
                ((a.2 - b.2).abs() / bound, a.1, a.2, b.2)
            })
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, 0, 0.0, 0.0));
        Ok(Check {
            name: "volumes agree with the kernel's integrals (miss / bound)",
            measured: if ours.len() == theirs.len() {
                worst.0
            } else {
                f64::INFINITY
            },
            bound: 1.0,
            detail: format!(
                "{} solids, worst {}: {} m³ here, {} m³ there",
                ours.len(),
                self.name(worst.1),
                worst.2,
                worst.3
            ),
        })
    }

    /// The kernel's checker finds nothing.
    fn validity(&self) -> Result<Check, ProofError> {
        let found = defects(self.solids, Threads::All)?;
        let words: Vec<String> = found
            .iter()
            .take(8)
            .map(|defect| {
                let owner = defect
                    .solid
                    .map_or("?", |s| self.name(self.solids.solids()[s].owner));
                format!("{owner}: {}", defect.what)
            })
            .collect();
        Ok(Check {
            name: "invalid solids",
            measured: found.len() as f64,
            bound: 0.0,
            detail: words.join("; "),
        })
    }
}
