//! Horizons and clinoform sets: every key arrives, and what is left out has its default.

use clinothem::model::{
    Bound, FeatureKind, HorizonSurface, Interfingering, Model, Pick, Quantity, Selector,
};

use super::{SHOREFACE, check};

fn clinoforms(model: &Model, index: usize) -> &clinothem::model::ClinoformsSpec {
    let FeatureKind::Clinoforms(set) = &model.features[index].kind else {
        panic!("{:?}", model.features[index].kind)
    };
    set
}

#[test]
fn every_key_of_a_horizon_and_of_the_domain_s_own_surfaces_arrives_where_it_belongs() {
    let model = check(SHOREFACE, &[]).unwrap();
    let number = |value: f64| Quantity::Constant(value);
    assert_eq!(
        model.domain.base,
        Some(HorizonSurface::Level(number(-55.0)))
    );
    assert_eq!(
        model.domain.top,
        Some(HorizonSurface::Dipping {
            through: [number(0.0), number(0.0), number(-1.0)],
            dip_deg: number(1.0),
            azimuth_deg: number(90.0),
        })
    );
    let horizon = |index: usize| match &model.features[index].kind {
        FeatureKind::Horizon(spec) => spec.clone(),
        other => panic!("{other:?}"),
    };
    let lower = horizon(0);
    assert!(!lower.onlapping);
    assert_eq!(
        lower.surface,
        HorizonSurface::Grid {
            x: [0.0, 400.0],
            y: [-10.0, 700.0],
            heights: vec![vec![-42.0, -41.0, -40.0], vec![-44.0, -42.0, -41.0]],
        }
    );
    let upper = horizon(3);
    assert!(upper.onlapping);
    assert_eq!(
        upper.surface,
        HorizonSurface::Points {
            points: vec![[0.0, 0.0, -21.0], [400.0, 0.0, -20.0], [0.0, 700.0, -22.0]],
            tolerance: 0.1,
        }
    );
    let picks = vec![Pick::Id("upper-set".to_owned())];
    assert_eq!(model.features[3].removed_by, Selector::Only(picks));
    assert!(model.notes.is_empty(), "{:?}", model.notes);
}

#[test]
fn every_key_of_a_clinoform_set_arrives_where_it_belongs() {
    let model = check(SHOREFACE, &[]).unwrap();
    let feature = &model.features[2];
    assert_eq!(
        (feature.parent, feature.level, feature.count),
        (Some(0), 2, 1)
    );
    let set = clinoforms(&model, 2);
    assert_eq!(set.top, Bound::Horizon(3));
    assert_eq!(set.azimuth_deg.constant(), Some(320.0));
    assert_eq!(set.shoreline[0].constant(), Some(3000.0));
    assert_eq!(set.shoreline[1].support(), (5000.0, 6000.0));
    assert_eq!(set.length.support(), (150.0, 900.0));
    assert_eq!(set.spacing.support(), (105.0, 390.0));
    assert_eq!(set.first.support(), (50.0, 60.0));
    assert_eq!(set.exponent.constant(), Some(2.5));
    assert_eq!(set.toe, Some(Quantity::Constant(0.2)));
    assert_eq!(set.sheets, Some(6));
    assert_eq!(set.interfingering, Interfingering::Zigzag);
    let belts: Vec<_> = set
        .belts
        .iter()
        .map(|belt| {
            let support = |quantity: &Option<Quantity>| quantity.as_ref().map(Quantity::support);
            let (width, swing) = (support(&belt.width), support(&belt.interfingering));
            (belt.name.as_str(), belt.facies, width, swing)
        })
        .collect();
    assert_eq!(
        belts,
        [
            ("usf", 1, Some((80.0, 210.0)), Some((8.0, 60.0))),
            ("lsf", 1, Some((120.0, 120.0)), Some((0.0, 0.0))),
            ("os", 2, None, None),
        ]
    );
}

#[test]
fn what_a_clinoform_set_leaves_out_has_the_stated_defaults() {
    let model = check(SHOREFACE, &[]).unwrap();
    let set = clinoforms(&model, 4);
    assert_eq!(set.top, Bound::Domain);
    let shoreline = set.shoreline.each_ref().map(Quantity::constant);
    assert_eq!(shoreline, [Some(3000.0), Some(6000.0)]);
    assert_eq!(set.exponent.constant(), Some(2.0));
    assert_eq!((set.toe.clone(), set.sheets), (None, None));
    assert_eq!(set.interfingering, Interfingering::Smooth);
    assert!(set.belts.is_empty());

    // The next horizon that takes part bounds the unit above.
    let without = SHOREFACE.replace("top = \"upper\"\n", "");
    let model = check(&without, &[]).unwrap();
    assert_eq!(clinoforms(&model, 2).top, Bound::Horizon(3));
    let model = check(&without, &["feature.upper.enabled=false"]).unwrap();
    assert_eq!(clinoforms(&model, 2).top, Bound::Domain);
    let model = check(SHOREFACE, &["feature.lower-set.top=domain"]).unwrap();
    assert_eq!(clinoforms(&model, 2).top, Bound::Domain);
}
