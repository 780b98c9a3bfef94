//! Draws have identities: nothing else changes them.

use super::{BELT, instances, realise};

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
