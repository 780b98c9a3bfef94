#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use super::super::clinoform::ClinoformDesign;
use super::super::frame::Shoreline;
use super::super::horizon::Horizon;
use super::*;

const LOW: DVec3 = DVec3::new(0.0, 0.0, -30.0);
const HIGH: DVec3 = DVec3::new(365.76, 670.56, 0.0);
const AZIMUTHS: [f64; 6] = [0.0, 45.0, 90.0, 180.0, 270.0, 320.0];

struct Case {
    frame: ClinoformFrame,
    unit: ClinoformUnit,
    younger: Clinoform,
}

fn case(azimuth_deg: f64, toe: f64) -> Case {
    let horizon = |z| Horizon::flat(z).unwrap();
    let unit = ClinoformUnit::new(horizon(-21.0), horizon(-1.0), LOW, HIGH).unwrap();
    let frame = ClinoformFrame::new(LOW, HIGH, azimuth_deg.to_radians()).unwrap();
    let shoreline = Shoreline {
        dip: 3000.0,
        strike: 6000.0,
    };
    let design = ClinoformDesign {
        origin: frame.first_origin(shoreline) + 60.0,
        shoreline,
        length: 250.0,
        exponent: 2.0,
        toe,
    };
    let younger = Clinoform::new(&design, &frame, &unit).unwrap();
    Case {
        frame,
        unit,
        younger,
    }
}

/// Nodes every ninth of the strikes with values that alternate in sign.
fn nodes(reach: f64, value: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
    (0..10)
        .map(|k| [reach * (2.0 * k as f64 / 9.0 - 1.0), value(k)])
        .collect()
}

fn alternating(k: usize) -> f64 {
    if k.is_multiple_of(2) { -0.5 } else { 0.5 }
}

fn design(distance: f64, interfingering: f64, wander: Wander) -> BoundaryDesign {
    BoundaryDesign {
        distance,
        interfingering,
        wander,
    }
}

/// z of the younger sheet (exponent 2, toe 0) by its formula, at a distance past its truncation, at q.
fn on_younger(case: &Case, distance: f64, q: f64) -> f64 {
    let length = case.younger.d_toe(q) - case.younger.d_top(q);
    -21.0 + 20.0 * (1.0 - distance / length).max(0.0).powi(2)
}

#[test]
fn a_boundary_without_wander_lies_on_the_younger_sheet_at_its_distance_and_past_the_toe_on_the_base()
 {
    for azimuth in AZIMUTHS {
        let case = case(azimuth, 0.0);
        let reach = case.frame.reach();
        for distance in [30.0, 140.0, 400.0] {
            let wander = Wander::Smooth(nodes(reach, |_| 0.0));
            let design = design(distance, 40.0, wander);
            let boundary = FaciesBoundary::new(&design, &case.younger, &case.unit).unwrap();
            assert!(boundary.deviation() <= case.frame.tolerance());
            for k in -10..=10 {
                let q = reach * f64::from(k) / 10.5;
                let d = case.younger.d_top(q) + distance;
                let z = on_younger(&case, distance, q);
                assert!((boundary.d(q, z) - d).abs() < 2e-3);
                let at = |d: f64, z: f64| case.frame.place(d, q).extend(z);
                assert!(boundary.holds(at(d + 0.01, z)));
                assert!(!boundary.holds(at(d - 0.01, z)));
                // It dips landward: above the line it is farther basinward, by I over the unit's height of 20 m.
                assert!(!boundary.holds(at(d + 0.01, z + 5.0)));
                assert!((boundary.d(q, z + 5.0) - d - 10.0).abs() < 2e-3);
                assert!((boundary.d(q, z - 5.0) - d + 10.0).abs() < 2e-3);
            }
        }
    }
}

#[test]
fn where_a_boundary_wanders_landward_of_the_shoreline_it_lies_on_the_top() {
    let case = case(320.0, 0.0);
    let reach = case.frame.reach();
    let wander = Wander::Zigzag(nodes(reach, alternating));
    let boundary = FaciesBoundary::new(&design(10.0, 80.0, wander), &case.younger, &case.unit);
    let boundary = boundary.unwrap();
    for (k, [q, value]) in nodes(reach, alternating).into_iter().enumerate() {
        // Landward by 10 − 40 m: there the unit's top, at −1 m, is what the boundary starts from.
        let distance = 10.0 + 80.0 * value;
        let z = if value < 0.0 {
            -1.0
        } else {
            on_younger(&case, distance, q)
        };
        let off = boundary.d(q, z) - case.younger.d_top(q) - distance;
        assert!(off.abs() < 2e-3, "node {k}: {off}");
    }
}

#[test]
fn a_leg_that_the_strikes_cut_off_keeps_its_direction() {
    let case = case(320.0, 0.0);
    let reach = case.frame.reach();
    let nodes = vec![[-1.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [1.5, 0.5]];
    let nodes: Vec<[f64; 2]> = nodes.into_iter().map(|[q, x]| [q * reach, x]).collect();
    let design = design(100.0, 60.0, Wander::Zigzag(nodes));
    let boundary = FaciesBoundary::new(&design, &case.younger, &case.unit).unwrap();
    // At both ends of the strikes its first and its last leg are half way from side to side.
    for q in [-reach, reach] {
        let z = on_younger(&case, 100.0, q);
        let off = boundary.d(q, z) - case.younger.d_top(q) - 100.0;
        assert!(off.abs() < 2e-3, "{q}: {off}");
    }
}

#[test]
fn a_boundary_holds_what_is_basinward_of_its_sheets_to_a_nanometre() {
    for azimuth in AZIMUTHS {
        let case = case(azimuth, 0.3);
        let reach = case.frame.reach();
        let values = |k: usize| [0.1, -0.4, 0.5, -0.2, 0.3][k % 5];
        for wander in [
            Wander::Smooth(nodes(reach, values)),
            Wander::Zigzag(nodes(reach, alternating)),
        ] {
            let design = design(100.0, 60.0, wander);
            let boundary = FaciesBoundary::new(&design, &case.younger, &case.unit).unwrap();
            let step = 1e-9 * case.frame.dip().extend(0.0);
            for sheet in boundary.sheets() {
                for k in 1..40 {
                    let on = sheet.point(f64::from(k) / 40.0, (f64::from(k) * 0.618).fract());
                    assert!(boundary.holds(on + step));
                    assert!(!boundary.holds(on - step));
                }
            }
        }
    }
}

#[test]
fn a_smooth_boundary_passes_its_nodes_and_wanders_within_its_range() {
    let case = case(320.0, 0.0);
    let reach = case.frame.reach();
    let interfingering = 60.0;
    // d less the shoreline and the distance, on the line itself: past the toe, so at the base.
    let wandering = |values: &dyn Fn(usize) -> f64| {
        let nodes = nodes(reach, values);
        let design = design(400.0, interfingering, Wander::Smooth(nodes));
        let boundary = FaciesBoundary::new(&design, &case.younger, &case.unit).unwrap();
        let younger = case.younger.clone();
        move |q: f64| (boundary.d(q, -21.0) - younger.d_top(q) - 400.0) / interfingering
    };
    let gentle = |k: usize| [0.1, -0.2, 0.25, -0.1, 0.2][k % 5];
    let wander = wandering(&gentle);
    for [q, value] in nodes(reach, gentle) {
        assert!(
            (wander(q) - value).abs() < 1e-4,
            "{q} {value} {}",
            wander(q)
        );
    }
    // These values would swing beyond a half between the nodes.
    let wander = wandering(&|k| if k % 4 < 2 { -0.5 } else { 0.5 });
    let most = (0..=2000)
        .map(|k| wander(reach * (f64::from(k) / 1000.0 - 1.0)).abs())
        .fold(0.0, f64::max);
    assert!((0.499..0.500_1).contains(&most), "{most}");
    // Twice continuously differentiable: one sheet with single knots.
    let case_nodes = Wander::Smooth(nodes(reach, gentle));
    let design = design(400.0, interfingering, case_nodes);
    let boundary = FaciesBoundary::new(&design, &case.younger, &case.unit).unwrap();
    assert_eq!(boundary.sheets().len(), 1);
    let knots = boundary.sheets()[0].knots_v().distinct();
    assert!(knots[1..knots.len() - 1].iter().all(|knot| knot.1 == 1));
}

#[test]
fn zigzag_legs_are_straight_but_for_the_shoreline_and_share_their_rulings_exactly() {
    for azimuth in AZIMUTHS {
        let case = case(azimuth, 0.0);
        let reach = case.frame.reach();
        let nodes = nodes(reach, alternating);
        let wander = Wander::Zigzag(nodes.clone());
        let boundary =
            FaciesBoundary::new(&design(400.0, 50.0, wander), &case.younger, &case.unit).unwrap();
        assert_eq!(boundary.sheets().len(), 9);
        for pair in boundary.sheets().windows(2) {
            assert_eq!(pair[0].isocurve_v(1.0), pair[1].isocurve_v(0.0));
        }
        for pair in nodes.windows(2) {
            let part = 0.37;
            let q = pair[0][0] + part * (pair[1][0] - pair[0][0]);
            let wander = pair[0][1] + part * (pair[1][1] - pair[0][1]);
            let d = case.younger.d_top(q) + 400.0 + 50.0 * wander;
            assert!((boundary.d(q, -21.0) - d).abs() < 2e-3);
        }
    }
}

#[test]
fn nodes_beyond_the_strikes_are_cut_off_there() {
    let case = case(90.0, 0.0);
    let reach = case.frame.reach();
    let nodes = vec![[-2.0 * reach, -0.5], [0.0, 0.5], [2.0 * reach, -0.5]];
    for (wander, sheets) in [
        (Wander::Zigzag(nodes.clone()), 2),
        (Wander::Smooth(nodes), 1),
    ] {
        let boundary =
            FaciesBoundary::new(&design(400.0, 50.0, wander), &case.younger, &case.unit).unwrap();
        assert_eq!(boundary.sheets().len(), sheets);
        let last = &boundary.sheets()[sheets - 1];
        for (point, q) in [
            (boundary.sheets()[0].point(0.5, 0.0), -reach),
            (last.point(0.5, 1.0), reach),
        ] {
            assert!((case.frame.local(point.truncate()).y - q).abs() < 1e-9);
        }
        let apex = boundary.d(0.0, -21.0) - case.younger.d_top(0.0);
        assert!((apex - 425.0).abs() < 1e-3);
    }
}

#[test]
fn where_the_line_passes_the_toe_at_an_angle_its_corner_is_rounded_by_decimetres() {
    let case = case(320.0, 0.3);
    let wander = Wander::Smooth(nodes(case.frame.reach(), alternating));
    let design = design(250.0, 60.0, wander);
    let boundary = FaciesBoundary::new(&design, &case.younger, &case.unit).unwrap();
    let deviation = boundary.deviation();
    assert!(
        (case.frame.tolerance()..0.3).contains(&deviation),
        "{deviation}"
    );
}

#[test]
fn sheets_reach_a_twentieth_of_the_height_beyond_the_unit() {
    let case = case(45.0, 0.0);
    let wander = Wander::Zigzag(nodes(case.frame.reach(), alternating));
    let boundary =
        FaciesBoundary::new(&design(100.0, 50.0, wander), &case.younger, &case.unit).unwrap();
    for sheet in boundary.sheets() {
        assert!((sheet.point(0.0, 0.3).z - -22.0).abs() < 1e-12);
        assert!((sheet.point(1.0, 0.3).z - 0.0).abs() < 1e-12);
    }
}

#[test]
fn numbers_that_make_no_boundary_are_refused() {
    let case = case(0.0, 0.0);
    let reach = case.frame.reach();
    let made = |design: BoundaryDesign| {
        FaciesBoundary::new(&design, &case.younger, &case.unit).map(|_| ())
    };
    let good = nodes(reach, |_| 0.0);
    assert_eq!(made(design(1.0, 0.0, Wander::Smooth(good.clone()))), Ok(()));
    assert_eq!(
        made(design(0.0, 1.0, Wander::Smooth(good.clone()))),
        Err(BoundaryError::Distance(0.0))
    );
    assert_eq!(
        made(design(1.0, -1.0, Wander::Smooth(good.clone()))),
        Err(BoundaryError::Interfingering(-1.0))
    );
    let short = good[..9].to_vec();
    assert!(matches!(
        made(design(1.0, 1.0, Wander::Zigzag(short))),
        Err(BoundaryError::Nodes { count: 9, .. })
    ));
    let mut turned = good.clone();
    turned.swap(3, 4);
    assert!(matches!(
        made(design(1.0, 1.0, Wander::Smooth(turned))),
        Err(BoundaryError::Order { index: 4, .. })
    ));
    let mut wide = good;
    wide[2][1] = -0.51;
    assert_eq!(
        made(design(1.0, 1.0, Wander::Smooth(wide))),
        Err(BoundaryError::Value {
            index: 2,
            value: -0.51
        })
    );
}
