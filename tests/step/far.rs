//! Models far from the origin: readers count in millimetres, where neighbouring numbers are farther apart than points that they
//! take for one.

use std::collections::BTreeMap;

use clinothem::assembly::Engine;
use clinothem::export::step::{Protocol, write_assembly, write_shared, write_surfaces};
use clinothem::model::selection::Selection;
use occt_bridge::{LengthUnit, ShapeKind, volume};

use super::assembled::{Built, checked, source};
use super::entities::{Entities, reals};
use super::{Written, assert_valid, near};

const UNITS: [(LengthUnit, f64); 2] = [(LengthUnit::Metre, 1.0), (LengthUnit::Millimetre, 1e3)];
const CHANNELS: &str = include_str!("../../models/far/channels.toml");
const STRATA: &str = include_str!("../../models/far/strata.toml");
/// What the reader's integrals over trimmed, curved faces are good to, near the origin as well.
const INTEGRALS: f64 = 3e-8;
/// What makes the channels near the origin of the far ones.
const NEAR: [&str; 4] = [
    "domain.x=[0, 1000]",
    "domain.y=[0, 800]",
    "feature.belt.trajectory.center=[500, {uniform = [250, 550]}]",
    "feature.nodule.center=[{uniform = [200, 800]}, {uniform = [200, 600]}, {uniform = [-2040, -2020]}]",
];
/// What makes a basin that begins at the origin of the far one.
const AT_ORIGIN: [&str; 6] = [
    "domain.x=[0, 300000]",
    "domain.y=[0, 200000]",
    "feature.lower.surface.grid.x=[0, 300000]",
    "feature.lower.surface.grid.y=[0, 200000]",
    "feature.upper.surface.grid.x=[0, 300000]",
    "feature.upper.surface.grid.y=[0, 200000]",
];

fn built(text: &str, overrides: &[&str]) -> Built {
    let model = super::assembled::from_text(text, overrides);
    Built::new(model, &Selection::default(), Engine::Partition).unwrap()
}

fn assembly(built: &Built) -> Written {
    let (model, realisation) = (&built.model, &built.realisation);
    Written::save(|path| write_assembly(path, model, realisation, &built.assembly, Protocol::Ap214))
}

/// Both flavours hold the solids that were built, valid and as large, for readers in metres and in millimetres.
fn assert_read(built: &Built, relative: f64) {
    assert_assembly_read(built, relative);
    let (model, realisation) = (&built.model, &built.realisation);
    let shared = Written::save(|path| {
        write_shared(path, model, realisation, &built.assembly, Protocol::Ap214)
    });
    Entities::of(&shared.text()).check();
    for (unit, scale) in UNITS {
        let [all] = &shared.read_in(unit)[..] else {
            panic!("not one part")
        };
        let count = |kind| all.shape.count(kind).unwrap();
        assert_eq!(count(ShapeKind::Solid), built.solids());
        assert_eq!(count(ShapeKind::Face), built.assembly.measured.faces);
        let size: f64 = built.assembly.measured.pieces.iter().map(|p| p.size).sum();
        let read = volume(&all.shape, asked(relative)).unwrap();
        near(read / scale.powi(3), size, relative);
    }
}

/// What is asked of the reader's integrals, which take long for less.
fn asked(relative: f64) -> f64 {
    (0.1 * relative).max(1e-10)
}

fn assert_assembly_read(built: &Built, relative: f64) {
    let written = assembly(built);
    Entities::of(&written.text()).check();
    for (unit, scale) in UNITS {
        let mut parts: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for part in written.read_in(unit) {
            assert_eq!(part.shape.count(ShapeKind::Solid).unwrap(), 1);
            assert_valid(std::slice::from_ref(&part.shape));
            let size = volume(&part.shape, asked(relative)).unwrap() / scale.powi(3);
            let name = part.name.split('#').next().unwrap().to_owned();
            parts.entry(name).or_default().push(size);
        }
        for (at, rules) in built.realisation.volumes.iter().enumerate() {
            let told = built.assembly.measured.pieces_of(at);
            let read = parts.remove(&rules.name).unwrap_or_default();
            assert_eq!(read.len(), told.len(), "{} in {unit:?}", rules.name);
            for (size, piece) in read.iter().zip(told) {
                near(*size, piece.size, relative);
            }
        }
        assert!(parts.is_empty(), "{parts:?}");
    }
}

#[test]
fn a_basin_in_world_coordinates_is_read_as_it_was_built() {
    assert_read(&built(STRATA, &[]), 1e-9);
}

#[test]
fn a_basin_of_300_km_at_the_origin_is_read_as_it_was_built() {
    assert_read(&built(STRATA, &AT_ORIGIN), 1e-9);
}

#[test]
fn crossing_channels_in_world_coordinates_are_read_as_they_were_built() {
    let selection = super::assembled::without(&["nodule"]);
    let model = super::assembled::from_text(CHANNELS, &[]);
    let built = Built::new(model, &selection, Engine::Partition).unwrap();
    assert_read(&built, INTEGRALS);
}

#[test]
fn ellipsoids_in_world_coordinates_are_read_as_they_were_built() {
    let selection = super::assembled::without(&["belt"]);
    let model = super::assembled::from_text(CHANNELS, &[]);
    let built = Built::new(model, &selection, Engine::Partition).unwrap();
    // Some are wholly enclosed, which the shared flavour cannot tell.
    assert_assembly_read(&built, INTEGRALS);
}

#[test]
fn channels_are_the_same_solids_far_from_the_origin_and_near_it() {
    let (far, near_by) = (built(CHANNELS, &[]), built(CHANNELS, &NEAR));
    assert_eq!(far.solids(), near_by.solids());
    assert!(far.solids() > 8);
    for (volume, rules) in far.realisation.volumes.iter().enumerate() {
        let pieces = [&far, &near_by].map(|one| one.assembly.measured.pieces_of(volume));
        assert_eq!(pieces[0].len(), pieces[1].len(), "{}", rules.name);
        for (one, other) in pieces[0].iter().zip(pieces[1]) {
            // Control points in world coordinates are rounded to a nanometre.
            near(one.size, other.size, 1e-8);
        }
    }
    assert_eq!(far.assembly.measured.faces, near_by.assembly.measured.faces);
    assert_eq!(far.assembly.measured.edges, near_by.assembly.measured.edges);
}

/// Coordinates of the points of a file, by number.
fn points(entities: &Entities) -> BTreeMap<usize, [f64; 3]> {
    let of = |number: usize| {
        let point: Result<[f64; 3], _> = reals(entities.body(number)).try_into();
        point.ok().map(|point| (number, point))
    };
    let named = entities.named("CARTESIAN_POINT");
    named.into_iter().filter_map(of).collect()
}

#[test]
fn world_coordinates_times_a_thousand_are_exact_and_less_than_a_micrometre_from_where_they_were() {
    let built = built(CHANNELS, &[]);
    let text = assembly(&built).text();
    let entities = Entities::of(&text);
    for point in points(&entities).into_values() {
        for (axis, step) in [(0, 2.0_f64.powi(-27)), (1, 2.0_f64.powi(-23))] {
            let multiple = point[axis] / step;
            assert_eq!(multiple, multiple.round(), "{point:?}");
            // 1000 = 125 · 8: the product has seven bits more.
            let millimetres = 1000.0 * point[axis];
            assert_eq!(millimetres / 1000.0, point[axis]);
            assert_eq!(millimetres.mul_add(-1.0, 1000.0 * point[axis]), 0.0);
        }
    }
    // Every control point of a base is there, moved by less.
    let places: Vec<[f64; 3]> = points(&entities).into_values().collect();
    let sheets = built.realisation.instances[0].body.sheets().unwrap();
    let has = |wanted: &glam::DVec3| {
        let near = |place: &[f64; 3]| (glam::DVec3::from_array(*place) - *wanted).abs();
        places.iter().any(|place| near(place).max_element() < 1e-6)
    };
    let found = sheets[0]
        .1
        .net()
        .iter()
        .filter(|wanted| has(wanted))
        .count();
    assert!(found > 50, "{found}");
}

#[test]
fn curves_of_far_edges_begin_and_end_at_the_vertices() {
    for text in [CHANNELS, STRATA] {
        let written = assembly(&built(text, &[]));
        let entities = Entities::of(&written.text());
        let points = points(&entities);
        let mut seen = 0;
        for edge in entities.named("EDGE_CURVE") {
            let [start, end, curve] = entities.below(edge)[..] else {
                panic!("{}", entities.body(edge))
            };
            let in_space = entities.below(curve)[0];
            // Polynomial, too: a quotient is not exact.
            assert!(
                entities
                    .body(in_space)
                    .starts_with("B_SPLINE_CURVE_WITH_KNOTS(")
            );
            let poles = entities.below(in_space);
            let ends = [poles[0], poles[poles.len() - 1]].map(|pole| points[&pole]);
            let vertices = [start, end].map(|vertex| points[&entities.below(vertex)[0]]);
            assert_eq!(ends, vertices);
            seen += 1;
        }
        assert!(seen > 30);
    }
}

#[test]
fn near_the_origin_nothing_is_rounded_and_the_accuracy_is_a_tenth_of_a_micrometre() {
    let model = checked(&source("quickstart/quickstart"));
    let near_by = Built::new(model, &Selection::default(), Engine::Partition).unwrap();
    let text = assembly(&near_by).text();
    assert!(text.contains("LENGTH_MEASURE(1.E-07)"));
    let places: Vec<[f64; 3]> = points(&Entities::of(&text)).into_values().collect();
    let sheets = near_by.realisation.instances[0].body.sheets().unwrap();
    let net = sheets.iter().flat_map(|(_, sheet)| sheet.net());
    let exact = net.filter(|wanted| places.contains(&wanted.to_array()));
    assert!(exact.count() > 5);
    // Far away it says how far its points may be off.
    let text = assembly(&built(STRATA, &[])).text();
    let told = text.split("LENGTH_MEASURE(").nth(1).unwrap();
    let told: f64 = told[..told.find(')').unwrap()]
        .replace(".E", "E")
        .parse()
        .unwrap();
    assert!(told > 1e-6 && told < 1e-4, "{told}");
}

#[test]
fn surfaces_in_world_coordinates_are_read_in_millimetres() {
    let built = built(CHANNELS, &[]);
    let (model, realisation) = (&built.model, &built.realisation);
    let written = Written::save(|path| write_surfaces(path, model, realisation, Protocol::Ap214));
    let count = |unit: LengthUnit| written.read_in(unit).len();
    assert_eq!(count(LengthUnit::Millimetre), count(LengthUnit::Metre));
    // A base and a top of six channels, three skins.
    assert_eq!(count(LengthUnit::Millimetre), 15);
}
