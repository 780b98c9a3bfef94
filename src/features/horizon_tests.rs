#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use super::*;

const LOW: DVec3 = DVec3::new(0.0, 0.0, -30.0);
const HIGH: DVec3 = DVec3::new(366.0, 671.0, 0.0);

fn hills(x: f64, y: f64) -> f64 {
    -20.0 + 2.0 * (x / 90.0).sin() * (y / 130.0).cos() + 0.004 * x
}

fn hilly_grid() -> (Horizon, Vec<DVec3>) {
    let (nx, ny) = (9, 12);
    // West and south of the domain's corner to inside it, so that both ends of the data lie within the plan or beyond.
    let (x, y) = ([-50.0, 300.0], [40.0, 900.0]);
    let at = |range: [f64; 2], k: usize, n: usize| {
        range[0] + (range[1] - range[0]) * k as f64 / (n - 1) as f64
    };
    let mut nodes = Vec::new();
    let rows: Vec<Vec<f64>> = (0..ny)
        .map(|j| {
            let node = |i| (at(x, i, nx), at(y, j, ny));
            nodes.extend(
                (0..nx).map(|i| DVec3::new(node(i).0, node(i).1, hills(node(i).0, node(i).1))),
            );
            (0..nx).map(|i| hills(node(i).0, node(i).1)).collect()
        })
        .collect();
    (Horizon::grid(x, y, &rows).unwrap(), nodes)
}

#[test]
fn a_grid_is_exact_at_its_nodes_and_near_a_smooth_function_between_them() {
    let (horizon, nodes) = hilly_grid();
    for node in nodes {
        assert!((horizon.height(node.x, node.y) - node.z).abs() < 1e-12);
    }
    // Bicubic: the error goes with the fourth power of the spacing over the wavelength; bilinear would miss by 0.02 m.
    let miss = (horizon.height(141.0, 510.0) - hills(141.0, 510.0)).abs();
    assert!(miss < 0.005, "{miss}");
}

#[test]
fn rows_of_a_grid_run_from_south_to_north_and_values_from_west_to_east() {
    let rows = vec![vec![1.0, 2.0, 3.0], vec![11.0, 12.0, 13.0]];
    let horizon = Horizon::grid([0.0, 20.0], [0.0, 10.0], &rows).unwrap();
    assert!((horizon.height(20.0, 0.0) - 3.0).abs() < 1e-12);
    assert!((horizon.height(0.0, 10.0) - 11.0).abs() < 1e-12);
}

#[test]
fn a_grid_of_a_plane_is_that_plane_everywhere_and_a_grid_of_one_height_is_level() {
    let plane = |x: f64, y: f64| -12.0 + 0.03 * x - 0.01 * y;
    for [nx, ny] in [[2, 2], [3, 2], [4, 7], [5, 5]] {
        let rows: Vec<Vec<f64>> = (0..ny)
            .map(|j| {
                (0..nx)
                    .map(|i| plane(100.0 + 40.0 * f64::from(i), 30.0 * f64::from(j)))
                    .collect()
            })
            .collect();
        let x = [100.0, 100.0 + 40.0 * f64::from(nx - 1)];
        let horizon = Horizon::grid(x, [0.0, 30.0 * f64::from(ny - 1)], &rows).unwrap();
        for (x, y) in [(-300.0, 500.0), (117.0, 31.0), (1000.0, -1000.0)] {
            assert!((horizon.height(x, y) - plane(x, y)).abs() < 1e-10);
        }
        assert_eq!(horizon.level(), None);
    }
    let level = Horizon::grid([0.0, 1.0], [0.0, 1.0], &vec![vec![-7.5; 3]; 3]).unwrap();
    assert_eq!(level.level(), Some(-7.5));
}

#[test]
fn a_horizon_dips_down_towards_its_azimuth_by_the_tangent_of_its_dip() {
    let through = DVec3::new(10.0, 20.0, -5.0);
    let east = Horizon::dipping(through, 45_f64.to_radians(), 90_f64.to_radians()).unwrap();
    assert!((east.height(11.0, 25.0) - -6.0).abs() < 1e-12);
    let north = Horizon::dipping(through, 1_f64.to_radians(), 0.0).unwrap();
    assert!((north.height(10.0, 120.0) - (-5.0 - 100.0 * 1_f64.to_radians().tan())).abs() < 1e-12);
    assert_eq!(
        Horizon::dipping(through, 0.0, 1.0).unwrap().level(),
        Some(-5.0)
    );
}

#[test]
fn a_sheet_is_its_horizon_as_a_graph_over_more_than_the_plan() {
    let dipping = Horizon::dipping(DVec3::new(0.0, 0.0, -9.0), 0.02, 2.0).unwrap();
    for horizon in [hilly_grid().0, dipping, Horizon::flat(-21.3).unwrap()] {
        let sheet = horizon.sheet(LOW, HIGH).unwrap();
        let margin = OVERSHOOT * (HIGH - LOW);
        for i in 0..=37 {
            for j in 0..=41 {
                let (u, v) = (f64::from(i) / 37.0, f64::from(j) / 41.0);
                let point = sheet.point(u, v);
                let x = LOW.x - margin.x + u * 1.1 * (HIGH.x - LOW.x);
                let y = LOW.y - margin.y + v * 1.1 * (HIGH.y - LOW.y);
                assert!((point.x - x).abs() < 1e-9 && (point.y - y).abs() < 1e-9);
                assert!((point.z - horizon.height(point.x, point.y)).abs() < 1e-11);
            }
        }
        let (least, most) = horizon.range(LOW, HIGH).unwrap();
        let heights = (0..=50).flat_map(|i| {
            let x = LOW.x + (HIGH.x - LOW.x) * f64::from(i) / 50.0;
            let horizon = &horizon;
            (0..=50).map(move |j| horizon.height(x, HIGH.y * f64::from(j) / 50.0))
        });
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (low.min(z), high.max(z))
        });
        assert!(least <= low + 1e-12 && most >= high - 1e-12);
        assert!(most - least <= 1.3 * (high - low) + 1e-12);
    }
}

#[test]
fn a_horizon_goes_on_straight_and_without_a_kink_beyond_its_grid() {
    let (horizon, _) = hilly_grid();
    let at = |x: f64| horizon.height(x, 333.0);
    // The eastern border of the data is x = 300.
    let slope = (at(300.0) - at(299.999)) / 0.001;
    for x in [310.0, 400.0, 900.0] {
        assert!((at(x) - (at(300.0) + slope * (x - 300.0))).abs() < 1e-5 * (x - 300.0));
    }
}

#[test]
fn scattered_points_are_met_within_the_tolerance_by_a_surface_that_does_not_swing_between_them() {
    // Points of a golden-ratio sequence, so that none are in rows.
    let points: Vec<DVec3> = (0..150)
        .map(|k| {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let (x, y) = (366.0 * part(0.754_877_666), 671.0 * part(0.569_840_291));
            DVec3::new(x, y, hills(x, y))
        })
        .collect();
    let horizon = Horizon::points(&points, 0.05).unwrap();
    for p in &points {
        assert!((horizon.height(p.x, p.y) - p.z).abs() <= 0.05);
    }
    for (x, y) in [(180.0, 300.0), (90.0, 500.0), (250.0, 120.0)] {
        assert!((horizon.height(x, y) - hills(x, y)).abs() < 0.2);
    }
}

#[test]
fn points_of_a_plane_give_the_plane_and_points_on_a_line_do_not_tilt_it_across() {
    let plane: Vec<DVec3> = [(0.0, 0.0), (10.0, 0.0), (3.0, 8.0), (7.0, 5.0)]
        .map(|(x, y)| DVec3::new(x, y, 1.0 + 0.1 * x - 0.2 * y))
        .to_vec();
    let horizon = Horizon::points(&plane, 1e-9).unwrap();
    assert!((horizon.height(100.0, 100.0) - (1.0 + 10.0 - 20.0)).abs() < 1e-9);
    let line = [DVec3::new(0.0, 0.0, 0.0), DVec3::new(10.0, 10.0, 2.0)];
    let horizon = Horizon::points(&line, 1e-9).unwrap();
    assert!((horizon.height(5.0, 5.0) - 1.0).abs() < 1e-9);
    assert!((horizon.height(10.0, 0.0) - 1.0).abs() < 1e-9);
    assert_eq!(Horizon::points(&line[..1], 0.1).unwrap().level(), Some(0.0));
}

#[test]
fn points_above_one_another_are_refused_with_what_was_reached() {
    let mut points: Vec<DVec3> = (0..20)
        .map(|k| DVec3::new(f64::from(k % 5), f64::from(k / 5), 0.0))
        .collect();
    points.push(DVec3::new(2.0, 2.0, 1.0));
    match Horizon::points(&points, 0.1) {
        Err(HorizonError::Unreached { reached, point, .. }) => {
            assert!((0.5 - 1e-9..0.7).contains(&reached), "{reached}");
            assert_eq!(point.truncate(), DVec2::new(2.0, 2.0));
        }
        other => assert!(other.is_err(), "{other:?}"),
    }
}

#[test]
fn numbers_that_make_no_horizon_are_refused() {
    assert!(matches!(
        Horizon::flat(f64::NAN),
        Err(HorizonError::Number { .. })
    ));
    assert!(matches!(
        Horizon::dipping(DVec3::ZERO, 90_f64.to_radians(), 0.0),
        Err(HorizonError::Dip { .. })
    ));
    let ragged = [vec![0.0; 3], vec![0.0; 2]];
    assert!(matches!(
        Horizon::grid([0.0, 1.0], [0.0, 1.0], &ragged),
        Err(HorizonError::Ragged {
            row: 1,
            found: 2,
            needed: 3
        })
    ));
    let short = [vec![0.0; 3]];
    assert!(matches!(
        Horizon::grid([0.0, 1.0], [0.0, 1.0], &short),
        Err(HorizonError::Lattice(LatticeError::Count { .. }))
    ));
    assert!(matches!(
        Horizon::grid([1.0, 0.0], [0.0, 1.0], &vec![vec![0.0; 2]; 2]),
        Err(HorizonError::Lattice(LatticeError::Extent { .. }))
    ));
    assert!(matches!(
        Horizon::points(&[], 0.1),
        Err(HorizonError::NoPoints)
    ));
    assert!(matches!(
        Horizon::points(&[DVec3::ZERO], 0.0),
        Err(HorizonError::Tolerance(_))
    ));
    let flat = Horizon::flat(0.0).unwrap();
    assert!(matches!(
        flat.sheet(HIGH, LOW),
        Err(HorizonError::Plan { .. })
    ));
}
