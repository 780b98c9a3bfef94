//! The entities of a file, and what must hold between them in any file.

use std::collections::{BTreeMap, BTreeSet};

/// Entities by number.
pub(crate) struct Entities(pub(crate) BTreeMap<usize, String>);

/// References of an entity, in order.
pub(crate) fn references(body: &str) -> Vec<usize> {
    body.split('#')
        .skip(1)
        .map(|rest| {
            let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap();
            rest[..digits].parse().unwrap()
        })
        .collect()
}

/// Numbers of a coordinate list.
pub(crate) fn reals(body: &str) -> Vec<f64> {
    let inner = &body[body.rfind('(').unwrap() + 1..];
    inner[..inner.find(')').unwrap()]
        .split(',')
        .map(|number| {
            let known = |c: char| c.is_ascii_digit() || ".E-".contains(c);
            assert!(
                number.contains('.') && number.chars().all(known),
                "{number}"
            );
            number.parse().unwrap()
        })
        .collect()
}

impl Entities {
    pub(crate) fn of(text: &str) -> Self {
        let data = text.split_once("DATA;\n").unwrap().1;
        let data = data.split_once("ENDSEC;\nEND-ISO-10303-21;\n").unwrap();
        assert_eq!(data.1, "");
        let entities = data.0.split_terminator(";\n").map(|entity| {
            let (number, body) = entity.strip_prefix('#').unwrap().split_once('=').unwrap();
            (number.parse().unwrap(), body.replace('\n', ""))
        });
        Self(entities.collect())
    }

    pub(crate) fn named(&self, name: &str) -> Vec<usize> {
        let start = format!("{name}(");
        let found = self.0.iter().filter(|(_, body)| body.starts_with(&start));
        found.map(|(number, _)| *number).collect()
    }

    pub(crate) fn count(&self, name: &str) -> usize {
        self.named(name).len()
    }

    pub(crate) fn body(&self, number: usize) -> &str {
        &self.0[&number]
    }

    pub(crate) fn below(&self, number: usize) -> Vec<usize> {
        references(self.body(number))
    }

    /// An entity with everything it refers to written in its place.
    pub(crate) fn expanded(&self, number: usize) -> String {
        let body = self.body(number);
        let mut out = String::new();
        for (i, piece) in body.split('#').enumerate() {
            if i == 0 {
                out.push_str(piece);
                continue;
            }
            let digits = piece.find(|c: char| !c.is_ascii_digit()).unwrap();
            out.push_str(&self.expanded(piece[..digits].parse().unwrap()));
            out.push_str(&piece[digits..]);
        }
        out
    }

    /// Surface and loops of a face.
    pub(crate) fn face(&self, face: usize) -> (usize, Vec<usize>) {
        let mut bounds = self.below(face);
        let surface = bounds.pop().unwrap();
        let loops = bounds.iter().map(|bound| self.below(*bound)[0]);
        (surface, loops.collect())
    }

    /// Start, end and curve of the edge of an oriented edge, and whether that runs along it.
    pub(crate) fn edge(&self, oriented: usize) -> ([usize; 2], usize, bool) {
        let edge = self.below(oriented)[0];
        let [start, end, curve] = self.below(edge)[..] else {
            panic!("{}", self.body(edge))
        };
        let along = self.body(oriented).ends_with(".T.)");
        (
            if along { [start, end] } else { [end, start] },
            curve,
            along,
        )
    }

    /// Everything that must hold in any file of ours.
    pub(crate) fn check(&self) {
        self.check_references();
        for face in self.named("ADVANCED_FACE") {
            self.check_face(face);
        }
        for shell in self.named("CLOSED_SHELL") {
            self.check_closed(shell);
        }
        for part in self.named("STYLED_ITEM") {
            let item = *self.below(part).last().unwrap();
            let name = self.body(item).split('(').next().unwrap();
            assert!(
                [
                    "MANIFOLD_SOLID_BREP",
                    "BREP_WITH_VOIDS",
                    "ADVANCED_FACE",
                    "GEOMETRIC_CURVE_SET"
                ]
                .contains(&name)
            );
        }
    }

    /// Numbers count from 1; nothing refers to what is not there, or to itself; what is not referred to is a root.
    fn check_references(&self) {
        assert!(self.0.keys().copied().eq(1..=self.0.len()));
        let mut used = BTreeSet::new();
        for (number, body) in &self.0 {
            for other in references(body) {
                assert!(
                    self.0.contains_key(&other) && other < *number,
                    "{number}={body}"
                );
                used.insert(other);
            }
        }
        let roots: BTreeSet<&str> = self
            .0
            .iter()
            .filter(|(number, _)| !used.contains(number))
            .map(|(_, body)| body.split('(').next().unwrap())
            .collect();
        let known = BTreeSet::from([
            "APPLICATION_PROTOCOL_DEFINITION",
            "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION",
            "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION",
            "PRESENTATION_LAYER_ASSIGNMENT",
            "PRODUCT_RELATED_PRODUCT_CATEGORY",
            "SHAPE_DEFINITION_REPRESENTATION",
        ]);
        assert!(roots.is_subset(&known), "nobody refers to {roots:?}");
    }

    /// Loops close; each edge has a curve on the face's surface, both if it is a seam; on planes it is where the edge is.
    fn check_face(&self, face: usize) {
        let (surface, loops) = self.face(face);
        let along = self.body(face).ends_with(".T.)");
        for bound in self.below(face).split_last().unwrap().1 {
            assert_eq!(self.body(*bound).ends_with(".T.)"), along, "{face}");
        }
        for edges in loops {
            if self.body(edges).starts_with("VERTEX_LOOP(") {
                continue;
            }
            let edges = self.below(edges);
            for (i, oriented) in edges.iter().enumerate() {
                let (ends, curve, _) = self.edge(*oriented);
                let next = self.edge(edges[(i + 1) % edges.len()]).0;
                assert_eq!(ends[1], next[0], "the loops of #{face} do not close");
                let sides = self.below(curve);
                let on: Vec<usize> = sides[1..]
                    .iter()
                    .copied()
                    .filter(|pcurve| self.below(*pcurve)[0] == surface)
                    .collect();
                assert!(sides.len() <= 3);
                let seam = self.body(curve).starts_with("SEAM_CURVE(");
                let of_shared = self.count("NON_MANIFOLD_SURFACE_SHAPE_REPRESENTATION") > 0;
                if !of_shared {
                    assert_eq!(on.len(), if seam { 2 } else { 1 }, "#{face}, #{oriented}");
                }
                if self.body(surface).starts_with("PLANE(") {
                    for pcurve in on {
                        self.check_flat(surface, sides[0], pcurve);
                    }
                }
            }
        }
    }

    fn check_flat(&self, plane: usize, curve: usize, pcurve: usize) {
        let placement = self.below(plane)[0];
        let axes = self.below(placement);
        let axes: Vec<Vec<f64>> = axes.iter().map(|at| reals(self.body(*at))).collect();
        let [origin, z, x] = &axes[..] else {
            panic!("{placement}")
        };
        let y = [
            z[1] * x[2] - z[2] * x[1],
            z[2] * x[0] - z[0] * x[2],
            z[0] * x[1] - z[1] * x[0],
        ];
        let flat = self.below(self.below(pcurve)[1])[0];
        assert_eq!(
            self.body(flat).split('(').next(),
            self.body(curve).split('(').next()
        );
        // A line's direction is no place, but its point is.
        let points = |curve: usize| -> Vec<Vec<f64>> {
            let below = self.below(curve).into_iter();
            let points = below.filter(|at| self.body(*at).starts_with("CARTESIAN_POINT("));
            points.map(|at| reals(self.body(at))).collect()
        };
        for (uv, p) in points(flat).iter().zip(points(curve)) {
            for i in 0..3 {
                let back = origin[i] + uv[0] * x[i] + uv[1] * y[i];
                assert!((back - p[i]).abs() < 1e-6, "{uv:?} is not {p:?}");
            }
        }
    }

    /// A closed shell runs along each edge once in each direction.
    fn check_closed(&self, shell: usize) {
        let mut uses: BTreeMap<usize, Vec<bool>> = BTreeMap::new();
        for face in self.below(shell) {
            let same = self.body(face).ends_with(".T.)");
            for edges in self.face(face).1 {
                if self.body(edges).starts_with("VERTEX_LOOP(") {
                    continue;
                }
                for oriented in self.below(edges) {
                    let along = self.edge(oriented).2;
                    let edge = self.below(oriented)[0];
                    uses.entry(edge).or_default().push(along == same);
                }
            }
        }
        for (edge, uses) in uses {
            assert_eq!(uses.len(), 2, "#{edge} in #{shell}");
            assert_ne!(uses[0], uses[1], "#{edge} in #{shell}");
        }
    }
}
