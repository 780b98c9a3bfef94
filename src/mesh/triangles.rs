//! Triangles of faces that share their points by index, and whether those of some faces close.

use std::collections::HashMap;

use glam::DVec3;

/// Triangles of faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// All points (m): vertices first, then those on edges, then those inside of faces.
    pub points: Vec<DVec3>,
    /// By face, in the order of the tables.
    pub faces: Vec<FaceMesh>,
}

/// Triangles of a face, counter-clockwise seen against its surface's normal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceMesh {
    /// Corners: a point may have two, on both sides of a seam.
    pub corners: Vec<Corner>,
    /// Three corners each.
    pub triangles: Vec<[usize; 3]>,
}

/// A corner of a face's triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Its point.
    pub point: usize,
    /// Where it is in the surface's parameters.
    pub uv: [f64; 2],
    /// The unit normal of the exact surface there.
    pub normal: DVec3,
}

/// A face, and whether it is used against its surface's normal.
pub type Used = (usize, bool);

/// Why triangles do not close.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "of the triangles at the side from {from} to {to} {along} run one way and {back} the other"
)]
pub struct Open {
    /// The place of one end.
    pub from: DVec3,
    /// The place of the other end.
    pub to: DVec3,
    /// How many run from there to here.
    pub along: usize,
    /// How many run back.
    pub back: usize,
}

/// What triangles that close consist of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Points that are used.
    pub points: usize,
    /// Sides.
    pub sides: usize,
    /// Triangles.
    pub triangles: usize,
    /// Sides at which more than two triangles meet: the body touches itself there.
    pub touching: usize,
}

impl Counts {
    /// Points − sides + triangles: 2 for a ball, 0 for a ring.
    pub fn euler(&self) -> i64 {
        let number = |count: usize| i64::try_from(count).unwrap_or(i64::MAX);
        number(self.points) - number(self.sides) + number(self.triangles)
    }
}

impl Mesh {
    /// Triangles of some faces by points, the way the faces are used.
    pub fn triangles<'a>(&'a self, faces: &'a [Used]) -> impl Iterator<Item = [usize; 3]> + 'a {
        faces.iter().flat_map(move |(face, reversed)| {
            let face = &self.faces[*face];
            face.triangles.iter().map(move |corners| {
                let [a, b, c] = corners.map(|corner| face.corners[corner].point);
                if *reversed { [a, c, b] } else { [a, b, c] }
            })
        })
    }

    /// Checks that the triangles of some faces close: at every side as many run one way as the other.
    pub fn closed(&self, faces: &[Used]) -> Result<Counts, Open> {
        let mut sides: HashMap<(usize, usize), [usize; 2]> = HashMap::new();
        let mut points = Vec::new();
        let mut triangles = 0;
        for [a, b, c] in self.triangles(faces) {
            triangles += 1;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let counts = sides.entry((from.min(to), from.max(to))).or_default();
                counts[usize::from(from > to)] += 1;
                points.push(from);
            }
        }
        points.sort_unstable();
        points.dedup();
        let mut all: Vec<_> = sides.into_iter().collect();
        all.sort_unstable();
        if let Some(((from, to), [along, back])) =
            all.iter().find(|(_, [along, back])| along != back)
        {
            return Err(Open {
                from: self.points[*from],
                to: self.points[*to],
                along: *along,
                back: *back,
            });
        }
        Ok(Counts {
            points: points.len(),
            sides: all.len(),
            triangles,
            touching: all.iter().filter(|(_, counts)| counts[0] > 1).count(),
        })
    }

    /// What the triangles of some faces enclose (m³), by the divergence theorem about one of their points.
    pub fn volume(&self, faces: &[Used]) -> f64 {
        let Some([first, ..]) = self.triangles(faces).next() else {
            return 0.0;
        };
        let origin = self.points[first];
        let six: f64 = self
            .triangles(faces)
            .map(|corners| {
                let [a, b, c] = corners.map(|point| self.points[point] - origin);
                a.dot(b.cross(c))
            })
            .sum();
        six / 6.0
    }
}
