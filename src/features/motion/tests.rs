#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use glam::{DMat3, DVec2, DVec3};

use super::*;
use crate::features::fault_surface::FaultSurface;
use crate::features::horizon::Horizon;

const LOW: DVec3 = DVec3::new(-600.0, -300.0, -500.0);
const HIGH: DVec3 = DVec3::new(900.0, 400.0, 100.0);

/// δ₀ = 60°, H = 400 m: R = 800 m, level from x = 692.8 m on.
const DIP: f64 = PI / 3.0;
const DEPTH: f64 = 400.0;

fn place(k: u32) -> DVec3 {
    let part = |ratio: f64| (f64::from(k) * ratio).fract();
    let unit = DVec3::new(
        part(0.819_172_513),
        part(0.671_043_607),
        part(0.549_700_478),
    );
    LOW + (HIGH - LOW) * unit
}

fn circular() -> Arc<FaultSurface> {
    Arc::new(FaultSurface::circular(DVec3::ZERO, DIP, FRAC_PI_2, DEPTH).unwrap())
}

/// z = −1.2 x + 20 sin(x/90) + 8 cos(y/70) + 0.001 x y, nearly: through nodes.
fn free() -> Arc<FaultSurface> {
    let f = |x: f64, y: f64| {
        -1.2 * x + 20.0 * (x / 90.0).sin() + 8.0 * (y / 70.0).cos() + 0.001 * x * y
    };
    let step = |k: u32| f64::from(k) * 40.0;
    let rows: Vec<Vec<f64>> = (0..=30)
        .map(|j| {
            (0..=60)
                .map(|i| f(step(i) - 1000.0, step(j) - 600.0))
                .collect()
        })
        .collect();
    let horizon = Horizon::grid([-1000.0, 1400.0], [-600.0, 600.0], &rows).unwrap();
    Arc::new(FaultSurface::graph(horizon, DVec2::ZERO, FRAC_PI_2).unwrap())
}

fn heave(surface: Arc<FaultSurface>, heave: Variation, shear_deg: f64) -> Motion {
    let design = HeaveDesign {
        surface,
        azimuth: None,
        heave,
        shear: shear_deg.to_radians(),
        within: [LOW, HIGH],
    };
    design.build().unwrap()
}

fn faults() -> Vec<Arc<FaultSurface>> {
    let through = DVec3::new(30.0, -20.0, 10.0);
    let exponential = FaultSurface::exponential(through, DIP, 0.6, 300.0).unwrap();
    let places = [
        [-200.0, 250.0],
        [0.0, 10.0],
        [150.0, -120.0],
        [400.0, -200.0],
        [700.0, -230.0],
    ];
    let points = FaultSurface::profile(through, 2.0, &places).unwrap();
    vec![circular(), Arc::new(exponential), Arc::new(points), free()]
}

/// Every kind of motion, those of one volume first; and the others.
fn motions() -> [Vec<Motion>; 2] {
    let mut keep = vec![Motion::Shift(DVec3::new(3.0, -4.0, 5.0))];
    let varied = Variation::through(&[[-300.0, 20.0], [0.0, 45.0], [400.0, 30.0]]).unwrap();
    for surface in faults() {
        for heaves in [
            Variation::constant(60.0),
            Variation::constant(-25.0),
            varied.clone(),
        ] {
            keep.push(heave(Arc::clone(&surface), heaves.clone(), 0.0));
            keep.push(heave(Arc::clone(&surface), heaves, 20.0));
        }
    }
    let train = FoldShape::Train {
        amplitude: 40.0,
        wavelength: 300.0,
        phase: 20.0,
    };
    for (axial_dip, plunge, shape) in [
        (90.0_f64, 0.0_f64, train),
        (70.0, 10.0, train),
        (8.0, 0.0, FoldShape::pair(60.0, 8.0_f64.to_radians(), 15.0)),
    ] {
        let design = FoldDesign {
            through: DVec3::new(10.0, 20.0, -30.0),
            azimuth: 0.7,
            axial_dip: axial_dip.to_radians(),
            plunge: plunge.to_radians(),
            shape,
        };
        keep.push(design.build().unwrap());
    }
    keep.push(Affine::tilt(DVec3::new(1.0, 2.0, 3.0), 0.3, 1.1).unwrap());
    keep.push(Affine::shear(DVec3::ZERO, DVec3::Z, DVec3::new(0.4, 0.1, 0.0)).unwrap());
    let plane = Arc::new(FaultSurface::planar(DVec3::ZERO, DIP, 1.0).unwrap());
    let along = Variation::through(&[[-500.0, 5.0], [600.0, 60.0]]).unwrap();
    let slip = |rake_deg: f64, displacement: Displacement, share, reach| {
        let design = SlipDesign {
            surface: Arc::clone(&plane),
            rake: rake_deg.to_radians(),
            displacement,
            share,
            reach,
        };
        design.build().unwrap()
    };
    keep.push(slip(
        -90.0,
        Displacement::AlongStrike(along.clone()),
        1.0,
        None,
    ));
    let mut others = vec![slip(-50.0, Displacement::AlongStrike(along), 0.6, None)];
    for law in [Law::WalshWatterson, Law::Linear, Law::Bell] {
        let elliptic = Displacement::Elliptic {
            most: 80.0,
            centre: [10.0, -20.0],
            semi_axes: [1500.0, 700.0],
            law,
        };
        others.push(slip(-90.0, elliptic.clone(), 0.6, None));
        others.push(slip(30.0, elliptic, -0.4, Some(500.0)));
    }
    [keep, others]
}

#[test]
fn back_and_forth_is_where_it_was() {
    for motion in motions().concat() {
        let mut most = 0.0_f64;
        for k in 0..300 {
            let p = place(k);
            let moved = motion.forward(p);
            assert!(motion.inverse(moved).distance(p) < 1e-9, "{motion:?} {p}");
            assert!(
                motion.forward(motion.inverse(p)).distance(p) < 1e-9,
                "{motion:?} {p}"
            );
            most = most.max(moved.distance(p));
        }
        assert!(most > 1.0, "{motion:?} moves nothing");
    }
}

fn jacobian(motion: &Motion, p: DVec3) -> f64 {
    let step = 1e-3;
    let along = |axis: DVec3| {
        (motion.forward(p + step * axis) - motion.forward(p - step * axis)) / (2.0 * step)
    };
    DMat3::from_cols(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).determinant()
}

#[test]
fn slip_over_graphs_folds_tilts_and_shear_keep_volumes() {
    let [keep, others] = motions();
    for motion in keep {
        // Median: a place may lie on a kink of the second derivative.
        let mut off: Vec<f64> = (0..99)
            .map(|k| (jacobian(&motion, place(k)) - 1.0).abs())
            .collect();
        off.sort_by(f64::total_cmp);
        assert!(
            off[90] < 1e-6 && off[98] < 1e-3,
            "{motion:?}: {} {}",
            off[90],
            off[98]
        );
    }
    // What dies out along the slip does not.
    assert!(
        others
            .iter()
            .any(|motion| (jacobian(motion, DVec3::new(100.0, 90.0, -120.0)) - 1.0).abs() > 1e-3)
    );
}

#[test]
fn a_fault_that_is_a_graph_maps_onto_itself() {
    for surface in faults() {
        for shear in [0.0, 20.0, -10.0] {
            let design = HeaveDesign {
                surface: Arc::clone(&surface),
                azimuth: None,
                heave: Variation::constant(37.0),
                shear: f64::to_radians(shear),
                within: [LOW, HIGH],
            };
            let motion = design.build().unwrap();
            for k in 0..200 {
                let p = place(k);
                let p = p.with_z(surface.height(p.truncate()).unwrap());
                let moved = motion.forward(p);
                let height = surface.height(moved.truncate()).unwrap();
                assert!(
                    (moved.z - height).abs() < 1e-9,
                    "{shear} {p} {moved} {height}"
                );
                assert!(moved.distance(p) > 30.0);
            }
        }
    }
}

#[test]
fn on_a_plane_a_heave_is_a_translation_down_dip() {
    let plane = Arc::new(FaultSurface::planar(DVec3::new(5.0, 6.0, 7.0), DIP, 0.4).unwrap());
    let motion = heave(Arc::clone(&plane), Variation::constant(30.0), 0.0);
    let by = motion.shift().unwrap();
    let wanted = plane.slip(60.0, -FRAC_PI_2).unwrap();
    assert!(by.distance(wanted) < 1e-12, "{by} {wanted}");
    // By inclined shear, too; the heave counts along the shear lines.
    let inclined = heave(Arc::clone(&plane), Variation::constant(30.0), 20.0);
    let by = inclined.shift().unwrap();
    assert!(by.normalize().distance(wanted.normalize()) < 1e-12);
    // A shear line at ξ meets the plane at z = −tan δ (ξ + z tan θ): a step of h in ξ is −h tan δ/(1 + tan δ tan θ) down.
    let (tan, lean) = (DIP.tan(), 20_f64.to_radians().tan());
    assert!((by.z + 30.0 * tan / (1.0 + tan * lean)).abs() < 1e-12);
}

#[test]
fn the_rollover_lacks_the_heave_times_the_depth_of_the_detachment() {
    for (surface, tolerance) in [
        (circular(), 1e-6_f64),
        (
            Arc::new(FaultSurface::exponential(DVec3::ZERO, DIP, FRAC_PI_2, DEPTH).unwrap()),
            1e-3,
        ),
    ] {
        for shear in [0.0, 30.0] {
            let h = 60.0;
            let motion = heave(Arc::clone(&surface), Variation::constant(h), shear);
            // The bed at 0 from where it is cut: at first it lies on the fault, there at (0, 0).
            let count = 400_000;
            let reach = 4000.0;
            let at = |k: u32| {
                let x = f64::from(k) / f64::from(count) * reach;
                motion.forward(DVec3::new(x, 0.0, 0.0))
            };
            let mut area = 0.0;
            let mut last = at(0);
            for k in 1..=count {
                let next = at(k);
                area -= 0.5 * (last.z + next.z) * (next.x - last.x);
                last = next;
            }
            // And between the fault and where the bed ends on it.
            let end = at(0).x;
            let steps = 100_000;
            for k in 0..steps {
                let x = (f64::from(k) + 0.5) / f64::from(steps) * end;
                area -= surface.height(DVec2::new(x, 0.0)).unwrap() * end / f64::from(steps);
            }
            assert!(
                (area / (h * DEPTH) - 1.0).abs() < tolerance.max(1e-6),
                "{shear}: {area}"
            );
            // Far away nothing drops: it slides on the level detachment.
            let far = motion.forward(DVec3::new(6000.0, 0.0, -100.0));
            let drop = if tolerance < 1e-4 { 1e-9 } else { 0.2 };
            assert!(
                far.distance(DVec3::new(6000.0 + h, 0.0, -100.0)) < drop,
                "{far}"
            );
        }
    }
}

#[test]
fn heaves_over_one_fault_add() {
    let of = |h: f64| heave(circular(), Variation::constant(h), 0.0);
    let steps = Motions::from(of(10.0)).then(of(15.0)).then(of(20.0));
    for k in 0..200 {
        let p = place(k);
        assert!(steps.forward(p).distance(of(45.0).forward(p)) < 1e-11);
    }
}

/// Two faults that dip 60° towards each other, A older than B: both hanging walls go down.
#[test]
fn of_a_conjugate_pair_the_four_blocks_lie_as_the_throws_say() {
    let plane = |x: f64, azimuth: f64| {
        FaultSurface::planar(DVec3::new(x, 0.0, -50.0), DIP, azimuth).unwrap()
    };
    let (a, b) = (plane(-30.0, FRAC_PI_2), plane(30.0, 3.0 * FRAC_PI_2));
    let (slip_a, slip_b) = (20.0, 12.0);
    let of = |fault: &FaultSurface, slip| fault.slip(slip, -FRAC_PI_2).unwrap();
    let (u_a, u_b) = (of(&a, slip_a), of(&b, slip_b));
    assert!((u_a.z + slip_a * DIP.sin()).abs() < 1e-12);
    let block = |on_a: bool, on_b: bool| {
        let mut motions = Motions::none();
        if on_a {
            motions = motions.then(Motion::Shift(u_a));
        }
        if on_b {
            motions = motions.then(Motion::Shift(u_b));
        }
        motions
    };
    let [t_a, t_b] = [slip_a, slip_b].map(|slip| slip * DIP.sin());
    for (on_a, on_b, wanted) in [
        (false, false, -50.0),
        (true, false, -50.0 - t_a),
        (false, true, -50.0 - t_b),
        (true, true, -50.0 - t_a - t_b),
    ] {
        let moved = block(on_a, on_b).forward(DVec3::new(1.0, 2.0, -50.0));
        assert!((moved.z - wanted).abs() < 1e-12);
    }
    // By brute force: of columns, back through both faults. They cross 52 m below where they begin: what is in both footwalls lies deeper.
    let unmoved = |p: DVec3| {
        let q = if b.is_above(p) { p - u_b } else { p };
        if a.is_above(q) { q - u_a } else { q }
    };
    let mut counts = [0; 4];
    for bed in [-50.0, -150.0] {
        for (k, drop) in [0.0, t_a, t_b, t_a + t_b].into_iter().enumerate() {
            for x in 0..240 {
                let p = DVec3::new(f64::from(x) - 119.3, 0.0, bed - drop);
                counts[k] += u32::from((unmoved(p).z - bed).abs() < 1e-9);
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
    // Fault A is offset across B by −D_B sin(δ_A + δ_B), normal to itself.
    let offset = a.normal(DVec3::ZERO).dot(u_b);
    assert!(
        (offset + slip_b * (2.0 * DIP).sin()).abs() < 1e-12,
        "{offset}"
    );
}

#[test]
fn a_recumbent_pair_turns_level_beds_over() {
    let (alpha, height, k) = (8_f64.to_radians(), 60.0, 15.0);
    let shape = FoldShape::pair(height, alpha, k);
    let FoldShape::Pair { step, width } = shape else {
        unreachable!()
    };
    assert!(
        (step - 431.1).abs() < 0.1 && (width - 43.1).abs() < 0.1,
        "{step} {width}"
    );
    // It verges east: the axial planes dip west.
    let design = FoldDesign {
        through: DVec3::ZERO,
        azimuth: 3.0 * FRAC_PI_2,
        axial_dip: alpha,
        plunge: 0.0,
        shape,
    };
    let fold = design.build().unwrap();
    let count = 400_000;
    let line: Vec<DVec3> = (0..=count)
        .map(|k| {
            fold.forward(DVec3::new(
                f64::from(k) / f64::from(count) * 3000.0 - 1500.0,
                7.0,
                0.0,
            ))
        })
        .collect();
    // Level tails, the one in the west, behind the fold, higher.
    assert!((line[0].z - height).abs() < 1e-9 && line[line.len() - 1].z.abs() < 1e-9);
    let mut turning = 0.0_f64;
    let mut angle = 0.0_f64;
    for pair in line.windows(3) {
        let (one, other) = (
            (pair[1] - pair[0]).truncate(),
            (pair[2] - pair[1]).truncate(),
        );
        assert_eq!((one.y, other.y), (0.0, 0.0));
        let (one, other) = (pair[1] - pair[0], pair[2] - pair[1]);
        angle += (one.x * other.z - one.z * other.x).atan2(one.x * other.x + one.z * other.z);
        turning = turning.max(angle.abs());
    }
    let (sin, cos) = alpha.sin_cos();
    let wanted = PI - (k * sin * sin / (k * sin * cos - 1.0)).atan();
    assert!((turning - wanted).abs() < 1e-4, "{}", turning.to_degrees());
    assert!((turning.to_degrees() - 164.8).abs() < 0.05);
    // The nappe lies over its foreland by 158 m.
    let backwards = |pair: &[DVec3]| pair[1].x < pair[0].x;
    let first = line.windows(2).position(backwards).unwrap();
    let last = line.windows(2).rposition(backwards).unwrap();
    let overlap = line[first].x - line[last].x;
    assert!((overlap - 158.0).abs() < 0.5, "{overlap}");
}

#[test]
fn upright_trains_dip_by_their_slope_and_move_nothing_in_plan() {
    let shape = FoldShape::Train {
        amplitude: 30.0,
        wavelength: 200.0,
        phase: 0.0,
    };
    let design = FoldDesign {
        through: DVec3::ZERO,
        azimuth: FRAC_PI_2,
        axial_dip: FRAC_PI_2,
        plunge: 0.0,
        shape,
    };
    let fold = design.build().unwrap();
    assert!(fold.keeps_uprights() && fold.plan_shift() == Some(DVec2::ZERO));
    for k in 0..100 {
        let p = place(k);
        let moved = fold.forward(p);
        assert_eq!(moved.truncate(), p.truncate());
        assert!((moved.z - p.z - 30.0 * (PI * p.x / 100.0).sin()).abs() < 1e-11);
    }
    let slope = (fold.forward(DVec3::X * 1e-4) - fold.forward(DVec3::ZERO)).z / 1e-4;
    assert!((slope - shape.steepest()).abs() < 1e-6);
}

#[test]
fn the_axis_of_a_plunging_fold_plunges() {
    let (alpha, plunge) = (70_f64.to_radians(), 20_f64.to_radians());
    let shape = FoldShape::Pair {
        step: 10.0,
        width: 40.0,
    };
    let design = FoldDesign {
        through: DVec3::ZERO,
        azimuth: 0.3,
        axial_dip: alpha,
        plunge,
        shape,
    };
    let fold = design.build().unwrap();
    // Places far up the axial normal move by all of the step, along the direction that is across the axis in the axial plane.
    let across = DVec3::new(
        0.3_f64.sin() * alpha.sin(),
        0.3_f64.cos() * alpha.sin(),
        alpha.cos(),
    );
    let along = (fold.forward(100.0 * across) - 100.0 * across) / 10.0;
    assert!((along.length() - 1.0).abs() < 1e-12 && along.dot(across).abs() < 1e-12);
    let axis = along.cross(across);
    assert!((axis.z.abs() - plunge.sin()).abs() < 1e-12, "{axis}");
}

#[test]
fn displacement_on_a_plane_is_what_its_law_says() {
    let through = DVec3::new(4.0, -3.0, -20.0);
    let plane = Arc::new(FaultSurface::planar(through, DIP, FRAC_PI_2).unwrap());
    let design = SlipDesign {
        surface: Arc::clone(&plane),
        rake: -FRAC_PI_2,
        displacement: Displacement::Elliptic {
            most: 50.0,
            centre: [0.0, 0.0],
            semi_axes: [2000.0, 900.0],
            law: Law::WalshWatterson,
        },
        share: 1.0,
        reach: None,
    };
    let slip = design.clone().build().unwrap();
    let (down, strike) = (plane.down_dip().unwrap(), plane.strike().extend(0.0));
    for (s, q) in [
        (0.0, 0.0),
        (600.0, 0.0),
        (-300.0, 400.0),
        (1100.0, -500.0),
        (2100.0, 0.0),
    ] {
        let p = through + s * strike + q * down;
        let r = f64::hypot(s / 2000.0, q / 900.0);
        // The other form of the law.
        let wanted = if r < 1.0 {
            2.0 * 50.0 * (f64::midpoint(1.0, r).powi(2) - r * r).sqrt() * (1.0 - r)
        } else {
            0.0
        };
        let moved = slip.forward(p) - p;
        assert!((moved.length() - wanted).abs() < 1e-12 * 50.0, "{s} {q}");
        assert!((moved.z + wanted * DIP.sin()).abs() < 1e-11);
        assert!(plane.normal(p).dot(moved).abs() < 1e-12);
    }
    // Laws are as steep as they say.
    for law in [Law::WalshWatterson, Law::Linear, Law::Bell] {
        let steepest = (0..100_000)
            .map(|k| (law.value(f64::from(k) * 1e-5) - law.value(f64::from(k + 1) * 1e-5)) * 1e5)
            .fold(0.0, f64::max);
        assert!(
            (steepest - law.steepest()).abs() < 1e-4,
            "{law:?} {steepest}"
        );
    }
    // D·max|D′|/l = 50 × 1.3625/68 > 1.
    let short = SlipDesign {
        displacement: Displacement::Elliptic {
            most: 50.0,
            centre: [0.0, 0.0],
            semi_axes: [2000.0, 68.0],
            law: Law::WalshWatterson,
        },
        ..design
    };
    let error = short.build().unwrap_err();
    assert!(matches!(error, MotionError::Folds { gradient } if (gradient - 1.0018).abs() < 1e-3));
}

#[test]
fn places_come_from_the_box_that_is_told() {
    for motion in motions().concat() {
        let (low, high) = (LOW * 0.3, HIGH * 0.4);
        let [from, to] = motion.before([low, high]);
        for k in 0..500 {
            let unit = (place(k) - LOW) / (HIGH - LOW);
            let was = motion.inverse(low + (high - low) * unit);
            assert!(was.cmpge(from).all() && was.cmple(to).all(), "{motion:?}");
        }
    }
}

#[test]
fn translations_add_up_and_none_is_left_out() {
    let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 0.5, 1.0));
    let both = Motions::from(Motion::Shift(a)).then(Motion::Shift(b));
    assert_eq!(both.shift(), Some(a + b));
    assert_eq!(both.all().len(), 1);
    let back = both.then(Motion::Shift(-(a + b)));
    assert!(back.is_none() && back == Motions::none());
    let fold = motions()[0]
        .iter()
        .find(|m| !m.is_affine())
        .unwrap()
        .clone();
    let mixed = Motions::from(Motion::Shift(a))
        .then(fold.clone())
        .then(Motion::Shift(b));
    assert_eq!((mixed.shift(), mixed.is_affine()), (None, false));
    for k in 0..50 {
        let p = place(k);
        assert_eq!(mixed.forward(p), fold.forward(p + a) + b);
        assert!(mixed.inverse(mixed.forward(p)).distance(p) < 1e-9);
    }
}

#[test]
fn what_cannot_be_is_refused_with_its_number() {
    let upright = Arc::new(FaultSurface::planar(DVec3::ZERO, FRAC_PI_2, 0.0).unwrap());
    let design = HeaveDesign {
        surface: upright,
        azimuth: None,
        heave: Variation::constant(5.0),
        shear: 0.0,
        within: [LOW, HIGH],
    };
    assert_eq!(design.clone().build(), Err(MotionError::Upright));
    // Synthetic shear, along a fault of 60°.
    let along = HeaveDesign {
        surface: circular(),
        shear: -PI / 6.0 - 0.01,
        ..design
    };
    assert!(matches!(along.build(), Err(MotionError::Shear { .. })));
    let bent = SlipDesign {
        surface: circular(),
        rake: 0.0,
        displacement: Displacement::AlongStrike(Variation::constant(1.0)),
        share: 1.0,
        reach: None,
    };
    assert_eq!(bent.build(), Err(MotionError::NotPlane));
    let level = FoldDesign {
        through: DVec3::ZERO,
        azimuth: 0.0,
        axial_dip: 0.0,
        plunge: 0.0,
        shape: FoldShape::Pair {
            step: 1.0,
            width: 1.0,
        },
    };
    assert!(matches!(level.build(), Err(MotionError::AxialDip { .. })));
    let steep = FoldDesign {
        axial_dip: 0.2,
        plunge: 0.3,
        ..level
    };
    assert!(matches!(steep.build(), Err(MotionError::Plunge { .. })));
}
