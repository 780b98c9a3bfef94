//! Triangles of whole models: closed, as far from the exact surfaces as was asked, and with the volumes of the exact solids.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;
#[path = "../examples/random_models/models/mod.rs"]
#[allow(
    dead_code,
    unused_imports,
    reason = "shared with the example that writes them"
)]
mod models;

use std::path::Path;

use assembled::{Built, checked};
use clinothem::assembly::{Engine, Options, proof};
use clinothem::export::mesh::Triangulation;
use clinothem::mesh::{Fineness, Support};
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};
use glam::{DVec2, DVec3};
use models::Kind;

/// The angle of pictures (rad).
const ANGLE: f64 = 0.3;

fn built(model: Model) -> Option<Built> {
    let options = Options {
        // What has solids of other programs is made by the general fuse.
        engine: Engine::Auto,
        child: None,
        threads: 0,
        proof: proof::Level::Fast,
        seed: model.seed,
    };
    Built::with(model, &Selection::default(), &options).ok()
}

fn diagonal(built: &Built) -> f64 {
    built.plan.low().distance(built.plan.high())
}

/// A little more than the chord: triangles are asked in their middles and those of their sides alone.
const BETWEEN: f64 = 1.05;

/// All that is promised of a model's triangles; returns how far the sum of all volumes is off, without signs (m³).
fn assert_right(name: &str, built: &Built, chord: f64) -> f64 {
    let fineness = Fineness {
        chord,
        angle: ANGLE,
    };
    let made = Triangulation::new(&built.assembly, &fineness)
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    let (mut off, mut skins) = (0.0, 0.0);
    for (at, piece) in built.assembly.measured.pieces.iter().enumerate() {
        let faces = made.faces_of(&built.assembly, at);
        let whose = &built.realisation.volumes[piece.volume].name;
        let counts = made
            .mesh()
            .closed(&faces)
            .unwrap_or_else(|open| panic!("{name}, {whose}: {open}"));
        // A body may touch itself along an edge, where four of its faces meet; nowhere else.
        let mut uses = std::collections::BTreeMap::new();
        for (face, _) in &faces {
            for of in made.tables().faces[*face].loops.iter().flatten() {
                *uses.entry(of.edge).or_insert(0) += 1;
            }
        }
        if uses.values().all(|count| *count <= 2) {
            assert_eq!(
                counts.touching, 0,
                "{name}, {whose}: a side of four triangles"
            );
            // Handles and voids make it smaller by 2, further shells larger.
            assert_eq!(counts.euler() % 2, 0, "{name}, {whose}");
        }
        let volume = made.mesh().volume(&faces);
        let skin: f64 = made
            .mesh()
            .triangles(&faces)
            .map(|corners| {
                let [a, b, c] = corners.map(|point| made.mesh().points[point]);
                (b - a).cross(c - a).length() / 2.0
            })
            .sum();
        let error = (volume - piece.size).abs();
        assert!(
            error <= chord * skin + 1e-9 * piece.size,
            "{name}, {whose}: {volume} m³ of {}, skin {skin} m², chord {chord}",
            piece.size
        );
        off += error;
        skins += skin;
    }
    assert!(skins > 0.0);
    // Surfaces reach beyond the domain, triangles do not.
    let (low, high) = (built.plan.low() - chord, built.plan.high() + chord);
    let used = made.mesh().faces.iter().flat_map(|face| {
        let corners = face.triangles.as_flattened().iter();
        corners.map(|corner| made.mesh().points[face.corners[*corner].point])
    });
    for point in used {
        assert!(
            point.cmpge(low).all() && point.cmple(high).all(),
            "{name}: {point}"
        );
    }
    let farthest = farthest(&made);
    assert!(
        farthest.0 <= BETWEEN * chord,
        "{name}: {} m at {}, chord {chord}",
        farthest.0,
        farthest.1
    );
    off
}

/// The place of a triangle that is farthest from its exact surface.
fn farthest(made: &Triangulation) -> (f64, DVec3) {
    const SHARES: [[f64; 3]; 5] = [
        [0.5, 0.5, 0.0],
        [0.0, 0.5, 0.5],
        [0.5, 0.0, 0.5],
        [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
        [0.6, 0.25, 0.15],
    ];
    let (mesh, tables) = (made.mesh(), made.tables());
    let mut worst = (0.0, DVec3::ZERO);
    for (face, of) in mesh.faces.iter().zip(&tables.faces) {
        let surface = &tables.surfaces[of.surface];
        for triangle in &face.triangles {
            let corners = triangle.map(|corner| face.corners[corner]);
            for shares in SHARES {
                let mix = |k: usize| shares[k];
                let point: DVec3 = (0..3).map(|k| mix(k) * mesh.points[corners[k].point]).sum();
                let uv: DVec2 = (0..3)
                    .map(|k| mix(k) * DVec2::from_array(corners[k].uv))
                    .sum();
                let mut distance = distance(surface, uv, point);
                if let (Support::Spline(spline), true) = (surface, distance > worst.0) {
                    // Beside a border that method may stop too early; this one does not.
                    let certain = spline.closest(point, 1e-3 * distance).distance;
                    distance = distance.min(certain);
                }
                if distance > worst.0 {
                    worst = (distance, point);
                }
            }
        }
    }
    worst
}

/// The distance of a point to the surface near a place: at most this, by Newton's method in the tangent plane.
fn distance(surface: &Support, mut uv: DVec2, point: DVec3) -> f64 {
    let Support::Spline(spline) = surface else {
        return surface
            .normal(uv)
            .unwrap()
            .dot(point - surface.point(uv))
            .abs();
    };
    let mut least = f64::INFINITY;
    for _ in 0..4 {
        let jet = spline.derivatives(uv.x, uv.y, 1);
        let offset = point - jet[0][0];
        least = least.min(offset.length());
        let (u, v) = (jet[1][0], jet[0][1]);
        let (a, b, c) = (u.dot(u), u.dot(v), v.dot(v));
        let determinant = a * c - b * b;
        if determinant <= 1e-12 * a * c {
            break;
        }
        let (p, q) = (offset.dot(u), offset.dot(v));
        uv += DVec2::new(c * p - b * q, a * q - b * p) / determinant;
        let (from, to) = (spline.knots_u().domain(), spline.knots_v().domain());
        uv = uv.clamp(DVec2::new(from.0, to.0), DVec2::new(from.1, to.1));
    }
    least
}

fn committed(first: char, last: char) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .flat_map(|entry| std::fs::read_dir(entry.unwrap().path()).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    files.sort();
    let mut count = 0;
    for file in files {
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        if !(first..=last).contains(&name.chars().next().unwrap()) {
            continue;
        }
        let model = checked(&Source::read(&file).unwrap());
        let Some(built) = built(model) else {
            panic!("{name} was not assembled");
        };
        let size = diagonal(&built);
        let coarse = assert_right(&name, &built, 1e-3 * size);
        let fine = assert_right(&name, &built, 1e-4 * size);
        // A tenth of the chord is a tenth of the error where triangles follow what bends; less where it bends by less than the larger chord,
        // or where the angle rules.
        let exact = 1e-7 * built.plan.extent.volume();
        assert!(
            fine <= 0.75 * coarse + exact,
            "{name}: {coarse} and {fine} m³"
        );
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn triangles_of_committed_models_close_and_converge_a_to_c() {
    committed('a', 'c');
}

#[test]
fn triangles_of_committed_models_close_and_converge_d_to_l() {
    committed('d', 'l');
}

#[test]
fn triangles_of_committed_models_close_and_converge_m_to_r() {
    committed('m', 'r');
}

#[test]
fn triangles_of_committed_models_close_and_converge_s_to_z() {
    committed('s', 'z');
}

/// Random models of a kind; `CLINOTHEM_RANDOM` says how many, `CLINOTHEM_FIRST` from which seed on.
fn random(kind: Kind) {
    let number = |name: &str, otherwise: u64| {
        std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
    };
    let first = number("CLINOTHEM_FIRST", 1);
    let mut triangulated = 0;
    for seed in first..first + number("CLINOTHEM_RANDOM", 5) {
        let text = toml::to_string(&models::model(kind, seed, false)).unwrap();
        let source = Source::from_text("random.toml", text, Format::Toml);
        // What is refused is another test's business.
        let Ok(model) = Model::check(&source) else {
            continue;
        };
        let Some(built) = built(model) else { continue };
        assert_right(&format!("{kind:?} {seed}"), &built, 2e-4 * diagonal(&built));
        triangulated += 1;
    }
    assert!(triangulated > 0);
}

#[test]
fn triangles_of_generic_random_models_close() {
    random(Kind::Generic);
}

#[test]
fn triangles_of_random_models_in_which_much_coincides_close() {
    random(Kind::Coincident);
}

#[test]
fn triangles_of_random_horizons_from_wells_close() {
    random(Kind::WellTops);
}

#[test]
fn triangles_of_random_sedimentary_models_close() {
    random(Kind::Sedimentary);
}

#[test]
fn triangles_of_random_sedimentary_models_in_round_numbers_close() {
    random(Kind::RoundSedimentary);
}

#[test]
fn triangles_of_random_models_whose_features_refer_to_others_close() {
    random(Kind::Referring);
}

#[test]
fn triangles_of_random_faulted_models_close() {
    random(Kind::Faulted);
}

#[test]
fn triangles_of_random_models_with_faults_in_round_numbers_close() {
    random(Kind::RoundFaulted);
}
