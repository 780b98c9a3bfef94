//! Features that are like another one.

use clinothem::model::{FeatureKind, Format, Model, Source};

use super::{Edit, check_edits, refused};

/// Two channels, the younger like the older.
pub(crate) const LIKE: &str = r#"
name = "Alike"
[domain]
x = [0, 600]
y = [0, 400]
z = [-20, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "old"
kind = "channel"
name = "The older one"
enabled = false
facies = "sand"
width = { uniform = [20, 60] }
depth = 4
top = -5
removes = "older"
trajectory = { kind = "sine-generated", amplitude = 50, wavelength = 400, azimuth_deg = 80 }
[[feature]]
id = "young"
like = "old"
depth = 6
"#;

/// The same, edited.
#[rustfmt::skip]
const LIKE_EDITS: &[Edit] = &[
    ("like = \"old\"", "like = ▸\"odl\"", &["it is like \"odl\", which is not a feature", "did you mean \"old\"?"]),
    ("like = \"old\"", "like = ▸\"young\"", &["this feature is like itself", "one before it in the list"]),
    ("like = \"old\"", "like = ▸5", &["like`: expected text, found the number 5"]),
    ("like = \"old\"", "like = \"old\"\nkind = ▸\"channel\"", &["has a `kind` of its own", "leave `kind` out"]),
    ("like = \"old\"", "like = \"old\"\n▸widht = 5", &["unknown key `widht`", "width"]),
    ("depth = 6", "depth = ▸-6", &["the depth of feature \"young\" is -6"]),
    ("id = \"old\"\n", "id = \"old\"\nlike = ▸\"young\"\n", &["the feature \"young\" comes later in the list"]),
];

#[test]
fn broken_likenesses_are_refused() {
    check_edits(LIKE_EDITS, LIKE, "like.toml", Format::Toml);
}

fn model(text: &str, overrides: &[&str]) -> Model {
    let mut source = Source::from_text("like.toml", text, Format::Toml);
    for one in overrides {
        source.set(*one);
    }
    Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"))
}

#[test]
fn what_is_wrong_in_shared_keys_is_told_once_where_it_stands() {
    let text = LIKE.replace("uniform = [20, 60]", "uniform = [60, 20]");
    let defects = refused("like.toml", &text, Format::Toml);
    assert_eq!(defects.count(), 1, "{defects}");
    let line = text
        .lines()
        .position(|line| line.starts_with("width"))
        .unwrap()
        + 1;
    assert_eq!(defects.iter().next().unwrap().place().line, line);
}

#[test]
fn a_feature_has_what_it_is_like_but_its_own_name_and_place_in_the_list() {
    let both = model(LIKE, &[]);
    let written = LIKE.replace(
        "like = \"old\"",
        "kind = \"channel\"\nfacies = \"sand\"\nwidth = { uniform = [20, 60] }\ntop = -5\nremoves = \"older\"\n\
         trajectory = { kind = \"sine-generated\", amplitude = 50, wavelength = 400, azimuth_deg = 80 }",
    );
    assert_eq!(both.features, model(&written, &[]).features);
    assert!(both.features[1].enabled && both.features[1].title.is_none());
    // A third one that is like the second has what that has.
    let third = format!("{LIKE}[[feature]]\nid = \"third\"\nlike = \"young\"\npreserve = true\n");
    let third = model(&third, &[]);
    assert_eq!(third.features[2].kind, third.features[1].kind);
}

#[test]
fn overrides_of_the_older_one_change_both_and_of_the_younger_one_that_alone() {
    let azimuths = |overrides: &[&str]| -> Vec<String> {
        let model = model(LIKE, overrides);
        let kinds = model.features.iter().map(|feature| match &feature.kind {
            FeatureKind::Channel(channel) => format!("{:?}", channel.trajectory),
            other => panic!("{other:?}"),
        });
        kinds.collect()
    };
    let [old, young] = azimuths(&["feature.old.trajectory.azimuth_deg=33"])
        .try_into()
        .unwrap();
    assert!(old == young && old.contains("33"), "{old}");
    let [old, young] = azimuths(&["feature.young.trajectory.azimuth_deg=33"])
        .try_into()
        .unwrap();
    assert!(!old.contains("33") && young.contains("33"), "{old} {young}");
    // Into a list, too.
    let text = LIKE.replace("{ uniform = [20, 60] }", "[[0, 20], [1, 60]]");
    let model = model(&text, &["feature.young.width.2.2=50"]);
    let widths = model.features.iter().map(|feature| match &feature.kind {
        FeatureKind::Channel(channel) => format!("{:?}", channel.width),
        other => panic!("{other:?}"),
    });
    let widths: Vec<String> = widths.collect();
    assert!(
        widths[0].contains("60") && widths[1].contains("50"),
        "{widths:?}"
    );
}
