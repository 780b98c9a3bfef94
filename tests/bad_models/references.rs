//! References between features.

use clinothem::model::Format;

use super::{Edit, check_edits};

const REFERENCES: &str = include_str!("reference.toml");

/// Edits of features that refer to others.
#[rustfmt::skip]
const EDITS: &[Edit] = &[
    ("{ like = \"valley-2\" }", "{ like = ▸\"vally-2\" }", &["the trajectory of feature \"lone\" names \"vally-2\", but no feature is called \"vally-2\"", "name a channel: stream, valley"]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"vally\" }", &["no feature is called \"vally\"", "did you mean \"valley\"?"]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"valley-4\" }", &["there is no number 4 of \"valley\"", "\"valley-1\" to \"valley-3\""]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"valley-02\" }", &["there is no number 2 of \"valley\""]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"lone-1\" }", &["there is no number 1 of \"lone\"", "name the feature: \"lone\""]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"valley\" }", &["names \"valley\", and it is not said which of the 3 instances of feature \"valley\"", "name one of them: \"valley-1\""]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"nodule\" }", &["names \"nodule\", which is of the kind ellipsoid", "name a channel"]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"unit\" }", &["which is of the kind horizon", "name a channel"]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"lone\" }", &["the trajectory of feature \"lone\" names itself"]),
    ("{ like = \"valley-2\" }", "{ like = ▸3 }", &["like"]),
    ("{ like = \"valley-2\" }", "{ like = \"valley-2\", offset = ▸\"near\" }", &["offset of feature \"lone\""]),
    ("{ like = \"valley-2\" }", "{ like = \"valley-2\", ▸kind = \"line\" }", &["unknown key `kind` in the trajectory of feature \"lone\""]),
    ("{ like = \"valley-2\" }", "{ like = \"valley-2\", ▸ofset = 3 }", &["unknown key `ofset`", "did you mean `offset`?"]),
    ("{ like = \"valley-2\" }", "{ like = ▸\"unit/valley-2\" }", &["\"valley\" is not a part of \"unit\"", "by its own id: \"valley\""]),
    ("{ like = \"unit/rill-2\" }", "{ like = ▸\"unit/rill\" }", &["which of the 2 instances of feature \"rill\"", "\"rill-1\""]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [6, 4, 2]\nalong = ▸\"valley\"", &["feature \"nodule\" goes along \"valley\", but nothing of the kind ellipsoid does so", "leave `along` out"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [6, 4, 2]\nalong = ▸\"valey\"", &["feature \"nodule\" goes along \"valey\", which is not a feature", "did you mean \"valley\"?"]),
    ("semi_axes = [6, 4, 2]", "semi_axes = [6, 4, 2]\nparent = \"unit\"\nalong = ▸\"valley\"", &["feature \"nodule\" has the parent \"unit\", and `along`, too", "keep one"]),
];

#[test]
fn broken_references_are_refused() {
    check_edits(EDITS, REFERENCES, "reference.toml", Format::Toml);
}

#[test]
fn features_that_are_made_by_each_other_are_refused_with_the_circle() {
    let edits: &[Edit] = &[(
        "trajectory = { kind = \"line\", azimuth_deg = 90 }\n\n[[feature]]\nid = \"lone\"",
        "trajectory = { like = ▸\"lone\" }\n\n[[feature]]\nid = \"lone\"",
        &["made by each other in a circle: valley → lone → valley"],
    )];
    check_edits(edits, REFERENCES, "reference.toml", Format::Toml);
    // What lies in a feature is made after it.
    let edits: &[Edit] = &[(
        "trajectory = { kind = \"line\", azimuth_deg = 90 }\n\n[[feature]]\nid = \"lone\"\nkind = \"channel\"",
        "trajectory = { like = ▸\"valley-1/lone\" }\n\n[[feature]]\nid = \"lone\"\nkind = \"channel\"\nparent = \"valley\"",
        &["made by each other in a circle: valley → lone → valley"],
    )];
    let good = REFERENCES.replace(
        "{ like = \"valley-2\" }",
        "{ kind = \"line\", azimuth_deg = 90 }",
    );
    check_edits(edits, &good, "reference.toml", Format::Toml);
}
