//! The committed models and the templates.

use clinothem::model::{
    FeatureKind, Format, Model, Profile, Quantity, Selector, Source, TEMPLATES, TrajectorySpec,
};

use super::check;

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
    let toml = include_str!("../../models/channel-belt/channel-belt.toml");
    let value: toml::Value = toml::from_str(toml).unwrap();
    let json = serde_json::to_string_pretty(&value).unwrap();
    let from_json = Model::check(&Source::from_text("belt.json", json, Format::Json))
        .unwrap_or_else(|defects| panic!("{defects}"));
    let from_toml = read("models/channel-belt/channel-belt.toml");
    assert_eq!(from_json.domain.size(), from_toml.domain.size());
    assert_eq!(from_json.features[0].kind, from_toml.features[0].kind);
}

#[test]
fn every_template_is_a_good_model() {
    for template in TEMPLATES {
        check(template.text, &[]).unwrap_or_else(|defects| panic!("{defects}"));
    }
}
