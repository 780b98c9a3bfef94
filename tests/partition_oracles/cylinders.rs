//! Cylinders, alone and crossing.

use std::f64::consts::PI;

use clinothem::partition::Region;
use glam::{DMat3, DVec3};

use super::shapes::audit::{combinations, size, sound, youngest};
use super::shapes::{askew, block, cylinder, cylinder_of_halves, mapped, placed, turn};
use super::{SIZE, assert_near};

#[test]
fn cylinders_have_their_volume_whatever_their_caps_are() {
    for body in [cylinder(0.7, 1.1), cylinder_of_halves(0.7, 1.1)] {
        let inside = Region::Shell(placed(&body, askew(), DVec3::new(0.1, 0.2, 0.3)));
        let made = sound(&[block(2.0), inside], youngest);
        assert_near(size(&made, 1), PI * 0.49 * 2.2, SIZE, "the cylinder");
        // Through the block's floor and top.
        let tall = mapped(&body, |p| DVec3::new(p.x + 0.1, p.y - 0.2, 2.5 * p.z));
        let made = sound(&[block(2.0), Region::Shell(tall)], youngest);
        assert_near(size(&made, 1), PI * 0.49 * 4.0, SIZE, "the column");
    }
}

/// Complete elliptic integrals of modulus k by the arithmetic–geometric mean: K and E.
fn elliptic(k: f64) -> (f64, f64) {
    let (mut a, mut b, mut c) = (1.0, (1.0 - k * k).sqrt(), k);
    let (mut sum, mut power) = (0.5 * c * c, 0.5);
    while c.abs() > 1e-16 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
        sum += power * c * c;
    }
    let whole = PI / (2.0 * a);
    (whole, whole * (1.0 - sum))
}

/// What cylinders of radii r < R share whose axes cross at right angles.
pub(super) fn crossing_cylinders(r: f64, big: f64) -> f64 {
    let (k, e) = elliptic(r / big);
    8.0 / 3.0 * big * ((big * big + r * r) * e - (big * big - r * r) * k)
}

#[test]
fn the_closed_form_for_crossing_cylinders_agrees_with_a_sum_of_slices() {
    // Substituting y = r sin θ, the midpoint rule converges faster than any power.
    for (r, big) in [(0.1, 1.0), (0.4, 0.6), (0.5, 1.0), (0.9, 1.0)] {
        let steps = 4000;
        let sum: f64 = (0..steps)
            .map(|i| {
                let angle = PI * (f64::from(i) + 0.5) / f64::from(steps) - PI / 2.0;
                let y = r * angle.sin();
                4.0 * (r * angle.cos()).powi(2) * (big * big - y * y).sqrt() * PI / f64::from(steps)
            })
            .sum();
        assert_near(crossing_cylinders(r, big), sum, 1e-12, "what they share");
    }
    assert_near(
        crossing_cylinders(1.0 - 1e-9, 1.0),
        16.0 / 3.0,
        1e-7,
        "of equal radii",
    );
    assert_near(
        crossing_cylinders(1e-3, 1.0),
        2.0 * PI * 1e-6,
        1e-5,
        "of a needle",
    );
}

pub(super) fn crossed(r: f64, big: f64, halves: bool) -> [Region; 3] {
    let make = if halves { cylinder_of_halves } else { cylinder };
    let along_z = Region::Shell(placed(&make(big, 1.6), askew(), DVec3::ZERO));
    let across = Region::Shell(placed(
        &make(r, 1.7),
        askew() * turn(0.0, PI / 2.0, 0.0) * DMat3::from_rotation_z(0.4),
        DVec3::ZERO,
    ));
    [block(3.0), along_z, across]
}

#[test]
pub(super) fn crossing_cylinders_share_what_elliptic_integrals_say() {
    for (r, big, halves) in [
        (0.5, 1.0, false),
        (0.5, 1.0, true),
        (0.9, 1.0, false),
        (0.99, 1.0, false),
        (0.2, 1.1, true),
    ] {
        let made = sound(&crossed(r, big, halves), combinations);
        assert_near(
            size(&made, 0b110),
            crossing_cylinders(r, big),
            SIZE,
            "what they share",
        );
        assert_near(
            size(&made, 0b010),
            PI * big * big * 3.2 - crossing_cylinders(r, big),
            SIZE,
            "the big one's rest",
        );
        assert_eq!(
            made.topology.solids.len(),
            5,
            "the needle's two ends stick out"
        );
    }
}
