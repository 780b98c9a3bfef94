//! The owner of a place, also below overhanging banks.

use clinothem::features::body::Body;
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::checked::from_text as model;
use super::{BELT, realise, unit};

fn overhanging(left: f64, right: f64, width: f64, depth: f64, asymmetry: f64) -> String {
    format!(
        r#"
        name = "Overhang"
        [domain]
        x = [0, 100]
        y = [0, 300]
        z = [-30, 0]
        facies = "mud"
        [facies.mud]
        [facies.sand]
        [[feature]]
        id = "c"
        kind = "channel"
        facies = "sand"
        width = {width}
        depth = {depth}
        top = -3
        asymmetry = {asymmetry}
        origin = "top-centre"
        left_angle_deg = {left}
        right_angle_deg = {right}
        trajectory = {{ kind = "line", from = [-50, 150], to = [150, 150] }}
        "#
    )
}

/// The section's outline, densely: de Casteljau would need Bézier pieces, so basis functions by their
/// recursion on the knots of seven control points.
fn outline(points: &[DVec2; 7]) -> Vec<DVec2> {
    const KNOTS: [f64; 11] = [0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0, 1.0];
    fn basis(i: usize, p: usize, u: f64) -> f64 {
        if p == 0 {
            return f64::from(u8::from(KNOTS[i] <= u && u < KNOTS[i + 1]));
        }
        let part = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
        part(u - KNOTS[i], KNOTS[i + p] - KNOTS[i]) * basis(i, p - 1, u)
            + part(KNOTS[i + p + 1] - u, KNOTS[i + p + 1] - KNOTS[i + 1]) * basis(i + 1, p - 1, u)
    }
    let steps = 2000;
    let at = |u: f64| (0..7).map(|i| points[i] * basis(i, 3, u)).sum();
    let mut outline: Vec<DVec2> = (0..steps)
        .map(|step| at(f64::from(step) / f64::from(steps)))
        .collect();
    outline.push(points[6]);
    outline
}

/// Even-odd rule, and the distance to the outline.
fn in_polygon(polygon: &[DVec2], p: DVec2) -> (bool, f64) {
    let (mut inside, mut distance) = (false, f64::INFINITY);
    for i in 0..polygon.len() {
        let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
            inside = !inside;
        }
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        distance = distance.min(p.distance(a.lerp(b, t)));
    }
    (inside, distance)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn owner_agrees_with_a_dense_section_even_where_banks_overhang(
        left in 50.0..150.0_f64,
        right in 50.0..150.0_f64,
        width in 30.0..90.0_f64,
        depth in 3.0..12.0_f64,
        asymmetry in -0.3..0.3_f64,
    ) {
        let model = model(&overhanging(left, right, width, depth, asymmetry), &[]);
        // A bank that would reach past the thalweg is no channel, and is refused.
        let made = Realisation::new(&model, &Selection::default());
        prop_assume!(made.is_ok());
        let realisation = made.unwrap();
        let owners = Owners::new(&realisation).unwrap();
        let (half, thalweg) = (width / 2.0, asymmetry * width);
        let spread = 0.45 * (half - thalweg.abs());
        let drop = 0.65 * depth;
        let bank = |angle: f64| drop / angle.to_radians().tan();
        let polygon = outline(&[
            DVec2::new(-half, 0.0),
            DVec2::new(-half + bank(left), -drop),
            DVec2::new(thalweg - spread, -depth),
            DVec2::new(thalweg, -depth),
            DVec2::new(thalweg + spread, -depth),
            DVec2::new(half - bank(right), -drop),
            DVec2::new(half, 0.0),
        ]);
        let mut state = 0x1234_5678_9ABC_DEF1;
        for _ in 0..400 {
            let across = (unit(&mut state) - 0.5) * (width + 30.0);
            let up = 1.0 - unit(&mut state) * (depth + 2.0);
            let (inside, distance) = in_polygon(&polygon, DVec2::new(across, up));
            // The polygon's own error: a chord of a 2000th of the section.
            if distance < 1e-4 {
                continue;
            }
            // Looking east, right is south.
            let x = unit(&mut state) * 100.0;
            let point = DVec3::new(x, 150.0 - across, -3.0 + up);
            prop_assert_eq!(owners.at(point), Some(usize::from(inside)), "{}", point);
        }
    }

    #[test]
    fn locate_names_both_sides_of_a_face_and_nothing_away_from_it(
        u in 0.02..0.98_f64,
        v in 0.4..0.6_f64,
        left in 60.0..130.0_f64,
    ) {
        let model = model(&overhanging(left, 80.0, 60.0, 6.0, 0.1), &[]);
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let owners = Owners::new(&realisation).unwrap();
        let Body::Trough(trough) = &realisation.instances[0].body else {
            panic!("a channel")
        };
        let base = trough.base();
        let (point, normal) = (base.point(u, v), base.normal(u, v).unwrap());
        let on = owners.locate(point, 1e-6).unwrap();
        prop_assert_eq!(&on.boundary, &[0, 1]);
        prop_assert_eq!(on.owner, 1, "the younger has the face");
        let mut sides = [1.0, -1.0].map(|sign| {
            let beside = owners.locate(point + normal * (sign * 1e-3), 1e-6).unwrap();
            assert_eq!(beside.boundary, [0_usize; 0]);
            beside.owner
        });
        sides.sort_unstable();
        prop_assert_eq!(sides, [0, 1]);
    }
}

#[test]
fn the_owner_of_a_place_is_the_one_that_asking_all_bodies_gives() {
    let layer = |i: i32| {
        format!(
            "[[feature]]\nid = \"l{i}\"\nkind = \"horizon\"\nfacies = \"sand\"\nsurface = {{ level = {} }}\n",
            i - 60
        )
    };
    let layers = (0..60).map(layer).collect::<Vec<_>>().concat();
    let domain = "name = \"layers\"\n[domain]\nx = [0, 10]\ny = [0, 10]\nz = [-61, 0]\nfacies = \"mud\"\n[facies.mud]\n[facies.sand]\n";
    let nested = include_str!("../../models/rules/nested.toml");
    let protected = include_str!("../../models/rules/protected.toml");
    let coastal = include_str!("../../models/coastal/coastal.toml");
    let undulating = include_str!("../../models/strata/undulating.toml");
    let nodules = include_str!("../../models/nodules/nodules.toml");
    let far = include_str!("../../models/far/channels.toml");
    let layers = format!("{domain}{layers}");
    for text in [
        BELT, nested, protected, coastal, undulating, nodules, far, &layers,
    ] {
        let realisation = realise(text, &[]);
        let owners = Owners::new(&realisation).unwrap();
        let (low, high) = (realisation.extent.low(), realisation.extent.high());
        let mut seen = std::collections::BTreeSet::new();
        let mut state = 7;
        for _ in 0..3000 {
            let part = DVec3::new(unit(&mut state), unit(&mut state), unit(&mut state));
            let point = low + (high - low) * part;
            let Some(owner) = owners.at(point) else {
                continue;
            };
            let all = realisation
                .rules
                .owner(|volume| owners.inside(volume, point));
            assert_eq!(owner, all, "{point}");
            seen.insert(owner);
        }
        assert!(seen.len() > 2);
    }
}
