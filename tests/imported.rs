//! Solids of other programs: a salt dome and a cavern that build123d made, their volumes in closed form, what the point evaluator says
//! of them, placements, rules, and what the files say.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::f64::consts::PI;

use assembled::{Built, checked, source};
use clinothem::assembly::{AssemblyError, Engine};
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::{DVec2, DVec3, Vec3Swizzles};

const MIDDLE: DVec2 = DVec2::new(2000.0, 2000.0);
/// In the salt.
const CAVERN: DVec3 = DVec3::new(2250.0, 1900.0, -1500.0);

/// Radius of the dome at an elevation (m); nothing above it.
fn radius(z: f64) -> f64 {
    if z < -1800.0 {
        return 600.0;
    }
    let s = (z + 1400.0) / 500.0;
    1000.0 * (1.0 - s * s).max(0.0).sqrt()
}

/// The volume that holds a point of the model, by its README.
fn expected(p: DVec3) -> &'static str {
    let own = (p - CAVERN).abs();
    let wide = 40.0 * ((130.0 - own.z) / 30.0).clamp(0.0, 1.0);
    let shale = -2400.0 - (p.x - 2000.0) * 5.0_f64.to_radians().tan();
    if p.z > -700.0 {
        "cover"
    } else if own.xy().length() < wide {
        "salt/cavern"
    } else if p.xy().distance(MIDDLE) < radius(p.z) {
        "salt"
    } else if p.z > -1250.0 {
        "upper-shale"
    } else if p.z > -1600.0 {
        "sand"
    } else if p.z > shale {
        "shale"
    } else {
        "background"
    }
}

fn realised(overrides: &[&str]) -> Realisation {
    let mut source = source("salt/salt");
    for one in overrides {
        source.set(*one);
    }
    Realisation::new(&checked(&source), &Selection::default()).unwrap()
}

#[test]
fn a_salt_dome_leaves_the_beds_what_its_closed_form_says() {
    let model = checked(&source("salt/salt"));
    let built = Built::new(model, &Selection::default(), Engine::Auto).unwrap();
    assert!(
        built.assembly.proof.holds(),
        "{}",
        built.assembly.proof.failures()
    );
    assert_eq!(
        (built.assembly.engine, built.assembly.remedy),
        (Engine::Occt, "none")
    );
    assert!(built.assembly.failed.is_empty());
    let million = 1e6;
    for (name, right) in [
        ("background", (9600.0 - 216.0 * PI) * million),
        ("shale", (12800.0 - (216.0 + 376.0 / 3.0) * PI) * million),
        ("sand", (5600.0 - (334.0 + 5.0 / 6.0) * PI) * million),
        ("upper-shale", (8800.0 - (187.0 + 5.0 / 6.0) * PI) * million),
        ("salt", (1080.0 - 0.352) * PI * million),
        ("salt/cavern", 0.352 * PI * million),
        ("cover", 11200.0 * million),
    ] {
        let found = built.size(name);
        // The kernel's integrals over rational splines.
        assert!(
            (found / right - 1.0).abs() < 2e-6,
            "{name}: {found} for {right}"
        );
        assert_eq!(built.pieces(name), 1, "{name}");
    }
    // The cavern has a skin of its own: a cylinder and two cones of 50 m.
    let skin = PI * 40.0 * (2.0 * 200.0 + 2.0 * 50.0);
    assert!((built.contact("salt", "salt/cavern") / skin - 1.0).abs() < 1e-6);
}

#[test]
fn every_point_belongs_to_what_the_equations_say() {
    let realisation = realised(&[]);
    let owners = Owners::new(&realisation).unwrap();
    let mut asked = 0;
    for k in 1..40_000_u32 {
        let part = (DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * f64::from(k)).fract();
        // A quarter of them near the cavern.
        let p = if k % 4 == 0 {
            CAVERN + (part - 0.5) * DVec3::new(100.0, 100.0, 300.0)
        } else {
            part * DVec3::new(4000.0, 4000.0, -3000.0)
        };
        // Half a millimetre beside any surface all is exact.
        let beside = [-1.0, 1.0]
            .into_iter()
            .flat_map(|step| DVec3::AXES.map(|a| a * step * 5e-4));
        let right = expected(p);
        if beside.into_iter().any(|step| expected(p + step) != right) {
            continue;
        }
        let owner = owners.at(p).unwrap();
        assert_eq!(realisation.volumes[owner].name, right, "{p}");
        asked += 1;
    }
    assert!(asked > 39_900, "{asked}");
    // On the axis, above the pole of the bulb, on the seam and beside it.
    for (p, right) in [
        ([2000.0, 2000.0, -899.999], "upper-shale"),
        ([2000.0, 2000.0, -900.001], "salt"),
        ([2000.0, 2000.0, -2999.0], "salt"),
        ([2599.999, 2000.0, -2600.0], "salt"),
        ([2600.001, 2000.0, -2600.0], "background"),
        ([2999.999, 2000.0, -1400.0], "salt"),
        ([3000.001, 2000.0, -1400.0], "sand"),
        // Below the overhang.
        ([2800.0, 2000.0, -1799.0], "shale"),
    ] {
        let owner = owners.at(DVec3::from_array(p)).unwrap();
        assert_eq!(realisation.volumes[owner].name, right, "{p:?}");
    }
}

#[test]
fn a_solid_is_scaled_turned_and_moved_as_the_model_says() {
    // Beside its own origin it shows how it is turned: the cavern 1000 m east of it, then north, then twice as large.
    let at = |overrides: &[&str], p: [f64; 3]| {
        let realisation = realised(overrides);
        let owners = Owners::new(&realisation).unwrap();
        let owner = owners.at(DVec3::from_array(p)).unwrap();
        realisation.volumes[owner].name.clone()
    };
    let moved = "feature.cavern.at=[1700, 2100, -1300]";
    assert_eq!(at(&[moved], [1700.0, 2100.0, -1300.0]), "salt/cavern");
    assert_eq!(at(&[moved], [2250.0, 1900.0, -1500.0]), "salt");
    assert_eq!(at(&[], [2315.0, 1900.0, -1500.0]), "salt");
    assert_eq!(
        at(&["feature.cavern.scale=2"], [2315.0, 1900.0, -1500.0]),
        "salt/cavern"
    );
    // The dome as a lens: turned about a far origin it comes to lie elsewhere.
    let turned = [
        "feature.salt.azimuth_deg=90",
        "feature.salt.at=[1000, 3000, 0]",
    ];
    assert_eq!(at(&turned, [1000.0, 3000.0, -1400.0]), "salt");
    assert_eq!(at(&turned, [2500.0, 3000.0, -1400.0]), "sand");
}

#[test]
fn copies_of_a_solid_with_drawn_places_are_proven_each_by_itself() {
    let mut source = source("salt/salt");
    for one in [
        "feature.cavern.count=3",
        "feature.cavern.at=[{ uniform = [1700, 2300] }, { uniform = [1700, 2300] }, { uniform = [-1500, -1300] }]",
        "feature.cavern.scale={ uniform = [0.5, 1] }",
        "seed=4",
    ] {
        source.set(one);
    }
    let built = Built::new(checked(&source), &Selection::default(), Engine::Auto).unwrap();
    assert!(
        built.assembly.proof.holds(),
        "{}",
        built.assembly.proof.failures()
    );
    let sizes: f64 = (1..=3)
        .map(|k| built.size(&format!("salt/cavern-{k}")))
        .sum();
    let salt = built.size("salt");
    assert!(((salt + sizes) / (1080e6 * PI) - 1.0).abs() < 2e-6);
    assert!(sizes > 0.0 && sizes < 3.0 * 0.352e6 * PI);
}

#[test]
fn the_partition_alone_refuses_a_solid_of_another_program_and_says_why() {
    let model = checked(&source("salt/salt"));
    let error = Built::new(model, &Selection::default(), Engine::Partition)
        .err()
        .unwrap();
    let AssemblyError::NotProven { failed, .. } = &error else {
        panic!("{error}");
    };
    assert!(
        failed[0].why.contains("leave `--engine partition` out"),
        "{error}"
    );
}
