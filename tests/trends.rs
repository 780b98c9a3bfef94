//! Gradual trends: how much each layer holds, and that a property's mean is what an integral says.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use assembled::{Built, MEANDER, WIDER, from_text, without};
use clinothem::assembly::Engine;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

/// A straight channel with a parabola for its section, in layers.
const CHANNEL: &str = r#"
name = "Channel"
[domain]
x = [0, 300]
y = [0, 100]
z = [-20, 0]
facies = "silt"
[facies.silt]
[facies.sand]
[facies.gravel]
[[feature]]
id = "channel"
kind = "channel"
facies = "sand"
width = 50
depth = 6
top = -6
section = { degree = 2, points = [[-0.5, 0], [0, -2], [0.5, 0]] }
trajectory = { kind = "line", from = [-150, 50], to = [450, 50] }
[[feature]]
id = "layer"
kind = "trend"
parent = "channel"
facies = "sand"
"#;

/// Between a level base and a dipping top: 10 m thick at x = 0, 4 m at x = 300.
const UNIT: &str = r#"
name = "Unit"
[domain]
x = [0, 300]
y = [0, 100]
z = [-20, 0]
facies = "silt"
[facies.silt]
[facies.sand]
[[feature]]
id = "unit"
kind = "horizon"
facies = "sand"
surface = { level = -15 }
[[feature]]
id = "layer"
kind = "trend"
parent = "unit"
facies = "sand"
steps = 3
[[feature]]
id = "cover"
kind = "horizon"
facies = "silt"
surface = { grid = { x = [0, 300], y = [0, 100], heights = [[-5, -11], [-5, -11]] } }
"#;

fn built(text: &str, overrides: &[&str]) -> Built {
    let model = from_text(text, overrides);
    Built::new(model, &Selection::default(), Engine::Partition).unwrap()
}

/// A property of a volume that is one number.
fn scalar(built: &Built, name: &str, property: &str) -> f64 {
    let rock = &built.realisation.properties[built.volume(name)];
    rock.scalar(property)
        .unwrap_or_else(|| panic!("{name} has no {property}"))
}

#[test]
fn the_mean_of_a_property_in_layers_of_a_parabola_tends_to_that_of_the_trend() {
    // Width at a height f above the thalweg is √f of the top's: the mean of f is ∫ f √f / ∫ √f = 3/5.
    for (steps, off) in [(1, 5.4e-3), (3, 1.4e-3), (7, 3.6e-4)] {
        let steps_are = format!("feature.layer.steps={steps}");
        let rising = "facies.sand.porosity={ base = 0.1, top = 0.3 }";
        let built = built(CHANNEL, &[&steps_are, rising]);
        let (mut mean, mut whole) = (0.0, 0.0);
        for layer in 1..=steps + 1 {
            let name = format!("channel/layer-{layer}");
            let size = built.size(&name);
            mean += size * scalar(&built, &name, "porosity");
            whole += size;
            let to = |layer: i32| (f64::from(layer) / f64::from(steps + 1)).powf(1.5);
            let share = to(layer) - to(layer - 1);
            let all = 2.0 / 3.0 * 50.0 * 6.0 * 300.0;
            assert!((size / all - share).abs() < 1e-8, "{name}");
        }
        let miss = (mean / whole - (0.1 + 0.2 * 0.6)).abs();
        assert!((miss / off - 1.0).abs() < 0.05, "{steps}: {miss}");
        assert_eq!(built.pieces("channel"), 0);
    }
}

#[test]
fn layers_that_sag_hold_all_of_a_meander_but_for_its_lag() {
    let text = CHANNEL.replace(
        "[[feature]]\nid = \"layer\"",
        "[[feature]]\nid = \"lag\"\nkind = \"lag\"\nparent = \"channel\"\nfacies = \"gravel\"\nthickness_fraction = 0.3\n[[feature]]\nid = \"layer\"",
    );
    let overrides = [MEANDER, WIDER, "feature.layer.sag_fraction=0.6"];
    let whole = Built::new(
        from_text(&text, &overrides),
        &without(&["layer", "lag"]),
        Engine::Partition,
    );
    let bare = Built::new(
        from_text(&text, &overrides),
        &without(&["layer"]),
        Engine::Partition,
    );
    let (whole, bare) = (whole.unwrap(), bare.unwrap());
    let built = built(&text, &overrides);
    let lag = built.size("channel/lag");
    assert!((lag / bare.size("channel/lag") - 1.0).abs() < 1e-7);
    let layers: f64 = (1..=5)
        .map(|layer| built.size(&format!("channel/layer-{layer}")))
        .sum();
    assert!(((layers + lag) / whole.size("channel") - 1.0).abs() < 1e-7);
}

#[test]
fn what_is_drawn_for_the_ends_of_a_trend_is_the_same_in_all_layers() {
    // Porosity by even steps, permeability by even factors; what is not of the trend is the same in all layers, too.
    for (text, parent) in [(CHANNEL, "channel"), (UNIT, "unit")] {
        let model = from_text(
            text,
            &[
                "facies.sand.porosity={ base = { uniform = [0.1, 0.2] }, top = { uniform = [0.25, 0.35] } }",
                "facies.sand.permeability={ base = { uniform = [1, 2] }, top = 1000 }",
                "facies.sand.sw={ uniform = [0.2, 0.4] }",
                "feature.layer.steps=3",
            ],
        );
        let made = Realisation::new(&model, &Selection::default()).unwrap();
        let rock = |layer: usize| {
            let volume = made.volume(&format!("{parent}/layer-{layer}")).unwrap();
            &made.properties[volume]
        };
        let [porosity, k, sw] = ["porosity", "permeability", "sw"].map(|property| {
            [1, 2, 3, 4].map(|layer| rock(layer).get(property).unwrap().numbers()[0])
        });
        let drawn = &rock(1).drawn;
        let of = |name: &str| drawn.iter().find(|one| one.0 == name).unwrap().1;
        let (base, top) = (
            of("properties.porosity.base"),
            of("properties.porosity.top"),
        );
        let lowest = of("properties.permeability.base");
        for (layer, part) in [0.125, 0.375, 0.625, 0.875].into_iter().enumerate() {
            assert!((porosity[layer] - (base + (top - base) * part)).abs() < 1e-15);
            let expected = lowest * (1000.0 / lowest).powf(part);
            assert!((k[layer] / expected - 1.0).abs() < 1e-12, "{k:?}");
            assert_eq!(sw[layer], sw[0]);
            assert_eq!(&rock(layer + 1).drawn, drawn);
        }
    }
}

#[test]
fn a_layer_that_is_left_out_leaves_its_place_to_the_next() {
    let all = built(CHANNEL, &[]);
    let model = from_text(CHANNEL, &[]);
    let selection = without(&["channel/layer-3"]);
    let less = Built::new(model, &selection, Engine::Partition).unwrap();
    let both = all.size("channel/layer-3") + all.size("channel/layer-4");
    assert!((less.size("channel/layer-4") / both - 1.0).abs() < 1e-8);
    let model = from_text(UNIT, &[]);
    let less = Built::new(model, &without(&["unit/layer-3"]), Engine::Partition).unwrap();
    let all = built(UNIT, &[]);
    let both = all.size("unit/layer-2") + all.size("unit/layer-3");
    assert!((less.size("unit/layer-2") / both - 1.0).abs() < 1e-8);
}

#[test]
fn layers_of_a_unit_are_proportional_or_parallel() {
    let proportional = built(UNIT, &[]);
    let unit = 7.0 * 300.0 * 100.0;
    for layer in 1..=4 {
        let size = proportional.size(&format!("unit/layer-{layer}"));
        assert!((size / (unit / 4.0) - 1.0).abs() < 1e-8, "{layer}: {size}");
    }
    // Parallel to the base, 3 m apart: at 9 m the third surface ends where the unit is as thick, 50 m from its thick end.
    let overrides = ["feature.layer.between=base", "feature.layer.spacing=3"];
    let parallel = built(UNIT, &overrides);
    // The unit's thickness is 10 − x/50.
    let above = |height: f64| {
        let reach = (50.0 * (10.0 - height)).min(300.0);
        100.0 * (reach * (10.0 - height) - reach * reach / 100.0)
    };
    let expected = [
        above(0.0) - above(3.0),
        above(3.0) - above(6.0),
        above(6.0) - above(9.0),
        above(9.0),
    ];
    for (at, expected) in expected.into_iter().enumerate() {
        let size = parallel.size(&format!("unit/layer-{}", at + 1));
        assert!(
            (size / expected - 1.0).abs() < 1e-7,
            "{at}: {size} {expected}"
        );
    }
    let overrides = ["feature.layer.between=top", "feature.layer.spacing=3"];
    let parallel = built(UNIT, &overrides);
    let sizes: Vec<f64> = (1..=4)
        .map(|layer| parallel.size(&format!("unit/layer-{layer}")))
        .collect();
    // From the top: 3 m, 3 m but where the unit is thinner than 6 m, and so on.
    let below = |depth: f64| above(depth);
    let expected = [
        below(9.0),
        below(6.0) - below(9.0),
        below(3.0) - below(6.0),
        below(0.0) - below(3.0),
    ];
    for (at, expected) in expected.into_iter().enumerate() {
        assert!((sizes[at] / expected - 1.0).abs() < 1e-5, "{at}: {sizes:?}");
    }
}

#[test]
fn proportional_layers_of_a_unit_that_ends_are_refused() {
    let ends = "feature.cover.surface={ grid = { x = [0, 300], y = [0, 100], heights = [[-5, -16], [-5, -16]] } }";
    let model = from_text(UNIT, &[ends]);
    let error = Realisation::new(&model, &Selection::default()).unwrap_err();
    let said = error.to_string();
    assert!(said.contains("its unit ends in the domain"), "{said}");
    let overrides = [
        ends,
        "feature.layer.between=base",
        "feature.layer.spacing=3",
    ];
    let parallel = built(UNIT, &overrides);
    assert!(parallel.size("unit/layer-4") > 0.0);
}
