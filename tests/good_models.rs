//! The committed models are right, and mean what their text says.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use clinothem::model::{
    Bound, Defects, EllipsoidSpec, Expression, FeatureKind, Format, HorizonSurface, Interfingering,
    Model, Pick, Profile, Property, Quantity, Rgb, SectionOrigin, Selector, Source, TEMPLATES,
    TrajectorySpec,
};
use clinothem::nurbs::interpolate::Parametrization;

fn read(path: &str) -> Model {
    let source = Source::read(path).unwrap();
    Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"))
}

#[test]
fn the_channel_belt_has_twenty_channels_drawn_from_table_1() {
    let model = read("models/channel-belt/channel-belt.toml");
    assert_eq!(model.seed, 7);
    assert_eq!(model.domain.size(), [1000.0, 1000.0, 60.0]);
    assert_eq!(
        model
            .facies
            .iter()
            .map(|f| f.name.as_str())
            .collect::<Vec<_>>(),
        ["floodplain", "channel-sand"]
    );
    let [feature] = model.features.as_slice() else {
        panic!("one feature")
    };
    assert_eq!((feature.count, feature.level, feature.facies), (20, 1, 1));
    assert_eq!(feature.removes, Selector::Everything);
    let FeatureKind::Channel(channel) = &feature.kind else {
        panic!("{:?}", feature.kind)
    };
    let Profile::Quantity(Quantity::Random(width)) = &channel.width else {
        panic!("{:?}", channel.width)
    };
    assert_eq!(width.support(), (15.0, 100.0));
    assert!((width.mean() - 55.0).abs() < 1e-12);
    let TrajectorySpec::SineGenerated {
        wavelength, center, ..
    } = &channel.trajectory
    else {
        panic!("{:?}", channel.trajectory)
    };
    assert_eq!(wavelength.support(), (50.0, 3000.0));
    assert_eq!(*center, None);
    assert!(model.notes.is_empty());
}

#[test]
fn the_quickstart_has_two_channels() {
    let model = read("models/quickstart/quickstart.toml");
    assert_eq!(
        model
            .features
            .iter()
            .map(|f| f.id.as_str())
            .collect::<Vec<_>>(),
        ["old-channel", "young-channel"]
    );
    assert_eq!(model.features[1].place.line, 33);
}

#[test]
fn json_of_the_same_content_is_the_same_model() {
    let toml = include_str!("../models/channel-belt/channel-belt.toml");
    let value: toml::Value = toml::from_str(toml).unwrap();
    let json = serde_json::to_string_pretty(&value).unwrap();
    let from_json = Model::check(&Source::from_text("belt.json", json, Format::Json))
        .unwrap_or_else(|defects| panic!("{defects}"));
    let from_toml = read("models/channel-belt/channel-belt.toml");
    assert_eq!(from_json.domain.size(), from_toml.domain.size());
    assert_eq!(from_json.features[0].kind, from_toml.features[0].kind);
}

const GOOD: &str = include_str!("bad_models/good.toml");
const FULL: &str = include_str!("bad_models/full.toml");
const SHOREFACE: &str = include_str!("bad_models/shoreface.toml");

fn check(text: &str, overrides: &[&str]) -> Result<Model, Defects> {
    let mut source = Source::from_text("model.toml", text, Format::Toml);
    for assignment in overrides {
        source.set(*assignment);
    }
    Model::check(&source)
}

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
    let nodule = include_str!("bad_models/nodule.toml");
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
fn an_ellipsoid_that_cannot_reach_the_domain_is_noted() {
    let nodule = include_str!("bad_models/nodule.toml");
    let notes = |center: &str| {
        let model = check(nodule, &[&format!("feature.nodule.center={center}")]).unwrap();
        model.notes.len()
    };
    // The longest semi-axis is 6 m; the block is 100 m wide and 30 m high.
    assert_eq!(notes("[105.9, 50, -15]"), 0);
    assert_eq!(notes("[106.1, 50, -15]"), 1);
    assert_eq!(notes("[50, 50, 6.1]"), 1);
    assert_eq!(notes("[50, 50, { uniform = [-40, -36.1] }]"), 1);
    assert_eq!(notes("[50, 50, { uniform = [-40, -35.9] }]"), 0);
}

#[test]
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
    assert_eq!(mud.net, Some(false));
    assert_eq!(
        mud.properties,
        [
            ("porosity".to_owned(), Property::Scalar(0.08)),
            ("permeability".to_owned(), Property::Vector([0.1; 3])),
            ("youngs_modulus".to_owned(), Property::Scalar(2.1e10)),
            ("stress".to_owned(), Property::Vector([1.0, 2.0, 3.0])),
        ]
    );
    let trunk = &model.features[0];
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
    assert_eq!(spec.asymmetry, Profile::from(-0.2));
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
    assert_eq!(spec.asymmetry, Profile::from(0.0));
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
        [("porosity".to_owned(), Property::Scalar(0.3))]
    );
    assert_eq!(model.facies[2].name, "coal");
}

#[test]
fn what_has_no_effect_is_noted_where_it_stands() {
    let notes = |text: &str| -> Vec<(usize, String)> {
        let model = check(text, &[]).unwrap_or_else(|defects| panic!("{defects}"));
        model
            .notes
            .into_iter()
            .map(|note| (note.place.line, note.message))
            .collect()
    };
    assert_eq!(notes(GOOD), []);
    let disabled = GOOD
        .replace("count = 3", "enabled = false")
        .replace("depth = 4", "depth = 4\nremoves = [\"channel\"]");
    assert_eq!(
        notes(&disabled),
        [(
            34,
            "`removes` names `channel`, which is disabled".to_owned()
        )]
    );
    let younger = GOOD.replace("count = 3", "removes = [\"second\"]");
    assert_eq!(
        notes(&younger),
        [(
            22,
            "`removes` names `second`, which is younger, so this has no effect".to_owned()
        )]
    );
    let older = GOOD.replace("depth = 4", "depth = 4\nremoved_by = [\"channel\"]");
    assert_eq!(
        notes(&older),
        [(
            34,
            "`removed_by` names `channel`, which is older, so this has no effect".to_owned()
        )]
    );
    let orphan = GOOD
        .replace("count = 3", "enabled = false")
        .replace("depth = 4", "depth = 4\nparent = \"channel\"");
    assert!(
        notes(&orphan)[0]
            .1
            .contains("is left out with its parent, feature \"channel\"")
    );
    let unused = format!("{GOOD}[facies.coal]\n");
    assert_eq!(
        notes(&unused),
        [(35, "nothing is of the facies `coal`".to_owned())]
    );
    let low = GOOD.replace("count = 3", "top = -70");
    assert!(notes(&low)[0].1.contains("lies below the domain"));
}

#[test]
fn a_child_of_an_older_feature_is_not_called_younger_for_standing_later_in_the_file() {
    // Children are made with their parent, so `second` is made before `third`, which stands above it.
    let third = "[[feature]]\nid = \"third\"\nkind = \"channel\"\nfacies = \"sand\"\nwidth = 9\ndepth = 2\ntrajectory = { kind = \"line\", azimuth_deg = 4 }\nremoves = [\"second\"]\n";
    let text = GOOD
        .replace(
            "[[feature]]\nid = \"second\"",
            &format!("{third}\n[[feature]]\nid = \"second\""),
        )
        .replace("depth = 4", "depth = 4\nparent = \"channel\"");
    assert_eq!(check(&text, &[]).unwrap().notes, []);
}

#[test]
fn every_template_is_a_good_model() {
    for template in TEMPLATES {
        check(template.text, &[]).unwrap_or_else(|defects| panic!("{defects}"));
    }
}

#[test]
fn the_examples_of_the_reference_are_good() {
    let reference = include_str!("../docs/model-file.md");
    let blocks: Vec<&str> = reference
        .split("```toml\n")
        .skip(1)
        .map(|rest| rest.split("```").next().unwrap())
        .collect();
    let whole = blocks
        .iter()
        .find(|block| block.starts_with("name"))
        .unwrap();
    check(whole, &[]).unwrap_or_else(|defects| panic!("{defects}"));
    // Whole features follow the example's own.
    let features = blocks
        .iter()
        .filter(|block| block.starts_with("[[feature]]"));
    let mut kinds = Vec::new();
    for block in features {
        let model = check(&format!("{whole}\n{block}"), &[]);
        let model = model.unwrap_or_else(|defects| panic!("{defects}"));
        kinds.push(model.features[model.features.len() - 1].kind.name());
    }
    assert_eq!(kinds, ["ellipsoid", "horizon", "clinoforms"]);
    // Lines that stand for themselves are put into the whole example, one at a time.
    let mut lines = 0;
    for block in &blocks {
        for line in block.lines() {
            let key = line.split(" =").next().unwrap();
            let text = match key {
                "removes" | "removed_by" => whole.replace("count = 5", line),
                "width" => whole.replace("width = 80", line),
                "trajectory" if !whole.contains(line) => whole.replace(
                    "trajectory = { kind = \"line\", from = [0, 300], to = [1000, 600] }",
                    line,
                ),
                _ => continue,
            };
            check(&text, &[]).unwrap_or_else(|defects| panic!("{defects}"));
            lines += 1;
        }
    }
    assert!(lines >= 14, "{lines}");
}

#[test]
fn the_reference_names_every_key_of_the_schema() {
    fn keys(value: &serde_json::Value, found: &mut Vec<String>) {
        match value {
            serde_json::Value::Object(object) => {
                if let Some(serde_json::Value::Object(properties)) = object.get("properties") {
                    found.extend(properties.keys().cloned());
                }
                object.values().for_each(|inner| keys(inner, found));
            }
            serde_json::Value::Array(values) => values.iter().for_each(|inner| keys(inner, found)),
            _ => {}
        }
    }
    let reference = include_str!("../docs/model-file.md");
    let mut found = Vec::new();
    keys(&clinothem::model::schema(), &mut found);
    assert!(found.len() > 40);
    for key in found {
        let named = [
            format!("`{key}`"),
            format!("{key} ="),
            format!("[[{key}]]"),
            format!("[{key}]"),
            format!("[{key}.NAME]"),
        ];
        assert!(named.iter().any(|form| reference.contains(form)), "{key}");
    }
}

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

#[test]
fn a_surface_that_misses_the_domain_is_noted() {
    let planes = [
        ("through = [0, 0, 10], dip_deg = 1", Some("above")),
        ("through = [0, 0, -70], dip_deg = 1", Some("below")),
        // 400 m to the east it has fallen by 7 m.
        ("through = [0, 0, 6], dip_deg = 1", None),
    ];
    for (plane, expected) in planes {
        let text = SHOREFACE.replace("through = [0, 0, -1], dip_deg = 1", plane);
        let model = check(&text, &[]).unwrap();
        let said = model.notes.first().map(|note| note.message.clone());
        match expected {
            Some(word) => assert!(said.unwrap_or_default().contains(word), "{plane}"),
            None => assert_eq!(said, None, "{plane}"),
        }
    }
}
