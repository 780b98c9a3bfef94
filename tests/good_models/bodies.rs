//! Channels and ellipsoids: every key arrives, and what is left out has its default.

use clinothem::model::{
    BentProfile, EllipsoidSpec, Expression, FeatureKind, Graded, Model, Pick, Profile,
    PropertySpec, Quantity, Rgb, SectionOrigin, Selector, TrajectorySpec,
};
use clinothem::nurbs::interpolate::Parametrization;

use super::{FULL, GOOD, check};

fn channel(model: &Model, index: usize) -> &clinothem::model::ChannelSpec {
    let FeatureKind::Channel(channel) = &model.features[index].kind else {
        panic!("{:?}", model.features[index].kind)
    };
    channel
}

fn ellipsoid(model: &Model, index: usize) -> &EllipsoidSpec {
    let FeatureKind::Ellipsoid(ellipsoid) = &model.features[index].kind else {
        panic!("{:?}", model.features[index].kind)
    };
    ellipsoid
}

#[test]
fn every_key_of_an_ellipsoid_arrives_where_it_belongs() {
    let model = check(FULL, &[]).unwrap();
    let index = model.features.len() - 1;
    let feature = &model.features[index];
    assert_eq!(
        (
            feature.id.as_str(),
            feature.count,
            feature.level,
            feature.parent
        ),
        ("nodule", 4, 5, Some(1))
    );
    assert_eq!(
        feature.removed_by,
        Selector::Only(vec![Pick::Kind("ellipsoid".to_owned())])
    );
    let spec = ellipsoid(&model, index);
    let means = spec.semi_axes.each_ref().map(Quantity::mean);
    assert!((means[0] - 4.0).abs() < 1e-12, "{means:?}");
    assert_eq!(means[1..], [2.5, 1.5]);
    let center = spec.center.as_ref().unwrap();
    assert_eq!(center.each_ref().map(Quantity::mean), [500.0, 500.0, -20.0]);
    assert_eq!(center[0].support(), (100.0, 900.0));
    assert_eq!(spec.azimuth_deg.support(), (0.0, 180.0));
    assert_eq!(spec.plunge_deg.constant(), Some(-5.0));
}

#[test]
fn an_ellipsoid_can_be_overridden_and_lies_level_to_the_north_anywhere_if_not_told() {
    let nodule = include_str!("../bad_models/nodule.toml");
    let overrides = ["feature.nodule.semi_axes=[9, { uniform = [1, 2] }, 3]"];
    let spec = ellipsoid(&check(nodule, &overrides).unwrap(), 0).clone();
    assert_eq!(spec.semi_axes[0].constant(), Some(9.0));
    assert_eq!(spec.semi_axes[1].support(), (1.0, 2.0));
    let bare = nodule
        .replace("center = [50, 50, -15]\n", "")
        .replace("azimuth_deg = 40\n", "")
        .replace("plunge_deg = 10\n", "");
    let spec = ellipsoid(&check(&bare, &[]).unwrap(), 0).clone();
    assert_eq!(spec.center, None);
    assert_eq!(spec.azimuth_deg.constant(), Some(0.0));
    assert_eq!(spec.plunge_deg.constant(), Some(0.0));
}

#[test]
#[allow(clippy::too_many_lines, reason = "a line or two for each key")]
fn every_key_arrives_where_it_belongs() {
    let model = check(FULL, &[]).unwrap();
    assert_eq!(model.origin, [431_200.0, 6_521_300.0, -2000.0]);
    assert_eq!(model.description.as_deref(), Some("Every key once"));
    let mud = &model.facies[0];
    assert_eq!(
        mud.color,
        Rgb {
            r: 0x99,
            g: 0x88,
            b: 0xff
        }
    );
    assert_eq!(
        mud.properties,
        [
            ("net".to_owned(), PropertySpec::from(0.0)),
            ("porosity".to_owned(), PropertySpec::from(0.08)),
            ("permeability".to_owned(), PropertySpec::from(0.1)),
            ("youngs_modulus".to_owned(), PropertySpec::from(2.1e10)),
            ("stress".to_owned(), PropertySpec::from([1.0, 2.0, 3.0])),
        ]
    );
    let sand = &model.facies[1];
    assert_eq!(sand.title.as_deref(), Some("Песок"));
    assert_eq!(
        sand.color,
        Rgb {
            r: 255,
            g: 215,
            b: 0
        }
    );
    let rock: Vec<&str> = sand
        .properties
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    assert_eq!(rock, ["net", "porosity", "permeability", "vsh", "sw"]);
    assert_eq!(sand.properties[0].1, PropertySpec::from(0.7));
    let PropertySpec::Layers([_, strike, normal]) = &sand.properties[2].1 else {
        panic!("{:?}", sand.properties[2]);
    };
    assert_eq!(*strike, Graded::Even(300.0.into()));
    let Graded::Rising { base, top, is_log } = normal else {
        panic!("{normal:?}");
    };
    assert_eq!(
        (base.constant(), top.support(), *is_log),
        (Some(5.0), (40.0, 60.0), false)
    );
    let trunk = &model.features[0];
    assert_eq!(trunk.title.as_deref(), Some("Brent Næss 上部"));
    assert!(matches!(trunk.properties[0].1, PropertySpec::Level { .. }));
    assert_eq!(trunk.properties[1].0, "age");
    assert_eq!(
        (trunk.count, trunk.level, trunk.parent, trunk.enabled),
        (2, 1, None, true)
    );
    assert_eq!(trunk.removes, Selector::Everything);
    assert_eq!(
        trunk.removed_by,
        Selector::Only(vec![
            Pick::Id("branch".to_owned()),
            Pick::Kind("channel".to_owned()),
            Pick::Level(2),
            Pick::Facies("sand".to_owned()),
            Pick::Id("loose".to_owned()),
        ])
    );
    let spec = channel(&model, 0);
    let Profile::Along(width) = &spec.width else {
        panic!()
    };
    assert_eq!(
        width
            .iter()
            .map(|(s, q)| (*s, q.mean()))
            .collect::<Vec<_>>(),
        [(0.0, 40.0), (0.5, 55.0), (1.0, 40.0)]
    );
    assert_eq!(
        spec.depth,
        Profile::Expression(Expression::new("5 + sin(2 * pi * s)", "s").unwrap())
    );
    assert_eq!(spec.asymmetry, BentProfile::from(-0.2));
    assert_eq!(spec.right_angle_deg, Some(Profile::from(100.0)));
    assert_eq!(spec.origin, SectionOrigin::TopCentre);
    assert_eq!(
        (spec.angle_limit_deg, spec.tolerance_fraction),
        (10.0, 0.005)
    );
    let TrajectorySpec::Points {
        points,
        parametrization,
        degree,
    } = &spec.trajectory
    else {
        panic!()
    };
    assert_eq!(
        (points.len(), *parametrization, *degree),
        (4, Parametrization::ChordLength, 2)
    );
}

#[test]
fn every_kind_of_trajectory_arrives() {
    let model = check(FULL, &[]).unwrap();
    let branch = &model.features[1];
    assert_eq!(
        (branch.parent, branch.level),
        (Some(0), 2),
        "one level below its parent"
    );
    assert_eq!(branch.removes, Selector::Only(vec![]));
    assert_eq!(branch.removed_by, Selector::Only(vec![]));
    let TrajectorySpec::Heading {
        center: Some([x, y]),
        length,
        ..
    } = &channel(&model, 1).trajectory
    else {
        panic!()
    };
    assert_eq!(
        (x.constant(), y.mean(), length.clone()),
        (Some(500.0), 500.0, Some(Quantity::from(400.0)))
    );
    assert!(model.features[2].preserve);
    let TrajectorySpec::SineGenerated { phase, .. } = &channel(&model, 3).trajectory else {
        panic!()
    };
    assert_eq!(*phase, Some(Quantity::from(0.25)));
    let TrajectorySpec::Parametric { y, range, .. } = &channel(&model, 4).trajectory else {
        panic!()
    };
    assert!((y.eval(0.25).unwrap() - 600.0).abs() < 1e-9);
    assert_eq!(*range, [0.0, 2.0]);
}

#[test]
fn what_is_left_out_has_its_default() {
    let model = check(
        &GOOD.replace("seed = 7\norigin = [431200.0, 6521300.0]", ""),
        &[],
    )
    .unwrap();
    assert_eq!((model.seed, model.origin), (1, [0.0; 3]));
    let feature = &model.features[1];
    assert_eq!(
        (
            feature.count,
            feature.level,
            feature.enabled,
            feature.preserve
        ),
        (1, 1, true, false)
    );
    assert_eq!(
        (&feature.removes, &feature.removed_by),
        (&Selector::Everything, &Selector::Everything)
    );
    let spec = channel(&model, 1);
    assert_eq!(spec.asymmetry, BentProfile::from(0.0));
    assert_eq!((&spec.top, spec.origin), (&None, SectionOrigin::Thalweg));
    assert_eq!(
        (spec.angle_limit_deg, spec.tolerance_fraction),
        (15.0, 0.01)
    );
}

#[test]
fn overrides_replace_values_and_later_ones_win() {
    let model = check(
        GOOD,
        &[
            "feature.channel.width=30",
            "domain.z=[-80, 0]",
            "seed=9",
            "seed=18446744073709551615",
            "domain.facies=sand",
            "facies.sand.color=#102030",
            "facies.sand.porosity=0.3",
            "facies.coal.net=false",
        ],
    )
    .unwrap();
    assert_eq!(channel(&model, 0).width, Profile::from(30.0));
    assert_eq!(
        (model.domain.z, model.seed, model.domain.facies),
        ([-80.0, 0.0], u64::MAX, 1)
    );
    assert_eq!(
        model.facies[1].color,
        Rgb {
            r: 0x10,
            g: 0x20,
            b: 0x30
        }
    );
    assert_eq!(
        model.facies[1].properties,
        [("porosity".to_owned(), PropertySpec::from(0.3))]
    );
    assert_eq!(model.facies[2].name, "coal");
}
