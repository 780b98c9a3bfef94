#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use super::*;
use crate::features::reach::tests::{along, design, meander};
use crate::features::trajectory::Trajectory;
use crate::nurbs::quadrature;

/// As wide as the channel, a tenth of its depth high, three tenths of it deep.
fn levee() -> LeveeDesign {
    LeveeDesign {
        width: Profile::Constant(50.0),
        height: Profile::Constant(0.44),
        depth: Profile::Constant(1.32),
        taper: 2,
        toe: 0.3,
        bend_asymmetry: 0.0,
        thinning: 0.0,
    }
}

fn straight() -> Reach {
    let line = Trajectory::line(DVec2::ZERO, DVec2::new(400.0, 0.0)).unwrap();
    along(design(), line).1
}

fn part(bank: Bank, number: usize, ends: [f64; 2]) -> LeveePart {
    LeveePart { bank, number, ends }
}

#[test]
fn the_section_outside_of_the_crest_has_the_area_of_the_closed_form() {
    let reach = straight();
    for (bank, side) in [(Bank::Left, 1.0), (Bank::Right, -1.0)] {
        let own = part(bank, 0, [0.0, 400.0]);
        let shell = levee().build(&reach, &own).unwrap().unwrap();
        let (top, base) = (
            shell.sheet(Role::Top).unwrap(),
            shell.sheet(Role::Base).unwrap(),
        );
        let sink = -5.0 - top.point(1.0, 0.5).z;
        assert!((0.0..=0.02 * 1.32).contains(&sink));
        // The crest 1 m outside of the rim at y = ±25, the toe 50 m farther.
        let [crest, toe] = [0.0, 1.0].map(|u| top.point(u, 0.5));
        assert!((side * crest.y - 26.0).abs() < 1e-9 && (crest.z + 4.56).abs() < 1e-9);
        assert!((side * toe.y - 76.0).abs() < 1e-9);
        let mut above = 0.0;
        for (u, w) in quadrature::between(quadrature::EIGHT, 0.0, 1.0) {
            let d = top.derivatives(u, 0.5, 1);
            above += w * (d[0][0].z - toe.z) * d[1][0].y.abs();
        }
        // (1 − t)/3 + t/2 of height times width above the toe.
        assert!((above - 50.0 * (0.44 + sink) * 0.383_333_333).abs() < 1e-6);
        // The base is straight: h_b below the channel's top under the crest.
        let under = base.closest(crest.with_z(-6.32), 1e-9).point;
        assert!(under.distance(crest.with_z(-6.32)) < 1e-6, "{under}");
        assert!(shell.contains(crest.with_z(-6.31)) && !shell.contains(crest.with_z(-6.33)));
    }
}

#[test]
fn the_area_above_the_toe_follows_the_taper() {
    let reach = straight();
    for (taper, toe) in [(1, 0.3), (3, 0.3), (4, 0.0), (5, 1.0)] {
        let levee = LeveeDesign {
            taper,
            toe,
            ..levee()
        };
        let own = part(Bank::Left, 0, [0.0, 400.0]);
        let shell = levee.build(&reach, &own).unwrap().unwrap();
        let top = shell.sheet(Role::Top).unwrap();
        let [crest, end] = [0.0, 1.0].map(|u| top.point(u, 0.5));
        let mut above = 0.0;
        for (u, w) in quadrature::between(quadrature::EIGHT, 0.0, 1.0) {
            let d = top.derivatives(u, 0.5, 1);
            above += w * (d[0][0].z - end.z) * d[1][0].y.abs();
        }
        let mean = (1.0 - toe) / (taper as f64 + 1.0) + toe / 2.0;
        let wanted = 50.0 * (crest.z - end.z) * mean;
        assert!(
            (above - wanted).abs() < 1e-9,
            "{taper} {toe}: {above} {wanted}"
        );
    }
}

#[test]
fn the_inner_side_passes_the_channels_top_inside_of_the_rim() {
    let shell = levee().build(&straight(), &part(Bank::Right, 0, [0.0, 400.0]));
    let shell = shell.unwrap().unwrap();
    let at = |y: f64, z: f64| shell.contains(DVec2::new(200.0, -y).extend(z));
    assert!(at(24.1, -5.0) && !at(23.9, -5.0));
    // The channel's bank is below the levee's root there.
    assert!(at(20.3, -6.4) && !at(20.1, -6.4));
}

#[test]
fn on_an_inner_bank_the_width_follows_the_law_and_on_an_outer_one_the_asymmetry() {
    let arc = |t: f64| 95.6 * DVec2::from_angle(t);
    // Turns left.
    let (_, reach) = along(design(), Trajectory::parametric(&arc, [0.0, 2.0]).unwrap());
    let mut wide = levee();
    wide.width = Profile::Constant(100.0);
    wide.bend_asymmetry = 0.3;
    let width = |bank: Bank| {
        let own = part(bank, 0, [0.0, reach.trajectory().length()]);
        let shell = wide.build(&reach, &own).unwrap().unwrap();
        let top = shell.sheet(Role::Top).unwrap();
        top.point(0.0, 0.5).distance(top.point(1.0, 0.5))
    };
    // The law starts from the asymmetric width: 70 m on the inner bank.
    let law = (95.0_f64.powi(-4) + (1.0 / 95.6 / 0.8_f64).powi(4)).powf(-0.25) - 25.0;
    assert!(
        (width(Bank::Left) - law).abs() < 0.3,
        "{}",
        width(Bank::Left)
    );
    assert!((law + 25.0) / 95.6 < 0.8);
    assert!(
        (width(Bank::Right) - 130.0).abs() < 0.3,
        "{}",
        width(Bank::Right)
    );
    // Without asymmetry the figure of the law for 100 m.
    wide.bend_asymmetry = 0.0;
    let own = part(Bank::Left, 0, [0.0, reach.trajectory().length()]);
    let shell = wide.build(&reach, &own).unwrap().unwrap();
    let top = shell.sheet(Role::Top).unwrap();
    let width = top.point(0.0, 0.5).distance(top.point(1.0, 0.5));
    assert!((width - 48.9).abs() < 0.3, "{width}");
}

#[test]
fn where_a_bend_leaves_no_room_there_is_no_levee() {
    let arc = |t: f64| 33.0 * DVec2::from_angle(t);
    let (_, reach) = along(design(), Trajectory::parametric(&arc, [0.0, 2.0]).unwrap());
    let ends = [0.0, reach.trajectory().length()];
    assert!(
        levee()
            .build(&reach, &part(Bank::Left, 0, ends))
            .unwrap()
            .is_none()
    );
    assert!(
        levee()
            .build(&reach, &part(Bank::Right, 0, ends))
            .unwrap()
            .is_some()
    );
}

#[test]
fn at_a_neck_a_levee_is_narrower_than_along_half_of_the_bend() {
    // Most of a circle to the left: its ends are 124 m apart, and lie on each other's inner side.
    let arc = |t: f64| 120.0 * DVec2::from_angle(t);
    let (_, reach) = along(design(), Trajectory::parametric(&arc, [0.0, 5.2]).unwrap());
    let length = reach.trajectory().length();
    // How far from the channel's axis its toe is where it begins.
    let reaches = [length, 0.5 * length].map(|to| {
        let built = levee().build(&reach, &part(Bank::Left, 0, [0.0, to]));
        let shell = built.unwrap().unwrap();
        let top = shell.sheet(Role::Top).unwrap();
        let (toe, start) = (top.knots_u().domain().1, top.knots_v().domain().0);
        120.0 - top.point(toe, start).truncate().length()
    });
    // Half of the bend is as wide as the law says, 69.5 m and the crest's way from the rim; twice that is more than the ends are apart.
    assert!((reaches[1] - 70.5).abs() < 0.3, "{reaches:?}");
    assert!(reaches[0] > 52.0 && reaches[0] < 67.0, "{reaches:?}");
}

#[test]
fn bodies_of_neighbouring_bends_overlap_and_lie_within_each_other() {
    let (_, reach) = along(design(), meander());
    let own = parts(&reach, Bank::Left, 0.3);
    assert_eq!(own.len(), 4);
    assert_eq!(
        (own[0].ends[0], own[3].ends[1]),
        (0.0, reach.trajectory().length())
    );
    let shells: Vec<Shell> = own
        .iter()
        .map(|one| levee().build(&reach, one).unwrap().unwrap())
        .collect();
    for (k, pair) in own.windows(2).enumerate() {
        assert_eq!(pair[0].ends[1], pair[1].ends[0]);
        let (larger, smaller) = if k % 2 == 0 { (k, k + 1) } else { (k + 1, k) };
        let place = reach.trajectory().at(pair[0].ends[1]);
        let mut held = [0; 2];
        for x in 0..400 {
            for z in -40..10 {
                let across = -20.0 - f64::from(x) * 0.2;
                let at = (place.point + place.right() * across).extend(-5.0 + f64::from(z) * 0.047);
                // In the channel, which takes what is there, they need not.
                if across < -25.5 && shells[smaller].contains(at) {
                    assert!(shells[larger].contains(at), "{across} {z}");
                    held[1] += 1;
                }
                held[0] += usize::from(shells[larger].contains(at));
            }
        }
        assert!(held[1] > 500 && held[0] > held[1], "{held:?}");
    }
    // No two toes are at one level.
    let mut toes: Vec<f64> = [Bank::Left, Bank::Right]
        .into_iter()
        .flat_map(|bank| parts(&reach, bank, 0.3))
        .map(|one| {
            let shell = levee().build(&reach, &one).unwrap().unwrap();
            shell.sheet(Role::Top).unwrap().point(1.0, 0.5).z
        })
        .collect();
    toes.sort_by(f64::total_cmp);
    assert!(
        toes.windows(2).all(|pair| pair[1] - pair[0] > 2e-4),
        "{toes:?}"
    );
}

#[test]
fn levees_that_cannot_be_are_refused() {
    let reach = straight();
    let with = |change: &dyn Fn(&mut LeveeDesign)| {
        let mut design = levee();
        change(&mut design);
        design.build(&reach, &part(Bank::Left, 0, [0.0, 400.0]))
    };
    assert!(with(&|_| {}).is_ok());
    assert!(with(&|one| one.taper = 0).is_err());
    assert!(with(&|one| one.taper = 6).is_err());
    assert!(with(&|one| one.toe = 1.2).is_err());
    assert!(with(&|one| one.thinning = f64::NAN).is_err());
    assert!(with(&|one| one.height = Profile::Constant(0.0)).is_err());
    let deep = with(&|one| one.depth = Profile::Constant(3.5)).unwrap_err();
    assert!(matches!(deep, LeveeError::Root { .. }), "{deep}");
}
