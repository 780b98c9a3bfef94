//! Partitions of spline bodies against closed forms, and everything that is asked of their result.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

mod bodies;

use std::f64::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock};

use bodies::measured::{self, close, cut, volumes};
use bodies::{Course, cylinder_topology, ellipsoid_topology};
use occt_bridge::{
    BridgeError, Cancel, Classifier, Partition, PartitionOptions, Position, Shape, Solids, Threads,
    area, bounds, box_solid, defects, face_integrals, face_samples, partition, set_threads, solid,
    volume,
};

fn youngest_in_first(partition: &Partition) -> Solids {
    let owners = measured::youngest_in_first(partition);
    partition.merge(&owners).unwrap()
}

/// Volume of one owner, its solids summed.
fn of_owner(solids: &Solids, volumes: &[f64], owner: usize) -> f64 {
    solids
        .solids()
        .iter()
        .zip(volumes)
        .filter(|(s, _)| s.owner == owner)
        .map(|(_, v)| v)
        .sum()
}

#[test]
fn a_cylinder_through_a_box_has_its_closed_form_volume() {
    let r = 1.25;
    let p = cut(&[
        box_solid([0.0, -3.0, -3.0], [10.0, 3.0, 3.0]).unwrap(),
        solid(&cylinder_topology([-1.0, 11.0], [0.3, -0.2], r)).unwrap(),
    ]);
    assert!(p.alerts().is_empty(), "{:?}", p.alerts());
    let solids = youngest_in_first(&p);
    let integrals = face_integrals(&solids, 1e-11, [5.0, 0.0, 0.0], Threads::All).unwrap();
    let v = volumes(&solids, &integrals);
    let bore = PI * r * r * 10.0;
    // The kernel fits the two section circles to within its tolerance: their discs are right to 8e-9, the bore to 3e-9.
    close(of_owner(&solids, &v, 1), bore, 5e-9);
    close(of_owner(&solids, &v, 0), 360.0 - bore, 1e-9);
    // Every face is integrated for itself, to the 1e-11 asked for.
    close(v.iter().sum(), 360.0, 5e-11);
    assert!(defects(&solids, Threads::All).unwrap().is_empty());
    // The wall of the bore is shared; its area is known too.
    let shared: f64 = solids
        .faces()
        .iter()
        .zip(&integrals)
        .filter(|(f, _)| f.solids.len() == 2)
        .map(|(_, i)| i.area)
        .sum();
    close(shared, 2.0 * PI * r * 10.0, 1e-8);
}

#[test]
fn an_ellipsoid_cut_by_a_box_face_has_the_volumes_of_its_caps() {
    let [a, b, c] = [3.0, 2.0, 1.5];
    // The plane x = 1 cuts off a cap of height h = 2 of the unit-scaled ellipsoid.
    let p = cut(&[
        box_solid([-5.0, -5.0, -5.0], [1.0, 5.0, 5.0]).unwrap(),
        solid(&ellipsoid_topology([0.0; 3], [a, b, c])).unwrap(),
    ]);
    let solids = youngest_in_first(&p);
    let integrals = face_integrals(&solids, 1e-11, [0.0; 3], Threads::All).unwrap();
    let h = (a - 1.0) / a;
    let cap = PI * h * h * (3.0 - h) / 3.0 * a * b * c;
    let inside = 4.0 / 3.0 * PI * a * b * c - cap;
    let v = volumes(&solids, &integrals);
    // The section curve is fitted to 1e-7; across it the volume is that exact.
    close(of_owner(&solids, &v, 1), inside, 1e-7);
    close(v.iter().sum(), 600.0, 1e-8);
    assert!(defects(&solids, Threads::All).unwrap().is_empty());
}

/// A box of 1000 × 1000 × 60 and channels, the later ones younger.
fn belt() -> Vec<Shape> {
    let course = |y: f64, slope: f64, phase: f64, top: f64| {
        Course {
            x: [-60.0, 1060.0],
            y,
            slope,
            amplitude: 70.0,
            wavelength: 480.0,
            phase,
            top,
            width: 55.0,
            depth: 6.0,
            stations: 32,
            segments: 4,
        }
        .solid()
    };
    vec![
        box_solid([0.0, 0.0, -60.0], [1000.0, 1000.0, 0.0]).unwrap(),
        course(300.0, 0.2, 0.3, -20.0),
        course(600.0, -0.3, 1.9, -22.0),
        course(450.0, 0.1, 4.0, -18.5),
    ]
}

const BLOCK: f64 = 6e7;

/// The belt, cut and merged once for all tests.
fn belt_solids() -> &'static Solids {
    static SOLIDS: OnceLock<Solids> = OnceLock::new();
    SOLIDS.get_or_init(|| youngest_in_first(&cut(&belt())))
}

#[test]
fn crossing_channels_fill_the_block_exactly_and_pass_every_check() {
    let seen = Mutex::new(Vec::new());
    let p = partition(
        &belt(),
        &PartitionOptions::default(),
        &Cancel::new(),
        &|f| seen.lock().unwrap().push(f),
    )
    .unwrap();
    assert!(!p.has_unused_faces());
    let solids = youngest_in_first(&p);
    let integrals = face_integrals(&solids, 1e-9, [500.0, 500.0, -30.0], Threads::All).unwrap();
    let v = volumes(&solids, &integrals);
    assert!(v.iter().all(|v| *v > 0.0));
    close(v.iter().sum(), BLOCK, 1e-9);
    // The same volumes from each solid by itself, and from the owner's point of view: the youngest is whole within the block.
    for (i, v) in v.iter().enumerate() {
        close(
            volume(&solids.shape_of(i).unwrap(), 1e-9).unwrap(),
            *v,
            1e-9,
        );
    }
    // Faces of one owner only: the block's surface.
    let outer: f64 = solids
        .faces()
        .iter()
        .zip(&integrals)
        .filter(|(f, _)| f.solids.len() == 1)
        .map(|(_, i)| i.area)
        .sum();
    close(outer, 2e6 + 4.0 * 6e4, 1e-9);
    for face in solids.faces() {
        assert!(matches!(face.solids.len(), 1 | 2));
    }
    assert!(defects(&solids, Threads::All).unwrap().is_empty());
    assert_eq!(
        p.crossing_arguments(),
        [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    );
    for cell in p.cells() {
        for (face, reversed) in &cell.faces {
            for origin in &p.faces()[*face].origins {
                assert_eq!(
                    cell.inside.contains(&origin.argument),
                    *reversed != origin.same_orientation
                );
            }
        }
    }
    // Progress never falls and gets far.
    let seen = seen.into_inner().unwrap();
    assert!(seen.windows(2).all(|w| w[0] <= w[1]) && *seen.last().unwrap() > 0.9);
}

#[test]
fn solids_go_through_bytes_exactly() {
    let solids = belt_solids();
    let bytes = solids.to_bytes().unwrap();
    let back = Solids::from_bytes(&bytes).unwrap();
    assert_eq!(solids.solids(), back.solids());
    assert_eq!(solids.faces(), back.faces());
    assert_eq!(solids.edge_count().unwrap(), back.edge_count().unwrap());
    assert!(back.to_bytes().unwrap() == bytes);
    let integrals =
        |s: &Solids| face_integrals(s, 1e-9, [500.0, 500.0, -30.0], Threads::All).unwrap();
    assert_eq!(integrals(solids), integrals(&back));
    assert!(defects(&back, Threads::All).unwrap().is_empty());
    // Faces are numbered the same way in the shapes and in the tables.
    let of_face = integrals(&back);
    for (i, solid) in back.solids().iter().enumerate() {
        let by_table: f64 = solid.faces.iter().map(|(f, _)| of_face[*f].area).sum();
        close(
            area(&back.shape_of(i).unwrap(), 1e-9).unwrap(),
            by_table,
            1e-9,
        );
    }
}

#[test]
fn broken_bytes_are_an_input_error() {
    let bytes = youngest_in_first(&cut(&[box_solid([0.0; 3], [1.0; 3]).unwrap()]))
        .to_bytes()
        .unwrap();
    for broken in [
        &bytes[..0],
        &bytes[..7],
        &bytes[..40],
        &bytes[1..],
        &bytes[..bytes.len() - 1],
    ] {
        assert!(matches!(
            Solids::from_bytes(broken),
            Err(BridgeError::Input { .. })
        ));
    }
    let mut garbage = bytes.clone();
    let end = garbage.len();
    garbage[end - 2000] ^= 1;
    let error = Solids::from_bytes(&garbage).unwrap_err();
    assert!(error.to_string().contains("checksum"), "{error}");
    assert!(Shape::from_bytes(b"nothing at all").is_err());
    let shape = box_solid([0.0; 3], [1.0; 3]).unwrap();
    let back = Shape::from_bytes(&shape.to_bytes().unwrap()).unwrap();
    close(volume(&back, 1e-9).unwrap(), 1.0, 1e-12);
}

#[test]
fn serial_and_parallel_runs_give_the_same_bytes() {
    let run = |threads| {
        let options = PartitionOptions {
            threads,
            fuzzy: None,
        };
        let p = partition(&belt(), &options, &Cancel::new(), &|_| ()).unwrap();
        youngest_in_first(&p).to_bytes().unwrap()
    };
    let serial = run(Threads::One);
    assert!(serial == run(Threads::All));
    assert!(serial == run(Threads::All));
}

#[test]
fn a_partition_that_is_cancelled_while_it_runs_gives_no_result() {
    let cancel = Cancel::new();
    let begun = AtomicBool::new(false);
    let result = partition(&belt(), &PartitionOptions::default(), &cancel, &|f| {
        if f > 0.1 {
            begun.store(true, Ordering::Relaxed);
            cancel.cancel();
        }
    });
    assert_eq!(result.unwrap_err(), BridgeError::Cancelled);
    assert!(begun.into_inner(), "it never ran");
}

#[test]
fn samples_lie_on_their_face_with_its_solids_on_either_side() {
    let solids = belt_solids();
    let samples = face_samples(solids, 3, Threads::All).unwrap();
    assert_eq!(samples, face_samples(solids, 3, Threads::One).unwrap());
    let mut classifiers: Vec<_> = (0..solids.solids().len())
        .map(|i| Classifier::new(&solids.shape_of(i).unwrap()).unwrap())
        .collect();
    let mut sampled = vec![0; solids.faces().len()];
    for sample in &samples {
        sampled[sample.face] += 1;
        let step = |d: f64| std::array::from_fn(|i| sample.point[i] + d * sample.normal[i]);
        for (s, classifier) in classifiers.iter_mut().enumerate() {
            let Some((_, reversed)) = solids.solids()[s].faces.iter().find(|f| f.0 == sample.face)
            else {
                assert_ne!(
                    classifier.contains(sample.point, 1e-6).unwrap(),
                    Position::In
                );
                continue;
            };
            assert_eq!(
                classifier.contains(sample.point, 1e-5).unwrap(),
                Position::On
            );
            let inwards = if *reversed { 1e-3 } else { -1e-3 };
            assert_eq!(
                classifier.contains(step(inwards), 1e-7).unwrap(),
                Position::In
            );
            assert_eq!(
                classifier.contains(step(-inwards), 1e-7).unwrap(),
                Position::Out
            );
        }
    }
    assert!(sampled.iter().all(|n| *n >= 1), "{sampled:?}");
    assert!(face_samples(solids, 0, Threads::All).unwrap().is_empty());
}

#[test]
fn a_classifier_tells_in_from_out_and_refuses_what_is_no_point() {
    let mut c =
        Classifier::new(&solid(&ellipsoid_topology([0.0; 3], [3.0, 2.0, 1.0])).unwrap()).unwrap();
    for i in 0..200 {
        let t = f64::from(i);
        let p: [f64; 3] = [
            4.0 * (0.7 * t).sin(),
            3.0 * (1.3 * t).sin(),
            2.0 * (2.1 * t).sin(),
        ];
        let level = (p[0] / 3.0).powi(2) + (p[1] / 2.0).powi(2) + p[2].powi(2);
        if (level - 1.0).abs() < 1e-3 {
            continue;
        }
        let exact = if level < 1.0 {
            Position::In
        } else {
            Position::Out
        };
        assert_eq!(c.contains(p, 1e-7).unwrap(), exact, "{p:?}");
    }
    assert_eq!(c.contains([3.0, 0.0, 0.0], 1e-6).unwrap(), Position::On);
    assert!(c.contains([f64::NAN, 0.0, 0.0], 1e-7).is_err());
    assert!(c.contains([0.0; 3], -1.0).is_err());
    let mut t = ellipsoid_topology([0.0; 3], [1.0; 3]);
    t.tolerance = 1e-7;
    assert!(Classifier::new(&occt_bridge::faces(&t).unwrap()).is_err());
}

#[test]
fn integrals_and_bounds_refuse_what_cannot_be_measured() {
    let solids = youngest_in_first(&cut(&[box_solid([0.0; 3], [1.0; 3]).unwrap()]));
    for eps in [0.0, -1.0, 0.5, f64::NAN] {
        assert!(face_integrals(&solids, eps, [0.0; 3], Threads::One).is_err());
        assert!(volume(&solids.compound().unwrap(), eps).is_err());
        assert!(area(&solids.compound().unwrap(), eps).is_err());
    }
    assert!(face_integrals(&solids, 1e-6, [f64::NAN; 3], Threads::One).is_err());
    let face = solids.face_shape(0).unwrap();
    assert!(
        volume(&face, 1e-9)
            .unwrap_err()
            .to_string()
            .contains("no solid")
    );
    close(area(&face, 1e-9).unwrap(), 1.0, 1e-12);
    assert!(solids.shape_of(1).is_err() && solids.face_shape(6).is_err());
    // Tight, though the poles reach further.
    let b = bounds(&solid(&cylinder_topology([0.0, 1.0], [0.0, 0.0], 2.0)).unwrap()).unwrap();
    assert!(
        (b.max[1] - 2.0).abs() < 1e-6 && (b.min[2] + 2.0).abs() < 1e-6,
        "{b:?}"
    );
}

#[test]
fn the_number_of_threads_is_checked() {
    assert!(set_threads(0).is_err());
}
