//! Around the border of a sheet that lands on a level one: three sectors, in an order that is known even where the
//! two touch without an angle.

use super::Label;
use super::arcs::{Flap, Labels, existing};
use super::tracks::{Geometry, Source, Track};

/// How a sheet and the level that it lands on lie to each other, seen along the landing.
///
/// The *near* side of the level is the sheet's; the *wedge* is what lies between the sheet and the part of the level
/// under it.
#[derive(Clone, Copy, Debug)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "four independent answers, each with its own name"
)]
struct Contact {
    /// Whether the level's region lies on the near side.
    near_is_inner: bool,
    /// Whether the sheet's region holds the wedge.
    wedge_is_inner: bool,
    /// Whether the sheet lies to the left of its border.
    sheet_is_left: bool,
    /// Whether, on the level, the part under the sheet does.
    under_is_left: bool,
}

impl Contact {
    /// At t of a landing; `None` where it runs beyond the level sheet.
    fn at(geometry: Geometry<'_>, track: &Track, t: f64) -> Option<Self> {
        let regions = geometry.regions;
        let Source::Edge(edge) = track.source else {
            return None;
        };
        let [sheet, level] = track.sheets.map(|sheet| &regions.sheets[sheet]);
        let [place, on_level] = [0, 1].map(|side| geometry.on_sheet(track.source, side, t).0);
        let [_, up, _] = level.plane?;
        if !level.holds(on_level.x, on_level.y) {
            return None;
        }
        let tangent = geometry.point_and_tangent(track.source, t).1;
        let (foot, su, sv) = sheet.first_jet(place.x, place.y);
        let normal = su.cross(sv);
        let middle = |axis: usize| sheet.low(axis) + 0.5 * sheet.length(axis);
        let above = (sheet.point(middle(0), middle(1)) - foot).dot(up) > 0.0;
        let near = if above { up } else { -up };
        let sheet_is_left = regions.edges[edge].sides[0].sheet_is_left();
        let inwards = if sheet_is_left { 1.0 } else { -1.0 } * normal.cross(tangent);
        Some(Self {
            near_is_inner: above != (level.outward > 0.0),
            wedge_is_inner: sheet.outward * normal.dot(near) > 0.0,
            sheet_is_left,
            under_is_left: up.cross(tangent).dot(inwards) > 0.0,
        })
    }
}

/// The flaps around a landing: the level under the sheet, the sheet, the level beyond it.
pub(super) fn flaps(
    geometry: Geometry<'_>,
    track: &Track,
    t: f64,
    sides: &[bool],
    labels: Labels<'_>,
) -> Vec<Flap> {
    let Some(contact) = Contact::at(geometry, track, t) else {
        return Vec::new();
    };
    let [sheet, level] = track
        .sheets
        .map(|sheet| geometry.regions.sheets[sheet].region);
    let (near, wedge) = (contact.near_is_inner, contact.wedge_is_inner);
    let label = |in_level: bool, in_sheet: bool| {
        let mut with = sides.to_vec();
        with[level] = in_level;
        with[sheet] = in_sheet;
        labels(&with)
    };
    let far = label(!near, !wedge);
    let (under, beyond) = (label(near, wedge), label(near, !wedge));
    // Each flap lies between the sector before it and the one after it.
    let flap = |side: usize, left: bool, before: Label, after: Label, before_is_inner: bool| Flap {
        side,
        left,
        labels: if before_is_inner {
            [before, after]
        } else {
            [after, before]
        },
        facing: [usize::from(!before_is_inner), usize::from(before_is_inner)],
    };
    existing(
        [
            flap(1, contact.under_is_left, far, under, !near),
            flap(0, contact.sheet_is_left, under, beyond, wedge),
            flap(1, !contact.under_is_left, beyond, far, near),
        ]
        .into_iter(),
    )
}
