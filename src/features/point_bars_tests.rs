#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use glam::DVec3;

use super::*;
use crate::features::bends::bends;
use crate::features::reach::tests::{along, design, meander};
use crate::nurbs::Surface;

const BARS: PointBarsDesign = PointBarsDesign {
    surfaces: 4,
    dip: None,
    reach: 0.35,
    apex: 0.5,
    translation: 0.0,
    slope: Slope::Straight,
    drape: None,
};

fn reach() -> Reach {
    along(design(), meander()).1
}

/// Distance from the inner rim (m) and height above the channel's top of a sheet's place.
fn inner(reach: &Reach, bend: &Bend, sheet: &Surface, u: f64, s: f64) -> DVec2 {
    let part = [bend.from, bend.to];
    let v = (s - part[0]) / (part[1] - part[0]);
    let p = sheet.point(u, v);
    let place = reach.trajectory().at(s);
    let x = (p.truncate() - place.point).dot(place.right());
    DVec2::new(25.0 + bend.turn * x, p.z + 5.0)
}

#[test]
fn at_the_apex_sheets_fall_at_their_dip_from_where_the_paper_has_them() {
    let reach = reach();
    for bend in &bends(reach.trajectory(), 50.0, 0.3)[1..3] {
        let bar = BARS.build(&reach, bend).unwrap();
        assert_eq!((bar.packages.len(), bar.drapes.len()), (4, 0));
        // The youngest sheet's tube runs from inflection to inflection.
        let sheet = bar.packages[3].sheet(Role::Accretion).unwrap();
        let apex = f64::midpoint(bend.from, bend.to);
        let [toe, top] = [0.0, 1.0].map(|u| inner(&reach, bend, sheet, u, apex));
        let gradient = 1.5 * 4.4 / 50.0;
        assert!(((top.y - toe.y) / (toe.x - top.x) - gradient).abs() < 1e-3);
        assert!((gradient.atan().to_degrees() - 7.5).abs() < 0.05);
        // Where it comes to the top.
        let at_top = top.x + top.y / gradient;
        assert!((at_top - 17.5).abs() < 0.06, "{at_top}");
    }
}

#[test]
fn at_the_inflections_every_sheet_is_outside_of_the_channel() {
    let (channel, reach) = along(design(), meander());
    let trough = Shell::new(channel.sheets().unwrap()).unwrap();
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    for slope in [Slope::Straight, Slope::Sigmoidal] {
        for dip in [None, Some(5_f64.to_radians()), Some(20_f64.to_radians())] {
            let bar = PointBarsDesign { dip, slope, ..BARS }
                .build(&reach, &bend)
                .unwrap();
            for package in &bar.packages {
                let sheet = package.sheet(Role::Accretion).unwrap();
                let mut held = [0; 2];
                for k in 0..=300 {
                    let u = f64::from(k) / 300.0;
                    for (at, v) in [0.01, 0.5].into_iter().enumerate() {
                        held[at] += usize::from(trough.contains(sheet.point(u, v)));
                    }
                }
                assert_eq!(held[0], 0, "{slope:?} {dip:?}");
                assert!(held[1] > 100);
            }
        }
    }
}

#[test]
fn a_package_is_inside_of_its_sheet_and_younger_sheets_are_outside_of_older_ones() {
    let reach = reach();
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    for slope in [Slope::Straight, Slope::Sigmoidal] {
        let bar = PointBarsDesign { slope, ..BARS }
            .build(&reach, &bend)
            .unwrap();
        let place = reach.trajectory().at(f64::midpoint(bend.from, bend.to));
        let mut seen = [0; 5];
        for x in -240..240 {
            let at = (place.point + place.right() * f64::from(x) * 0.1).extend(-6.0);
            let holds: Vec<bool> = bar.packages.iter().map(|one| one.contains(at)).collect();
            // Once inside, inside of all younger ones.
            assert!(holds.windows(2).all(|pair| pair[0] <= pair[1]), "{holds:?}");
            seen[holds.iter().filter(|held| **held).count()] += 1;
        }
        assert!(seen.iter().all(|count| *count > 20), "{slope:?}: {seen:?}");
    }
}

#[test]
fn a_sigmoidal_sheet_meets_the_top_where_a_straight_one_does_and_is_gentler_there() {
    let reach = reach();
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    let bar = PointBarsDesign {
        slope: Slope::Sigmoidal,
        ..BARS
    };
    let bar = bar.build(&reach, &bend).unwrap();
    let sheet = bar.packages[3].sheet(Role::Accretion).unwrap();
    let apex = f64::midpoint(bend.from, bend.to);
    let at = |u: f64| inner(&reach, &bend, sheet, u, apex);
    let points: Vec<DVec2> = (0..=4000).map(|k| at(f64::from(k) / 4000.0)).collect();
    let crossing = points.windows(2).find(|pair| pair[1].y > 0.0).unwrap();
    assert!((crossing[0].x - 17.5).abs() < 0.1);
    let gradients: Vec<f64> = points
        .windows(2)
        .map(|pair| (pair[1].y - pair[0].y) / (pair[0].x - pair[1].x))
        .collect();
    let steepest = gradients.iter().fold(0.0, |a: f64, b| a.max(*b));
    assert!((steepest / 0.132 - 1.5).abs() < 1e-2, "{steepest}");
    assert!((gradients[0] / 0.132 - 0.3).abs() < 0.01);
}

#[test]
fn a_drape_is_as_thick_as_asked_on_the_upper_two_thirds_of_its_sheet() {
    let reach = reach();
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    for slope in [Slope::Straight, Slope::Sigmoidal] {
        let bar = PointBarsDesign {
            drape: Some(0.2),
            slope,
            ..BARS
        };
        let bar = bar.build(&reach, &bend).unwrap();
        assert_eq!(bar.drapes.len(), 4);
        let (sheet, drape) = (
            bar.packages[3].sheet(Role::Accretion).unwrap(),
            bar.drapes[3].sheet(Role::Accretion).unwrap(),
        );
        for u in [0.3, 0.6, 0.9] {
            let on = drape.point(u, 0.5);
            let distance = sheet.closest(on, 1e-6).distance;
            if slope == Slope::Straight {
                assert!((distance - 0.2).abs() < 2e-3, "{distance}");
            }
            assert!(bar.drapes[3].contains(on - 1e-3 * DVec3::Z));
            assert!(!bar.packages[3].contains(on));
        }
        let toe = drape.point(0.0, 0.5);
        assert!((toe.z + 5.0 + 2.0 / 3.0 * 4.4).abs() < 1e-3);
    }
}

#[test]
fn without_translation_reversing_the_river_mirrors_nothing() {
    let reach = reach();
    let line = reach.trajectory();
    let points: Vec<DVec2> = (0..=64)
        .rev()
        .map(|k| line.at(line.length() * f64::from(k) / 64.0).point)
        .collect();
    let spacing = crate::nurbs::interpolate::Parametrization::ChordLength;
    let back = crate::features::trajectory::Trajectory::through(&points, 3, spacing).unwrap();
    let back = along(design(), back).1;
    let (own, other) = (
        bends(line, 50.0, 0.3)[1],
        bends(back.trajectory(), 50.0, 0.3)[2],
    );
    let (one, two) = (
        BARS.build(&reach, &own).unwrap(),
        BARS.build(&back, &other).unwrap(),
    );
    let mut inside = 0;
    for k in 0..4000 {
        let part = |ratio: f64| (f64::from(k) * ratio).fract();
        let (low, high) = one.packages[3].bounds();
        let at = low + (high - low) * DVec3::new(part(0.819_17), part(0.671_04), part(0.549_7));
        for (a, b) in one.packages.iter().zip(&two.packages) {
            // Inside of the channel both lines are the same to some centimetres.
            let near = a.inside().distance(at, 0.3).is_some();
            if !near && at.z < -5.0 && at.z > -9.0 {
                let in_channel = line
                    .places()
                    .iter()
                    .any(|p| p.point.distance(at.truncate()) < 20.0);
                if in_channel {
                    assert_eq!(a.contains(at), b.contains(at), "{at}");
                    inside += usize::from(a.contains(at));
                }
            }
        }
    }
    assert!(inside > 50, "{inside}");
}

#[test]
fn translation_moves_older_surfaces_upstream_until_they_would_cross() {
    let reach = reach();
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    let moved = |translation: f64| {
        PointBarsDesign {
            translation,
            ..BARS
        }
        .build(&reach, &bend)
    };
    // How far a sheet's upper border is from the inner rim.
    let widest = |shell: &Shell| {
        let sheet = shell.sheet(Role::Accretion).unwrap();
        let at = |v: f64| {
            let p = sheet.point(1.0, v);
            let s = bend.from + (bend.to - bend.from) * v;
            let place = reach.trajectory().at(s);
            bend.turn * (p.truncate() - place.point).dot(place.right())
        };
        (0..=100)
            .map(|k| f64::from(k) / 100.0)
            .max_by(|a, b| at(*a).total_cmp(&at(*b)))
            .unwrap()
    };
    let bar = moved(0.12).unwrap();
    let places: Vec<f64> = bar.packages.iter().map(widest).collect();
    assert!(
        places.windows(2).all(|pair| pair[0] < pair[1]),
        "{places:?}"
    );
    assert!((places[3] - 0.5).abs() < 0.02 && (places[0] - 0.41).abs() < 0.04);
    let error = moved(0.4).unwrap_err();
    assert!(matches!(error, PointBarError::Crossing { .. }), "{error}");
}

#[test]
fn bars_that_cannot_be_are_refused() {
    let reach = reach();
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    for bad in [
        PointBarsDesign {
            surfaces: 0,
            ..BARS
        },
        PointBarsDesign {
            surfaces: 30,
            ..BARS
        },
        PointBarsDesign {
            dip: Some(1.4),
            ..BARS
        },
        PointBarsDesign {
            reach: f64::NAN,
            ..BARS
        },
        PointBarsDesign { apex: 0.1, ..BARS },
        PointBarsDesign {
            drape: Some(0.0),
            ..BARS
        },
        PointBarsDesign {
            surfaces: 20,
            reach: 0.1,
            ..BARS
        },
    ] {
        assert!(bad.build(&reach, &bend).is_err(), "{bad:?}");
    }
}
