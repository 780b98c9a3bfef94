//! Ellipsoids: where they are, and how large.

use clinothem::features::body::Body;
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Distribution, FeatureKind, Quantity};
use glam::DVec3;

use super::checked::{from_text as model, without};
use super::{instances, realise};

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
            Body::Trough(_) | Body::Shell(_) | Body::Side(_) | Body::Imported(_) => None,
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
