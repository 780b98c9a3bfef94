#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use super::*;
use crate::features::side::Ends;

const LOW: DVec3 = DVec3::new(0.0, 0.0, -50.0);
const HIGH: DVec3 = DVec3::new(100.0, 80.0, 0.0);
const HERE: Placement = Placement {
    at: DVec3::ZERO,
    azimuth: 0.0,
};

/// Rows from west to east over [x0, x1] × [y0, y1], with heights of a function.
fn net(
    [x0, x1]: [f64; 2],
    [y0, y1]: [f64; 2],
    counts: [usize; 2],
    height: impl Fn(f64, f64) -> f64,
) -> NetDesign {
    let row = |i: usize| {
        let x = x0 + (x1 - x0) * i as f64 / (counts[0] - 1) as f64;
        (0..counts[1])
            .map(|j| {
                let y = y0 + (y1 - y0) * j as f64 / (counts[1] - 1) as f64;
                DVec3::new(x, y, height(x, y))
            })
            .collect()
    };
    NetDesign {
        points: (0..counts[0]).map(row).collect(),
        ..NetDesign::default()
    }
}

fn named(name: &str, net: NetDesign) -> NamedNet {
    NamedNet {
        name: name.to_owned(),
        net,
        joins: None,
    }
}

fn wavy(x: f64, y: f64) -> f64 {
    -25.0 + 6.0 * (0.07 * x).sin() * (0.09 * y).cos()
}

#[test]
fn a_net_on_the_walls_goes_on_beyond_them_and_holds_what_is_above_it() {
    for degree in [1, 2, 3] {
        let design = NetDesign {
            degree: [Some(degree); 2],
            ..net([0.0, 100.0], [0.0, 80.0], [6, 5], wavy)
        };
        let surface = design.build().unwrap();
        let nets = Nets::new(&[named("1", design)], HERE).unwrap();
        let side = nets.above(LOW, HIGH).unwrap();
        for k in 0..200 {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let on = surface.point(part(0.754_877_7), part(0.569_840_3));
            assert!(side.holds(on + 1e-8 * DVec3::Z), "{degree} {on}");
            assert!(!side.holds(on - 1e-8 * DVec3::Z), "{degree} {on}");
        }
        let (low, high) = side.bounds();
        assert!(low.x < -1.9 && low.y < -1.5 && high.x > 101.9 && high.y > 81.5);
        let Ends::Closed(_) = side.ends() else {
            unreachable!()
        };
    }
}

#[test]
fn sheets_that_end_fold_or_lie_elsewhere_are_refused() {
    let above = |design: NetDesign| {
        let nets = Nets::new(&[named("1", design)], HERE).unwrap();
        nets.above(LOW, HIGH)
    };
    let short = net([0.0, 90.0], [0.0, 80.0], [6, 5], wavy);
    assert!(matches!(
        above(short),
        Err(NetsError::Ends { is_one: true, .. })
    ));
    let mut folded = net([-10.0, 110.0], [-10.0, 90.0], [6, 5], wavy);
    folded.points[2][2].x = 200.0;
    assert!(matches!(above(folded), Err(NetsError::Folds { .. })));
    let beside = net([200.0, 300.0], [-10.0, 90.0], [6, 5], wavy);
    assert!(matches!(above(beside), Err(NetsError::Beside { .. })));
    // It may run whichever way.
    let turned = net([110.0, -10.0], [-10.0, 90.0], [6, 5], wavy);
    assert!(above(turned).is_ok());
}

#[test]
fn nets_of_different_degrees_join_and_are_one_sheet() {
    let west = NetDesign {
        degree: [Some(2); 2],
        ..net([-5.0, 55.0], [-5.0, 85.0], [4, 4], wavy)
    };
    let east = NetDesign {
        degree: [Some(3); 2],
        ..net([53.0, 105.0], [-5.0, 85.0], [5, 7], wavy)
    };
    for smoothness in [Smoothness::Edge, Smoothness::Tangent] {
        let joins = Some(JoinDesign {
            to: 0,
            own: None,
            side: None,
            smoothness,
        });
        let east = NamedNet {
            joins,
            ..named("east", east.clone())
        };
        let nets = Nets::new(&[named("west", west.clone()), east], HERE).unwrap();
        let joint = &nets.joints[0];
        assert_eq!((&*joint.name, &*joint.to), ("east", "west"));
        assert!(joint.gap <= 1e-12 * 200.0, "{}", joint.gap);
        let is_smooth = smoothness == Smoothness::Tangent;
        assert_eq!(joint.angle < 1e-6, is_smooth, "{}", joint.angle);
        let side = nets.above(LOW, HIGH).unwrap();
        assert_eq!(side.sheets().len(), 2);
        assert!(side.holds(DVec3::new(55.0, 40.0, -10.0)));
        assert!(!side.holds(DVec3::new(55.0, 40.0, -40.0)));
    }
    // Not joined, there is a gap between them, and it runs through the domain.
    let nets = Nets::new(&[named("west", west), named("east", east)], HERE).unwrap();
    let refused = nets.above(LOW, HIGH);
    assert!(matches!(
        refused,
        Err(NetsError::Ends { is_one: false, .. })
    ));
}

/// A ball of one net: a half circle turned about the z axis, with the weights of circles.
fn ball(radius: f64) -> NetDesign {
    let w = FRAC_1_SQRT_2;
    let half = [
        (0.0, -1.0, 1.0),
        (1.0, -1.0, w),
        (1.0, 0.0, 1.0),
        (1.0, 1.0, w),
        (0.0, 1.0, 1.0),
    ];
    let around = [
        (1.0, 0.0, 1.0),
        (1.0, 1.0, w),
        (0.0, 1.0, 1.0),
        (-1.0, 1.0, w),
        (-1.0, 0.0, 1.0),
        (-1.0, -1.0, w),
        (0.0, -1.0, 1.0),
        (1.0, -1.0, w),
        (1.0, 0.0, 1.0),
    ];
    let point = |(x, y, _): (f64, f64, f64), (r, z, _): (f64, f64, f64)| {
        radius * DVec3::new(x * r, y * r, z)
    };
    NetDesign {
        points: around
            .iter()
            .map(|a| half.iter().map(|h| point(*a, *h)).collect())
            .collect(),
        degree: [Some(2); 2],
        weights: around
            .iter()
            .map(|a| half.iter().map(|h| a.2 * h.2).collect())
            .collect(),
        knots: [
            Some(vec![
                0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0,
            ]),
            Some(vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]),
        ],
    }
}

#[test]
fn a_closed_net_of_circles_is_a_ball() {
    let placement = Placement {
        at: DVec3::new(10.0, 20.0, -30.0),
        azimuth: 0.4,
    };
    let nets = Nets::new(&[named("1", ball(5.0))], placement).unwrap();
    let shell = nets.inside().unwrap();
    let mut held = 0;
    for k in 0..4000 {
        let part = |ratio: f64| 2.0 * (f64::from(k) * ratio).fract() - 1.0;
        let from = 6.0 * DVec3::new(part(0.819_172_5), part(0.671_043_6), part(0.549_700_5));
        let is_inside = from.length() < 5.0;
        assert_eq!(shell.contains(placement.at + from), is_inside, "{from}");
        held += i32::from(is_inside);
    }
    let share = PI / 6.0 * (5.0_f64 / 6.0).powi(3);
    assert!((f64::from(held) / 4000.0 - share).abs() < 0.02);
}

#[test]
fn what_is_open_or_passes_through_itself_is_no_body() {
    let mut open = ball(5.0);
    open.points[8][2].x = 5.1;
    let refused = Nets::new(&[named("1", open)], HERE).unwrap().inside();
    assert!(matches!(refused, Err(NetsError::Open(_))));
    // Two sheets that share their rims and cross each other between.
    let lower = net([0.0, 10.0], [0.0, 10.0], [4, 4], |_, _| 0.0);
    let mut upper = lower.clone();
    upper.points[1][1].z = 8.0;
    upper.points[1][2].z = 8.0;
    let pair = |upper: &NetDesign| {
        let nets = [named("lower", lower.clone()), named("upper", upper.clone())];
        Nets::new(&nets, HERE).unwrap().inside()
    };
    assert!(pair(&upper).is_ok());
    upper.points[2][1].z = -8.0;
    upper.points[2][2].z = -8.0;
    assert!(matches!(pair(&upper), Err(NetsError::Itself { .. })));
}

#[test]
fn points_count_from_a_place_and_their_y_axis_points_to_an_azimuth() {
    let placement = Placement {
        at: DVec3::new(100.0, 200.0, -10.0),
        azimuth: std::f64::consts::FRAC_PI_2,
    };
    let nets = Nets::new(
        &[named(
            "1",
            net([0.0, 10.0], [0.0, 20.0], [2, 2], |_, _| 1.0),
        )],
        placement,
    );
    let nets = nets.unwrap();
    let surface = &nets.surfaces()[0].1;
    // y to the east, x to the south.
    assert!(
        surface
            .point(0.0, 1.0)
            .distance(DVec3::new(120.0, 200.0, -9.0))
            < 1e-12
    );
    assert!(
        surface
            .point(1.0, 0.0)
            .distance(DVec3::new(100.0, 190.0, -9.0))
            < 1e-12
    );
}
