//! What holds for every partition, checked by means of its own: inside tests of shells, curves as the nurbs
//! module evaluates them, and counting.

use std::collections::BTreeMap;

use clinothem::nurbs::enclosure::Enclosure;
use clinothem::nurbs::{Curve, KnotVector};
use clinothem::partition::{
    CurveShape, Face, Label, Options, Partition, PlaneCurve, Region, Topology, partition,
};
use glam::{DVec2, DVec3};

/// The youngest region that holds a place has it.
pub fn youngest(holds: &[bool]) -> Label {
    if holds[0] {
        Some(
            holds
                .iter()
                .skip(1)
                .rposition(|held| *held)
                .map_or(0, |at| at + 1),
        )
    } else {
        None
    }
}

/// Every combination of regions is a volume of its own: the sum of 2^index.
pub fn combinations(holds: &[bool]) -> Label {
    let bit = |(at, held): (usize, &bool)| if *held { 1 << at } else { 0 };
    holds[0].then(|| holds.iter().enumerate().skip(1).map(bit).sum())
}

/// A rule.
pub type Rule = fn(&[bool]) -> Label;

/// A partition that has passed the audit.
pub fn sound(regions: &[Region], rule: Rule) -> Partition {
    let made = partition(regions.to_vec(), &rule, &Options::default()).unwrap();
    assert!(made.faults.is_none(), "faults: {}", made.faults);
    audit(regions, rule, &made);
    made
}

/// The size of everything with a label.
pub fn size(made: &Partition, label: usize) -> f64 {
    made.topology
        .solids
        .iter()
        .filter(|solid| solid.label == label)
        .map(|solid| solid.size)
        .sum()
}

/// Everything that holds for every partition.
pub fn audit(regions: &[Region], rule: Rule, made: &Partition) {
    let Region::Block { low, high } = regions[0] else {
        panic!("the first region is the block")
    };
    let (topology, scale) = (&made.topology, (high - low).length());
    sizes_fill_the_block(topology, high - low);
    faces_are_used_by_what_lies_beside_them(topology);
    loops_are_closed(topology);
    shells_are_closed(topology);
    samples_agree_with_the_rule(topology, regions, rule, scale);
    curves_lie_on_their_surfaces(topology, scale);
    ends_are_at_vertices(topology, scale);
}

fn sizes_fill_the_block(topology: &Topology, sides: DVec3) {
    let all = sides.element_product();
    let sum: f64 = topology.solids.iter().map(|solid| solid.size).sum();
    assert!((sum - all).abs() < 1e-12 * all, "{sum} m³ of {all}");
    assert!(topology.solids.iter().all(|solid| solid.size > 0.0));
}

fn faces_are_used_by_what_lies_beside_them(topology: &Topology) {
    let mut uses: Vec<[usize; 2]> = vec![[0; 2]; topology.faces.len()];
    for solid in &topology.solids {
        for (face, reversed) in solid.shells.iter().flatten() {
            uses[*face][usize::from(*reversed)] += 1;
            // Not reversed, the solid lies behind the face.
            let own = topology.faces[*face].labels[usize::from(*reversed)];
            assert_eq!(own, Some(solid.label), "face {face}");
        }
    }
    for (at, (face, uses)) in topology.faces.iter().zip(uses).enumerate() {
        let wanted = face.labels.map(|label| usize::from(label.is_some()));
        assert_eq!(uses, wanted, "face {at} between {:?}", face.labels);
        assert_ne!(face.labels[0], face.labels[1], "face {at} bounds nothing");
    }
}

fn loops_are_closed(topology: &Topology) {
    for (at, own) in topology
        .faces
        .iter()
        .enumerate()
        .flat_map(|(at, face)| face.loops.iter().map(move |own| (at, own)))
    {
        let ends = |(edge, backward): (usize, bool)| {
            let [a, b] = topology.edges[edge].ends;
            if backward { [b, a] } else { [a, b] }
        };
        assert!(!own.is_empty(), "face {at} has an empty loop");
        for k in 0..own.len() {
            let next = own[(k + 1) % own.len()];
            assert_eq!(
                ends(own[k])[1],
                ends(next)[0],
                "a loop of face {at} is open"
            );
        }
    }
}

/// Seams too are used once in each direction, by one face; a pole only once.
fn shells_are_closed(topology: &Topology) {
    for shell in topology.solids.iter().flat_map(|solid| &solid.shells) {
        let mut uses: BTreeMap<usize, [usize; 2]> = BTreeMap::new();
        for (face, reversed) in shell {
            for (edge, backward) in topology.faces[*face].loops.iter().flatten() {
                uses.entry(*edge).or_default()[usize::from(backward ^ reversed)] += 1;
            }
        }
        for (edge, uses) in uses {
            if topology.edges[edge].curve.is_none() {
                assert_eq!(uses[0] + uses[1], 1, "pole {edge}");
            } else {
                assert_eq!(uses, [1, 1], "edge {edge}");
            }
        }
    }
}

/// A region's inside, asked of the shell as such.
enum Inside {
    Shell(Box<Enclosure>),
    Block(DVec3, DVec3),
    Above(f64),
    Side(std::sync::Arc<dyn clinothem::partition::Membership>),
}

impl Inside {
    fn new(region: &Region) -> Self {
        match region {
            Region::Shell(body) => Self::Shell(Box::new(Enclosure::new(body.clone()).unwrap())),
            Region::Block { low, high } => Self::Block(*low, *high),
            Region::PartOf { surfaces, .. } => {
                Self::Shell(Box::new(Enclosure::new(surfaces.clone()).unwrap()))
            }
            Region::Above(level) => Self::Above(*level),
            Region::Side { inside, .. } => Self::Side(inside.clone()),
        }
    }

    fn holds(&self, p: DVec3) -> bool {
        match self {
            Self::Shell(shell) => shell.contains(p),
            Self::Block(low, high) => p.cmpgt(*low).all() && p.cmplt(*high).all(),
            Self::Above(level) => p.z > *level,
            Self::Side(side) => side.holds(p),
        }
    }
}

fn samples_agree_with_the_rule(topology: &Topology, regions: &[Region], rule: Rule, scale: f64) {
    let insides: Vec<Inside> = regions.iter().map(Inside::new).collect();
    let label = |p: DVec3| {
        rule(
            &insides
                .iter()
                .map(|inside| inside.holds(p))
                .collect::<Vec<_>>(),
        )
    };
    // Far above the precision of inside tests, far below the size of what is tested.
    let beside = 1e-7 * scale;
    for (at, face) in topology.faces.iter().enumerate() {
        let samples = samples(topology, face);
        assert!(!samples.is_empty(), "face {at} has no sample");
        for (point, normal) in samples {
            let around = |beside: f64| [-beside, beside].map(|d| label(point + d * normal));
            // What is thinner than the distance is looked at from nearer: beside a place where landings cross it is thin.
            let is_seen = |nearer: f64| around(nearer * beside) == face.labels;
            if ![1e-2, 1e-4, 1e-6].into_iter().any(is_seen) {
                assert_eq!(around(beside), face.labels, "face {at} at {point}");
            }
        }
    }
}

/// Points inside a face with its normals there: in the middle of the widest gaps between its loops at some heights.
fn samples(topology: &Topology, face: &Face) -> Vec<(DVec3, DVec3)> {
    let sheet = &topology.sheets[face.sheet];
    let polygons: Vec<Vec<DVec2>> = face
        .loops
        .iter()
        .map(|own| polygon(topology, face, own))
        .collect();
    let range = polygons[0]
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            [low.min(p.y), high.max(p.y)]
        });
    let sample = |k: i32| {
        let y = range[0] + (f64::from(k) * 0.618_033_988_749_895).fract() * (range[1] - range[0]);
        let mut crossings = Vec::new();
        for polygon in &polygons {
            for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
                if (a.y > y) != (b.y > y) {
                    crossings.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                }
            }
        }
        crossings.sort_by(f64::total_cmp);
        let gaps = crossings.chunks_exact(2);
        let gap = gaps.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
        let x = f64::midpoint(gap[0], gap[1]);
        match sheet.plane {
            Some([origin, normal, along]) => {
                Some((origin + along * x + normal.cross(along) * y, normal))
            }
            None => Some((sheet.surface.point(x, y), sheet.surface.normal(x, y)?)),
        }
    };
    (1..=6).filter_map(sample).collect()
}

/// A loop as a fine polygon in the parameters of its surface, or in the directions of its plane.
fn polygon(topology: &Topology, face: &Face, own: &[(usize, bool)]) -> Vec<DVec2> {
    let mut points = Vec::new();
    for &(edge, backwards) in own {
        let edge = &topology.edges[edge];
        let plane = topology.sheets[face.sheet].plane;
        let at: Box<dyn Fn(f64) -> DVec2> = if let Some([origin, normal, along]) = plane {
            let curve = space_curve(&topology.curves[edge.curve.unwrap()]);
            Box::new(move |t| {
                let p = curve.point(t) - origin;
                DVec2::new(p.dot(along), p.dot(normal.cross(along)))
            })
        } else {
            let on = edge.on.iter().find(|on| on.sheet == face.sheet).unwrap();
            let image = match on.reversed {
                Some(image) if backwards => image,
                _ => on.forward,
            };
            plane_curve(&topology.plane_curves[image])
        };
        let [from, to] = if backwards {
            [edge.range[1], edge.range[0]]
        } else {
            edge.range
        };
        points.extend((0..128).map(|k| at(from + (to - from) * f64::from(k) / 128.0)));
    }
    points
}

/// A curve of the topology, as the nurbs module knows it.
pub fn space_curve(shape: &CurveShape) -> Curve {
    match shape {
        CurveShape::Known(curve) => curve.clone(),
        CurveShape::Computed { knots, points } => {
            Curve::new(KnotVector::new(5, knots.clone()).unwrap(), points.clone()).unwrap()
        }
    }
}

fn plane_curve(shape: &PlaneCurve) -> Box<dyn Fn(f64) -> DVec2> {
    match shape.clone() {
        PlaneCurve::Line { origin, direction } => Box::new(move |t| origin + t * direction),
        PlaneCurve::Computed { knots, points } => {
            let points = points.iter().map(|p| p.extend(0.0)).collect();
            let curve = Curve::new(KnotVector::new(5, knots).unwrap(), points).unwrap();
            Box::new(move |t| curve.point(t).truncate())
        }
    }
}

/// Measured again, at other places: the stated deviation is no smaller.
fn curves_lie_on_their_surfaces(topology: &Topology, scale: f64) {
    // Rounding of coordinates of this size, in sums of some terms.
    let rounding = 1e-14 * scale;
    let curves: Vec<Curve> = topology.curves.iter().map(space_curve).collect();
    let images: Vec<_> = topology.plane_curves.iter().map(plane_curve).collect();
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); topology.edges.len()];
    for face in &topology.faces {
        for (edge, _) in face.loops.iter().flatten() {
            beside[*edge].push(face.sheet);
        }
    }
    for (at, edge) in topology.edges.iter().enumerate() {
        let Some(curve) = edge.curve else { continue };
        let [from, to] = edge.range;
        assert!(
            edge.deviation < 3e-11 * scale,
            "edge {at} deviates by {}",
            edge.deviation
        );
        for k in 0..=500 {
            let t = from + (to - from) * f64::from(k) / 500.0;
            let p = curves[curve].point(t);
            let most = 1.5 * edge.deviation + rounding;
            for on in &edge.on {
                let surface = &topology.sheets[on.sheet].surface;
                for image in std::iter::once(on.forward).chain(on.reversed) {
                    let q = images[image](t);
                    let gap = surface.point(q.x, q.y).distance(p);
                    assert!(gap <= most, "edge {at} at {t}: {gap} against {most}");
                }
            }
            for sheet in &beside[at] {
                match topology.sheets[*sheet].plane {
                    Some([origin, normal, _]) => {
                        let gap = (p - origin).dot(normal).abs();
                        assert!(gap <= most, "edge {at} at {t}: {gap} against {most}");
                    }
                    None => assert!(edge.on.iter().any(|on| on.sheet == *sheet)),
                }
            }
        }
    }
}

fn ends_are_at_vertices(topology: &Topology, scale: f64) {
    for edge in &topology.edges {
        let Some(curve) = edge.curve else { continue };
        let curve = space_curve(&topology.curves[curve]);
        for (t, end) in edge.range.iter().zip(edge.ends) {
            let vertex = topology.vertices[end];
            assert!(vertex.gap < 1e-9 * scale);
            let gap = curve.point(*t).distance(vertex.point);
            assert!(
                gap <= vertex.gap + 1e-14 * scale,
                "{gap} against {}",
                vertex.gap
            );
        }
    }
}
