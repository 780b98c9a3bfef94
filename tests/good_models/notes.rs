//! What is right and probably not meant is noted.

use super::{GOOD, SHOREFACE, check};

#[test]
fn an_ellipsoid_that_cannot_reach_the_domain_is_noted() {
    let nodule = include_str!("../bad_models/nodule.toml");
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
