//! What a selector picks.

use super::*;

#[test]
fn kinds_levels_and_facies_select() {
    let lobe = VolumeRules {
        kind: "lobe".to_owned(),
        ..body("lobe")
    };
    let minor = VolumeRules {
        level: 3,
        ..body("minor")
    };
    let shale = VolumeRules {
        facies: "shale".to_owned(),
        ..body("shale")
    };
    let picks = [
        Pick::Kind("lobe".to_owned()),
        Pick::Level(3),
        Pick::Facies("shale".to_owned()),
    ];
    let young = VolumeRules {
        removes: only(&picks),
        ..body("young")
    };
    check(
        vec![lobe, minor, shale, body("plain"), young],
        &[
            (&["young"], "background"),
            (&["lobe", "young"], "young"),
            (&["minor", "young"], "young"),
            (&["shale", "young"], "young"),
            (&["plain", "young"], "plain"),
        ],
    );
}

#[test]
fn one_instance_can_be_selected_by_its_name_and_all_by_their_feature() {
    let instance = |n: u32| VolumeRules {
        feature: "old".to_owned(),
        ..body(&format!("old-{n}"))
    };
    let one = VolumeRules {
        removes: only(&[id("old-2")]),
        ..body("one")
    };
    check(
        vec![instance(1), instance(2), instance(3), one],
        &[
            (&["old-1", "one"], "old-1"),
            (&["old-2", "one"], "one"),
            (&["old-3", "one"], "old-3"),
        ],
    );
    let all = VolumeRules {
        removes: only(&[id("old")]),
        ..body("all")
    };
    check(
        vec![instance(1), instance(2), body("other"), all],
        &[
            (&["old-1", "all"], "all"),
            (&["old-2", "all"], "all"),
            (&["other", "all"], "other"),
        ],
    );
}
