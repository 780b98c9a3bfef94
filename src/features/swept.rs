//! Open sheets with everything that lies off them in one direction: a side of any sheets whatsoever.
//!
//! What lies on the younger side of heights over the plan, or of sheets that hang along one strike, follows from a formula. Of sheets of
//! any other shape it is what they pass over when they are moved far away: a closed shell of the sheets, a copy of them beyond whatever
//! is asked for, and ruled walls from their outer borders to the copy's. Whether it holds a point, rays through that shell tell.

use glam::DVec3;

use super::body::Role;
use super::shell::{Shell, ShellError};
use super::side::{Ends, Open, Side};
use crate::nurbs::{Curve, Surface};

/// How far apart borders may be that are the same, as a fraction of the sheets' size: as for closed shells.
const SAME: f64 = 1e-9;
/// Places along a border at which it is compared with another one, as fractions of its domain.
const COMPARED: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Sheets and what they pass over.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    sheets: Vec<Surface>,
    shell: Shell,
}

impl Swept {
    /// Sheets that are one surface, and what they pass over when they are moved: nowhere may they pass the same place twice.
    pub fn new(name: &'static str, sheets: Vec<Surface>, by: DVec3) -> Result<Self, ShellError> {
        let role = Role::Open(name);
        Self::with_roles(sheets.into_iter().map(|sheet| (role, sheet)).collect(), by)
    }

    /// The same of sheets with roles of their own.
    pub(super) fn with_roles(sheets: Vec<(Role, Surface)>, by: DVec3) -> Result<Self, ShellError> {
        let bare: Vec<Surface> = sheets.iter().map(|sheet| sheet.1.clone()).collect();
        let mut closed = sheets;
        for border in outer_borders(&bare) {
            let beyond = border.moved(by);
            closed.push((Role::Hidden, Surface::ruled(&border, &beyond)?));
        }
        for sheet in &bare {
            closed.push((Role::Hidden, sheet.moved(by)));
        }
        Ok(Self {
            sheets: bare,
            shell: Shell::new(closed)?,
        })
    }

    /// The closed shell.
    pub fn shell(&self) -> &Shell {
        &self.shell
    }

    /// The side that they bound.
    pub fn side(self, name: &'static str) -> Side {
        let ends = Ends::Closed(self.shell.clone());
        Side::new(Role::Open(name), std::sync::Arc::new(self), ends)
    }
}

impl Open for Swept {
    fn sheets(&self) -> &[Surface] {
        &self.sheets
    }

    fn holds(&self, point: DVec3) -> bool {
        self.shell.contains(point)
    }
}

/// The four borders of a sheet.
pub(super) fn borders(sheet: &Surface) -> [Curve; 4] {
    let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
    [
        sheet.isocurve_u(u0),
        sheet.isocurve_u(u1),
        sheet.isocurve_v(v0),
        sheet.isocurve_v(v1),
    ]
}

/// Whether two borders are the same, run through either way.
pub(super) fn are_same(one: &Curve, other: &Curve, tolerance: f64) -> bool {
    let place = |curve: &Curve, part: f64| {
        let (from, to) = curve.domain();
        curve.point(from + (to - from) * part)
    };
    [false, true].into_iter().any(|is_turned| {
        std::iter::once(&0.0).chain(&COMPARED).all(|part| {
            let own = if is_turned { 1.0 - part } else { *part };
            place(one, own).distance(place(other, *part)) <= tolerance
        })
    })
}

/// The borders of sheets that no two of them share, and that are no points.
fn outer_borders(sheets: &[Surface]) -> Vec<Curve> {
    let (low, high) = super::side::points_bounds(sheets.iter().flat_map(Surface::net));
    let tolerance = SAME * low.distance(high);
    let mut open: Vec<Curve> = Vec::new();
    for border in sheets.iter().flat_map(borders) {
        let first = border.points()[0];
        if border
            .points()
            .iter()
            .all(|p| p.distance(first) <= tolerance)
        {
            continue;
        }
        match open
            .iter()
            .position(|other| are_same(other, &border, tolerance))
        {
            Some(at) => {
                open.remove(at);
            }
            None => open.push(border),
        }
    }
    open
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;
    use crate::nurbs::KnotVector;

    /// A sheet over [`from`, `from` + 10] × [0, 10] with a hump.
    fn sheet(from: f64) -> Surface {
        let knots = KnotVector::uniform(2, 3).unwrap();
        let mut net = Vec::new();
        for i in 0..3 {
            for j in 0..3 {
                let z = if (i, j) == (1, 1) { 4.0 } else { 0.0 };
                net.push(DVec3::new(from + 5.0 * f64::from(i), 5.0 * f64::from(j), z));
            }
        }
        Surface::new(knots.clone(), knots, net).unwrap()
    }

    #[test]
    fn sheets_beside_each_other_hold_what_is_above_both() {
        let side = Swept::new(
            "sheet",
            vec![sheet(0.0), sheet(10.0)],
            DVec3::new(0.0, 0.0, 100.0),
        );
        let side = side.unwrap().side("sheet");
        // The hump of a Bézier net with one point of four raised is a quarter as high in its middle.
        for x in [5.0, 15.0] {
            assert!(side.holds(DVec3::new(x, 5.0, 1.0 + 1e-9)));
            assert!(!side.holds(DVec3::new(x, 5.0, 1.0 - 1e-9)));
        }
        assert!(side.holds(DVec3::new(10.0, 3.0, 1e-9)));
        assert!(!side.holds(DVec3::new(10.0, 3.0, -1e-9)));
        let Ends::Closed(shell) = side.ends() else {
            unreachable!()
        };
        // Two sheets, two copies and six walls: none where they join.
        assert_eq!(shell.sheets().len(), 10);
    }
}
