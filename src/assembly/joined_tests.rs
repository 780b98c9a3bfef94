#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use glam::{DVec2, DVec3};

use super::*;
use crate::assembly::kernel::{Classifier, Position, solid};
use crate::features::body::Role;
use crate::features::lobe::LobeDesign;
use crate::features::shell::Tube;
use crate::nurbs::{KnotVector, Surface};

/// A sheet of degree 3 across and 1 along, at a height.
fn sheet(height: f64, degree: usize) -> Surface {
    let across = KnotVector::uniform(degree, degree + 1).unwrap();
    let along = KnotVector::uniform(1, 2).unwrap();
    let point = |i: usize, j: f64| {
        let part = i as f64 / degree as f64;
        let bend = height * 4.0 * part * (1.0 - part);
        DVec3::new(30.0 * part - 15.0, 100.0 * j, height + bend)
    };
    let net = (0..=degree).flat_map(|i| [0.0, 1.0].map(|j| point(i, j)));
    Surface::new(across, along, net.collect()).unwrap()
}

/// The kernel's solid and the shell agree on places all over its box.
fn agree(shell: &Shell) {
    let shape = solid(&super::shell(shell).unwrap()).unwrap();
    let mut classifier = Classifier::new(&shape).unwrap();
    let (low, high) = shell.bounds();
    let mut held = 0;
    for k in 0..500_u32 {
        let part = DVec3::new(0.819_172_513, 0.671_043_607, 0.549_700_478) * f64::from(k);
        let at = low + (high - low) * part.fract();
        let inside = shell.contains(at);
        let wanted = if inside { Position::In } else { Position::Out };
        assert_eq!(
            classifier.contains(at.to_array(), 1e-7).unwrap(),
            wanted,
            "{at}"
        );
        held += usize::from(inside);
    }
    assert!(held > 50 && held < 450, "{held}");
}

#[test]
fn the_kernel_takes_tubes_whose_ends_have_elevated_sides_and_lobes_with_poles() {
    let tube = Tube {
        sheets: [sheet(-4.0, 3), sheet(2.0, 1)],
        roles: [Role::Base, Role::Hidden],
        sides: [Role::Hidden; 2],
    };
    let shell = tube.close().unwrap();
    let made = super::shell(&shell).unwrap();
    assert_eq!((made.vertices.len(), made.edges.len()), (8, 12));
    agree(&shell);
    // The same between sheets whose parameters across have other ranges.
    let shifted = Surface::new(
        KnotVector::new(1, vec![-3.0, -3.0, 4.0, 4.0]).unwrap(),
        tube.sheets[1].knots_v().clone(),
        tube.sheets[1].net().to_vec(),
    );
    let shifted = Tube {
        sheets: [tube.sheets[0].clone(), shifted.unwrap()],
        ..tube
    };
    agree(&shifted.close().unwrap());
    let lobe = LobeDesign {
        center: DVec2::new(40.0, 30.0).extend(-5.0),
        length: 300.0,
        width: 180.0,
        thickness: 8.0,
        azimuth: 0.4,
        taper: 0.5,
        skew: 0.3,
    };
    agree(&lobe.build().unwrap().shell().unwrap());
}
