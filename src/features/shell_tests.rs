#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use super::*;

/// A bowl and a plate below it, both curved along v.
fn tube() -> Tube {
    let (cubic, straight) = (
        KnotVector::uniform(3, 5).unwrap(),
        KnotVector::uniform(1, 2).unwrap(),
    );
    let along = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.3, 1.0, 1.0, 1.0, 1.0]).unwrap();
    let row = |x: f64, z: f64| {
        (0..5).map(move |j| {
            let y = f64::from(j);
            DVec3::new(x + 0.1 * y * y, 3.0 * y, z + 0.05 * y)
        })
    };
    let heights = [0.0, -1.0, -1.3, -1.1, 0.2];
    let net = heights
        .iter()
        .zip(0..)
        .flat_map(|(z, i)| row(f64::from(i), *z))
        .collect();
    let bowl = Surface::new(cubic, along.clone(), net).unwrap();
    let net = row(0.0, -3.0).chain(row(4.0, -3.0)).collect();
    let plate = Surface::new(straight, along, net).unwrap();
    Tube {
        sheets: [bowl, plate],
        roles: [Role::Top, Role::Hidden],
        sides: [Role::Hidden; 2],
    }
}

#[test]
fn a_tube_is_closed_and_its_edges_are_its_sheets_own() {
    let tube = tube();
    let shell = tube.close().unwrap();
    assert_eq!(shell.sheets().len(), 6);
    let edges = [
        (2, tube.sheets[0].isocurve_u(0.0)),
        (3, tube.sheets[0].isocurve_u(1.0)),
        (4, tube.sheets[0].isocurve_v(0.0)),
        (5, tube.sheets[0].isocurve_v(1.0)),
    ];
    for (sheet, edge) in edges {
        let own = shell.sheets()[sheet].1.net();
        assert_eq!(&own[..edge.points().len()], edge.points());
    }
    let on = tube.sheets[0].point(0.4, 0.6);
    assert!(shell.contains(on - 1e-6 * DVec3::Z) && !shell.contains(on + 1e-6 * DVec3::Z));
}

#[test]
fn a_continued_tube_is_what_it_was_and_goes_on_straight() {
    let (old, new) = (tube(), tube().continued([0.2, 0.0]).unwrap());
    assert_eq!(new.sheets[0].knots_v().domain(), (-0.2, 1.0));
    let new = new.continued([0.0, 0.1]).unwrap();
    assert_eq!(new.sheets[1].knots_v().domain(), (-0.2, 1.1));
    for (old, new) in old.sheets.iter().zip(&new.sheets) {
        for k in 0..=20 {
            let (u, v) = (f64::from(k * 7 % 21) / 20.0, f64::from(k) / 20.0);
            assert!(old.point(u, v).distance(new.point(u, v)) < 1e-13);
            for (at, beyond) in [(0.0, -0.15), (1.0, 1.07)] {
                let d = old.derivatives(u, at, 1);
                let straight = d[0][0] + (beyond - at) * d[0][1];
                assert!(new.point(u, beyond).distance(straight) < 1e-12);
            }
        }
    }
    assert!(new.close().is_ok());
}

#[test]
fn sheets_that_leave_a_gap_are_refused() {
    let mut sheets = tube().close().unwrap().sheets().to_vec();
    sheets.pop();
    assert!(matches!(Shell::new(sheets), Err(ShellError::Open(_))));
}
