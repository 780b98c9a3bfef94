//! A number of threads of one's own. It holds for the process, so this file has one test.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

mod bodies;

use occt_bridge::{Cancel, PartitionOptions, Threads, box_solid, partition, set_threads};

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let course = |y: f64, phase: f64| {
        bodies::Course {
            x: [-60.0, 560.0],
            y,
            slope: 0.0,
            amplitude: 50.0,
            wavelength: 400.0,
            phase,
            top: -15.0 + y / 100.0,
            width: 50.0,
            depth: 6.0,
            stations: 20,
            segments: 2,
        }
        .solid()
    };
    let arguments = [
        box_solid([0.0, 0.0, -40.0], [500.0, 500.0, 0.0]).unwrap(),
        course(200.0, 0.3),
        course(240.0, 2.5),
    ];
    let run = || {
        let options = PartitionOptions {
            threads: Threads::All,
            fuzzy: None,
        };
        let p = partition(&arguments, &options, &Cancel::new(), &|_| ()).unwrap();
        let owner: Vec<_> = p.cells().iter().map(|c| c.inside.last().copied()).collect();
        p.merge(&owner).unwrap().to_bytes().unwrap()
    };
    assert!(set_threads(0).is_err() && set_threads(5000).is_err());
    let before = run();
    for count in [1, 3, 2] {
        set_threads(count).unwrap();
        assert!(before == run(), "{count}");
    }
}
