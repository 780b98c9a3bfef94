//! Wells as named curves, split where they pass from one volume to another.
//!
//! Each piece is a product of its own, since few readers keep the names of curves in one: `A-1` has `A-1 1: outside`, `A-1 2: upper` …,
//! with colour and layer of their facies. Its curve is the part of the well's own NURBS curve, whole, so that nothing is left to trim; the
//! end of one is the start of the next one, bit for bit, and a lateral begins at the point where it leaves its mother.

use glam::DVec3;

use super::document::{Content, Node};
use super::far;
use super::tree::{color, description, facies_of, group, labelled};
use crate::assembly::kernel::{Boundary, BoundaryEdge};
use crate::export::text::ascii;
use crate::export::wells::entries::{IntervalEntry, WellEntry};
use crate::features::well::Well;
use crate::model::labels;
use crate::model::realisation::Realisation;
use crate::model::wells::spec::WellSpec;
use crate::model::{Facies, Model};
use crate::nurbs::Curve;

/// Pieces shorter than this (m) are points to readers.
const SHORTEST: f64 = 1e-5;

/// A node for each well, by what a report says of it, and the curves that they refer to.
pub(super) fn wires(
    model: &Model,
    realisation: &Realisation,
    wells: &[(&WellSpec, &WellEntry)],
) -> (Vec<Node>, Boundary) {
    let mut wires = Wires {
        model,
        realisation,
        labels: labels::labels(model, &realisation.volumes),
        boundary: Boundary::default(),
    };
    let nodes = wells
        .iter()
        .map(|(spec, entry)| wires.well(spec, entry))
        .collect();
    (nodes, wires.boundary)
}

/// Curves in the making.
struct Wires<'a> {
    model: &'a Model,
    realisation: &'a Realisation,
    /// What volumes are called where people read, if that is not their name.
    labels: Vec<Option<String>>,
    /// Of each curve one edge, between the vertices at its ends.
    boundary: Boundary,
}

impl Wires<'_> {
    fn well(&mut self, spec: &WellSpec, entry: &WellEntry) -> Node {
        let mut pieces = Vec::with_capacity(entry.intervals.len());
        let mut rest = spec.well.curve().clone();
        // What is too short to be an edge goes with the piece below it; at the end it is left out.
        let mut from = spec.well.range().0;
        let mut left = entry.intervals.iter().peekable();
        while let Some(one) = left.next() {
            let to = one.md_m[1];
            let is_last = left.peek().is_none();
            if to - from < SHORTEST && !(is_last && pieces.is_empty()) {
                continue;
            }
            let own = if is_last {
                rest.clone()
            } else {
                match parted(&rest, &spec.well, to) {
                    Some((own, below)) => {
                        rest = below;
                        own
                    }
                    // The end of the path.
                    None => continue,
                }
            };
            from = to;
            let curve = self.curve(&own);
            pieces.push(self.piece(spec, (pieces.len() + 1, one), curve));
        }
        let mut node = group(spec.name.clone(), pieces);
        let [first, last] = entry.md_m;
        node.description = Some(format!(
            "datum_m={}; md_m={first},{last}; path={}",
            entry.datum_m, entry.path
        ));
        node
    }

    /// A curve with an edge and its ends.
    fn curve(&mut self, own: &Curve) -> usize {
        let points = own.points();
        let (start, end) = own.domain();
        let mut vertex = |point: DVec3| {
            self.boundary.vertices.push(point.to_array());
            self.boundary.vertices.len() - 1
        };
        let ends = [vertex(points[0]), vertex(points[points.len() - 1])];
        let curve = self.boundary.curves.len();
        self.boundary.curves.push(far::path(own));
        self.boundary.edges.push(BoundaryEdge {
            curve: Some(curve),
            range: [start, end],
            start: ends[0],
            end: ends[1],
        });
        curve
    }

    fn piece(&self, spec: &WellSpec, (number, one): (usize, &IntervalEntry), curve: usize) -> Node {
        let volume = one.volume.as_deref();
        let name = format!("{} {number}: {}", spec.name, volume.unwrap_or("outside"));
        let volume = volume.and_then(|volume| self.realisation.volume(volume));
        let label = volume.and_then(|volume| self.labels[volume].as_deref());
        let label = label.map(|label| format!("{} {number}: {label}", spec.name));
        let facies = one
            .facies
            .as_deref()
            .and_then(|facies| facies_of(self.model, facies));
        let [[top, base], [upper, lower]] = [one.md_m, one.tvdss_m];
        let mut words = vec![
            format!("md_m={top},{base}"),
            format!("tvdss_m={upper},{lower}"),
            format!("perforated_m={}", one.perforated_m),
        ];
        let rock = |(facies, volume): (&Facies, usize)| {
            description(facies, &self.realisation.properties[volume])
        };
        words.extend(facies.zip(volume).map(rock));
        let node = Node {
            name,
            label: None,
            color: facies.map(color),
            layer: facies.map(|facies| ascii(&facies.name)),
            description: Some(words.join("; ")),
            content: Content::Curves(vec![curve]),
        };
        labelled(node, label.as_deref())
    }
}

/// A path, parted at a measured depth; none at its ends.
fn parted(rest: &Curve, well: &Well, md: f64) -> Option<(Curve, Curve)> {
    let u = well.parameter(md)?;
    rest.split(u).ok()
}
