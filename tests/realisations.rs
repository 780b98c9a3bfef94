//! Realisations: draws that know nothing of each other, rejections as often as theory says, banks that overhang.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "assembled/checked.rs"]
mod checked;

use std::collections::BTreeMap;
use std::f64::consts::PI;

use checked::{from_text as model, without};
use clinothem::features::body::Body;
use clinothem::model::meshing;
use clinothem::model::owner::Owners;
use clinothem::model::realisation::{Instance, Realisation};
use clinothem::model::selection::Selection;
use clinothem::model::{Distribution, FeatureKind, Quantity};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

fn realise(text: &str, overrides: &[&str]) -> Realisation {
    Realisation::new(&model(text, overrides), &Selection::default()).unwrap()
}

const BELT: &str = include_str!("../models/channel-belt/channel-belt.toml");

/// What was drawn, and the control points that came of it.
type Drawn = (Vec<(String, f64)>, Vec<DVec3>);

/// Every instance's draws and control points, by name.
fn instances(realisation: &Realisation) -> BTreeMap<String, Drawn> {
    realisation
        .instances
        .iter()
        .map(|one| {
            let name = realisation.volumes[one.volume].name.clone();
            let sheets = one.body.sheets().unwrap();
            let net = sheets.iter().flat_map(|sheet| sheet.1.net().to_vec());
            (name, (one.drawn.clone(), net.collect()))
        })
        .collect()
}

#[test]
fn a_longer_list_or_another_order_of_features_changes_no_draw() {
    let twenty = instances(&realise(BELT, &[]));
    let thirty = instances(&realise(BELT, &["feature.channel.count=30"]));
    assert_eq!((twenty.len(), thirty.len()), (20, 30));
    for (name, one) in &twenty {
        assert_eq!(thirty[name], *one, "{name}");
    }
    let (head, feature) = BELT.split_once("[[feature]]").unwrap();
    let other = feature
        .replace("id = \"channel\"", "id = \"other\"")
        .replace("count = 20", "count = 3");
    let before = instances(&realise(
        &format!("{head}[[feature]]{other}\n[[feature]]{feature}"),
        &[],
    ));
    let after = instances(&realise(
        &format!("{head}[[feature]]{feature}\n[[feature]]{other}"),
        &[],
    ));
    assert_eq!(before, after);
    for (name, one) in &twenty {
        assert_eq!(before[name], *one, "{name}");
    }
    assert_ne!(before["other-1"], before["channel-1"]);
}

#[test]
fn fixing_one_quantity_changes_no_other_draw() {
    let free = realise(BELT, &[]);
    let fixed = realise(BELT, &["feature.channel.width=40"]);
    for (a, b) in free.instances.iter().zip(&fixed.instances) {
        // Rejections depend on the width, and another attempt is another draw.
        if a.rejected > 0 || b.rejected > 0 {
            continue;
        }
        let others = |drawn: &[(String, f64)]| -> Vec<(String, f64)> {
            let kept = drawn.iter().filter(|(key, _)| key != "width");
            kept.cloned().collect()
        };
        assert!(others(&a.drawn).len() >= 6, "{:?}", a.drawn);
        assert_eq!(others(&a.drawn), others(&b.drawn));
    }
}

#[test]
fn realisations_do_not_depend_on_the_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| instances(&realise(BELT, &[])))
    };
    assert_eq!(on(1), on(5));
}

/// J₀ and H₀ (Bessel and Struve) by their power series, enough below 3.
fn j0_h0(x: f64) -> (f64, f64) {
    let (mut j, mut h) = (0.0, 0.0);
    let (mut term_j, mut term_h) = (1.0, 2.0 * x / PI);
    for k in 1..40_u32 {
        j += term_j;
        h += term_h;
        let k = f64::from(k);
        term_j *= -(x / 2.0).powi(2) / (k * k);
        term_h *= -x * x / (2.0 * k + 1.0).powi(2);
    }
    (j, h)
}

/// A number from 0 to 1 that owes nothing to the program's streams (xorshift64*).
fn unit(state: &mut u64) -> f64 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    #[allow(clippy::cast_precision_loss, reason = "53 bits are kept")]
    let value = (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64;
    value / 9_007_199_254_740_992.0
}

fn triangular(state: &mut u64, [low, mode, high]: [f64; 3]) -> f64 {
    let u = unit(state);
    let at = (mode - low) / (high - low);
    if u < at {
        low + (u * (high - low) * (mode - low)).sqrt()
    } else {
        high - ((1.0 - u) * (high - low) * (high - mode)).sqrt()
    }
}

/// The share of Table 1's draws whose bends are tighter than the half-width, or that no meander fits: a
/// sine-generated curve has A/λ = H₀(ω) / 4 J₀(ω) and a least radius λ / (2π ω J₀(ω)).
fn share_of_folds() -> f64 {
    let mut state = 0x9E37_79B9_7F4A_7C15;
    let draws = 400_000;
    let mut folds = 0;
    for _ in 0..draws {
        let width = triangular(&mut state, [15.0, 50.0, 100.0]);
        let amplitude = triangular(&mut state, [20.0, 100.0, 200.0]);
        let wavelength = triangular(&mut state, [50.0, 475.0, 3000.0]);
        // By bisection: the ratio grows with ω up to the first zero of J₀.
        let (mut low, mut high) = (0.0, 2.404_825);
        for _ in 0..50 {
            let middle = f64::midpoint(low, high);
            let (j, h) = j0_h0(middle);
            if h / (4.0 * j) < amplitude / wavelength {
                low = middle;
            } else {
                high = middle;
            }
        }
        let (j, _) = j0_h0(low);
        folds += u32::from(wavelength / (2.0 * PI * low * j) < width / 2.0);
    }
    f64::from(folds) / f64::from(draws)
}

#[test]
fn draws_of_table_1_are_rejected_as_often_as_theory_says() {
    let count = 6000;
    let realisation = realise(
        BELT,
        &[
            &format!("feature.channel.count={count}"),
            // Positions and tops say nothing about bends; a small block makes short channels.
            "domain.x=[0,400]",
            "domain.y=[0,400]",
        ],
    );
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    for rejection in &realisation.rejections {
        assert_eq!(rejection.feature, "channel");
        counts.insert(&rejection.reason, rejection.count);
    }
    let total: u32 = counts.values().sum();
    let by_instance: u32 = realisation.instances.iter().map(|one| one.rejected).sum();
    assert_eq!(total, by_instance, "each is counted once: {counts:?}");
    let necks = counts.get("meander neck narrower than the width").copied();
    let folds = total - necks.unwrap_or(0);
    let share = share_of_folds();
    // The published distributions: about 0.2 %, and not the 6.8 % of a sine.
    assert!((0.001..0.004).contains(&share), "{share}");
    let expected = share * f64::from(count);
    // Five standard deviations of a rare count.
    let miss = (f64::from(folds) - expected).abs();
    assert!(
        miss < 5.0 * expected.sqrt(),
        "{counts:?}: {expected:.1} expected"
    );
}

const NODULES: &str = r#"
    name = "Nodules"
    seed = 3
    [domain]
    x = [0, 400]
    y = [0, 300]
    z = [-30, 0]
    facies = "mud"
    [facies.mud]
    [[feature]]
    id = "channel"
    kind = "channel"
    facies = "mud"
    width = 60
    depth = 9
    top = { uniform = [-12, -6] }
    trajectory = { kind = "sine-generated", amplitude = 60, wavelength = 300, azimuth_deg = 80 }
    [[feature]]
    id = "nodule"
    kind = "ellipsoid"
    count = 2000
    facies = "mud"
    semi_axes = [{ uniform = [2, 4] }, 1.5, { triangular = [0.5, 1, 1.5] }]
    azimuth_deg = { uniform = [0, 180] }
"#;

fn ellipsoids(realisation: &Realisation) -> Vec<(DVec3, [DVec3; 3])> {
    let found = realisation
        .instances
        .iter()
        .filter_map(|one| match &one.body {
            Body::Trough(_) | Body::Side(_) => None,
            Body::Ellipsoid(ellipsoid) => Some((ellipsoid.center(), ellipsoid.axes())),
        });
    found.collect()
}

#[test]
fn free_ellipsoids_are_spread_over_the_domain_and_drawn_from_their_distributions() {
    let found = ellipsoids(&realise(NODULES, &[]));
    assert_eq!(found.len(), 2000);
    let (low, high) = (DVec3::new(0.0, 0.0, -30.0), DVec3::new(400.0, 300.0, 0.0));
    let (mut sum, mut length, mut height) = (DVec3::ZERO, 0.0, 0.0);
    for (center, [a, b, c]) in &found {
        let unit = (center - low) / (high - low);
        assert!(unit.cmpge(DVec3::ZERO).all() && unit.cmple(DVec3::ONE).all());
        sum += unit;
        assert!((2.0..=4.0).contains(&a.length()) && (b.length() - 1.5).abs() < 1e-12);
        length += a.length();
        height += c.length();
        // Azimuths of 0 to 180° point east; no plunge.
        assert!(a.x >= -1e-9 && a.z.abs() < 1e-12 && c.z > 0.0);
    }
    // Six standard deviations of the means of 2000: √(1/12/2000) = 0.0065, 0.013 m and 0.0046 m.
    let mean = sum / 2000.0;
    assert!((mean - 0.5).abs().max_element() < 0.039, "{mean}");
    assert!((length / 2000.0 - 3.0).abs() < 0.078, "{length}");
    assert!((height / 2000.0 - 1.0).abs() < 0.028, "{height}");
}

#[test]
fn children_without_a_center_are_spread_over_what_their_parent_has_of_the_domain() {
    let text = NODULES.replace("count = 2000", "count = 2000\nparent = \"channel\"");
    let model = model(&text, &[]);
    let realisation = Realisation::new(&model, &Selection::default()).unwrap();
    // Only the parent's shell is asked for: those of 2000 ellipsoids would take long.
    let alone = Realisation::new(&model, &without(&["nodule"])).unwrap();
    assert_eq!(alone.instances[0].drawn, realisation.instances[0].drawn);
    let owners = Owners::new(&alone).unwrap();
    let found = ellipsoids(&realisation);
    assert!(found.iter().all(|(center, _)| owners.in_domain(*center)));
    assert!(found.iter().all(|(center, _)| owners.inside(1, *center)));
    // As many in the western half as the parent's volume has there, by points of a lattice.
    let (mut all, mut west) = (0_u32, 0_u32);
    for i in 0..10 * 60 * 45 {
        let part = |k: i32, n: i32| (f64::from(k % n) + 0.5) / f64::from(n);
        let unit = DVec3::new(part(i, 60), part(i / 60, 45), part(i / 60 / 45, 10));
        let point = DVec3::new(400.0 * unit.x, 300.0 * unit.y, -30.0 + 30.0 * unit.z);
        if owners.inside(1, point) {
            all += 1;
            west += u32::from(point.x < 200.0);
        }
    }
    let share = f64::from(west) / f64::from(all);
    let hits = found.iter().filter(|(center, _)| center.x < 200.0).count() as f64;
    // Six standard deviations of a share of 2000: 6 · √(¼/2000) = 0.067.
    assert!((hits / 2000.0 - share).abs() < 0.067, "{hits} {share}");
    // Each rejected centre is counted.
    let by_instance: u32 = realisation.instances.iter().map(|one| one.rejected).sum();
    let counted: Vec<_> = realisation
        .rejections
        .iter()
        .map(|one| (one.feature.as_str(), one.reason.as_str(), one.count))
        .collect();
    assert_eq!(
        counted,
        [("nodule", "centre outside the parent", by_instance)]
    );
    assert!(by_instance > 2000, "{by_instance}");
}

#[test]
fn a_childs_own_center_needs_no_parent_around_it() {
    let text = NODULES.replace("count = 2000", "parent = \"channel\"\ncenter = [5, 5, -29]");
    let realisation = realise(&text, &[]);
    assert_eq!(ellipsoids(&realisation)[0].0, DVec3::new(5.0, 5.0, -29.0));
    assert!(realisation.rejections.is_empty());
}

#[test]
fn ellipsoids_do_not_depend_on_order_or_threads() {
    let text = NODULES.replace("count = 2000", "count = 20\nparent = \"channel\"");
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| instances(&realise(&text, &[])))
    };
    let found = on(1);
    assert_eq!(found, on(5));
    let more = instances(&realise(&text, &["feature.nodule.count=30"]));
    for (name, one) in &found {
        assert_eq!(more[name], *one, "{name}");
    }
    let (head, channel) = text.split_once("[[feature]]").unwrap();
    let (channel, nodule) = channel.split_once("[[feature]]").unwrap();
    let turned = format!("{head}[[feature]]{nodule}\n[[feature]]{channel}");
    assert_eq!(instances(&realise(&turned, &[])), found);
}

#[test]
fn semi_axes_that_are_not_positive_are_drawn_again_and_counted() {
    let mut model = model(NODULES, &[]);
    let FeatureKind::Ellipsoid(spec) = &mut model.features[1].kind else {
        panic!("an ellipsoid")
    };
    // The file's checks refuse such a distribution; what comes by other ways is caught at the draw.
    spec.semi_axes[1] = Quantity::Random(Distribution::normal(1.0, 2.0).unwrap());
    let realisation = Realisation::new(&model, &Selection::default()).unwrap();
    let [rejection] = realisation.rejections.as_slice() else {
        panic!("{:?}", realisation.rejections)
    };
    assert_eq!(rejection.reason, "semi-axis not above 0");
    // Φ(−½) = 0.3085 of the draws fail: 2000 · 0.3085/0.6915 = 892, with a standard deviation of 36.
    let miss = f64::from(rejection.count) - 892.3;
    assert!(miss.abs() < 6.0 * 36.0, "{}", rejection.count);
}

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
fn what_is_hard_to_mesh_is_told_with_what_to_set() {
    const COASTAL: &str = include_str!("../models/coastal/coastal.toml");
    let advice = |overrides: &[&str]| meshing::advice(&realise(COASTAL, overrides));
    let told = advice(&[]);
    let realisation = realise(COASTAL, &[]);
    let width = |one: &Instance| one.drawn.iter().find(|(name, _)| name == "width").cloned();
    let narrowest = realisation
        .instances
        .iter()
        .filter_map(|one| Some((width(one)?.1, realisation.volumes[one.volume].name.as_str())))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap();
    let size = format!(
        "`Mesh.MeshSizeMax = {:.1}` (half the width of the narrowest one, {})",
        0.5 * narrowest.0,
        narrowest.1
    );
    assert!(told.len() == 2 && told[0].contains(&size), "{told:?}");
    // A width that is not drawn counts, too.
    let given = advice(&["feature.channel.width=12"]);
    assert!(
        given[0].contains("`Mesh.MeshSizeMax = 6.0` (half"),
        "{given:?}"
    );
    assert!(told[1].starts_with("lower, upper: ") && told[1].contains("`toe = 0.3`"));
    // What it says to set is what makes it silent.
    let lower = advice(&["feature.lower.toe=0.3"]);
    assert!(lower[1].starts_with("upper: "), "{lower:?}");
    let both = advice(&["feature.lower.toe=0.3", "feature.upper.toe=0.1"]);
    assert_eq!(both.len(), 1, "{both:?}");
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
    let nested = include_str!("../models/rules/nested.toml");
    let protected = include_str!("../models/rules/protected.toml");
    let coastal = include_str!("../models/coastal/coastal.toml");
    let undulating = include_str!("../models/strata/undulating.toml");
    let nodules = include_str!("../models/nodules/nodules.toml");
    let far = include_str!("../models/far/channels.toml");
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
