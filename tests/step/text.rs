//! How names and numbers are spelt.

use occt_bridge::box_solid;
use proptest::prelude::*;

use super::entities::{Entities, reals};
use super::{Written, document, part};

#[test]
fn names_with_quotes_backslashes_and_other_letters_come_back() {
    let names = [
        "O'Brien's",
        "a\\b",
        "Sandkörper",
        "Ω 1",
        "𝔘 2",
        "Brent Næss 上部",
    ];
    let shapes: Vec<_> = (0..names.len())
        .map(|i| box_solid([3.0 * i as f64, 0.0, 0.0], [3.0 * i as f64 + 1.0, 1.0, 1.0]).unwrap())
        .collect();
    let nodes = names.iter().enumerate();
    let nodes = nodes.map(|(i, name)| part(name, [7; 3], vec![i])).collect();
    let written = Written::assembly(&document(nodes), &shapes);
    let text = written.text();
    assert!(text.is_ascii());
    assert!(text.contains("'O''Brien''s'") && text.contains("'a\\\\b'"));
    assert!(text.contains("'Sandk\\X2\\00F6\\X0\\rper'"));
    assert!(text.contains("'\\X4\\0001D518\\X0\\ 2'"));
    assert!(text.contains("'Brent N\\X2\\00E6\\X0\\ss \\X2\\4E0A90E8\\X0\\'"));
    let read: Vec<_> = written.read().into_iter().map(|p| p.name).collect();
    assert_eq!(read[0], names[0]);
    // The kernel's reader keeps a double backslash, and takes \\X4\\ for text.
    assert_eq!(read[2..4], names[2..4]);
    assert_eq!(read[5], names[5]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn every_coordinate_is_the_number_that_was_given(
        x in prop::num::f64::NORMAL.prop_filter("a box has a size", |x| x.abs() < 1e5),
        size in 1e-3..1e5_f64,
    ) {
        let low = [x, 0.5, -3e-7];
        let high = low.map(|x| x + size);
        let shape = box_solid(low, high).unwrap();
        let entities = Entities::of(&Written::assembly(&super::parts(1), &[shape]).text());
        for vertex in entities.named("VERTEX_POINT") {
            let point = reals(entities.body(entities.below(vertex)[0]));
            for axis in 0..3 {
                prop_assert!(point[axis] == low[axis] || point[axis] == high[axis]);
            }
        }
    }
}
