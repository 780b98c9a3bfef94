//! Wells pass through what the point evaluator says, at depths that closed forms and dense sampling know.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "assembled/checked.rs"]
mod checked;

use std::fmt::Write as _;

use clinothem::features::survey::{Reading, Station, by_angles};
use clinothem::features::well::{Path, Well};
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::wells::log::{Interval, Logger, WellLog};
use clinothem::model::{Format, Model, Source};
use clinothem::nurbs::interpolate::Parametrization;
use glam::DVec3;

const LAYERS: &str = r#"
name = "Layers"
[domain]
x = [0, 1000]
y = [0, 1000]
z = [-100, 0]
facies = "mud"
[facies.mud]
porosity = 0.1
[facies.sand]
porosity = 0.3
permeability = [500, 500, 50]
[[feature]]
id = "lower"
kind = "horizon"
facies = "sand"
surface = { level = -70 }
[[feature]]
id = "upper"
kind = "horizon"
facies = "mud"
surface = { level = -40 }
"#;

/// A model, realised.
struct Made {
    model: Model,
    realisation: Realisation,
    owners: Owners,
}

impl Made {
    fn of(model: Model) -> Self {
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let owners = Owners::new(&realisation).unwrap();
        Self {
            model,
            realisation,
            owners,
        }
    }

    fn text(text: &str) -> Self {
        Self::of(checked::from_text(text, &[]))
    }

    fn log(&self, well: &Well) -> WellLog {
        Logger::new(&self.realisation, &self.owners)
            .unwrap()
            .log(well)
    }

    fn names(&self, log: &WellLog) -> Vec<&str> {
        let name = |volume: Option<usize>| {
            volume.map_or("outside", |volume| {
                self.realisation.volumes[volume].name.as_str()
            })
        };
        log.intervals.iter().map(|one| name(one.volume)).collect()
    }

    fn owner(&self, point: DVec3) -> Option<usize> {
        let owner = self.owners.at(point)?;
        Some(self.realisation.rules.whole(owner))
    }
}

fn straight(from: DVec3, to: DVec3) -> Well {
    let at = |md, point| Station {
        md: Some(md),
        point,
        tangent: None,
    };
    let stations = vec![at(0.0, from), at(from.distance(to), to)];
    Well::new(stations, Path::Spline(Parametrization::ChordLength)).unwrap()
}

#[test]
fn a_slanted_well_is_as_long_in_each_layer_as_that_is_thick_over_the_cosine_of_its_inclination() {
    let made = Made::text(LAYERS);
    for inclination in [0.0_f64, 30.0, 75.0] {
        let cosine = inclination.to_radians().cos();
        let way = DVec3::new(0.6, 0.8, 0.0) * inclination.to_radians().sin() - cosine * DVec3::Z;
        let from = DVec3::new(100.0, 100.0, 10.0);
        let log = made.log(&straight(from, from + way * (120.0 / cosine)));
        assert_eq!(
            made.names(&log),
            ["outside", "upper", "lower", "background", "outside"]
        );
        for (one, thick) in log.intervals.iter().zip([10.0, 40.0, 30.0, 30.0, 10.0]) {
            assert!((one.length() * cosine - thick).abs() < 1e-7, "{one:?}");
        }
        assert_eq!(log.unexplained, 0);
        let surfaces: Vec<_> = log
            .crossings
            .iter()
            .map(|one| one.surfaces.as_slice())
            .collect();
        assert_eq!(surfaces[1], [(made.realisation.volume("upper"), "horizon")]);
        assert_eq!(surfaces[0], [(None, "side of the domain")]);
    }
}

#[test]
fn a_well_that_lands_on_a_horizon_and_runs_along_it_belongs_to_the_younger_bed_there() {
    let made = Made::text(LAYERS);
    // 30 m deep along a quarter circle of 40 m, from 0 to -40.
    let reading = |md: f64, inclination: f64| Reading {
        md,
        inclination: inclination.to_radians(),
        azimuth: std::f64::consts::FRAC_PI_2,
    };
    let arc = 20.0 * std::f64::consts::PI;
    let readings = [
        reading(0.0, 0.0),
        reading(arc, 90.0),
        reading(arc + 200.0, 90.0),
    ];
    let stations = by_angles(DVec3::new(100.0, 500.0, 0.0), &readings).unwrap();
    let log = made.log(&Well::new(stations, Path::MinimumCurvature).unwrap());
    assert_eq!(made.names(&log), ["upper"], "{log:?}");
    assert_eq!(log.along.len(), 1);
    let [from, to] = log.along[0];
    assert!(
        (from - arc).abs() < 2.0 && (to - arc - 200.0).abs() < 1e-6,
        "{from} {to}"
    );
}

#[test]
fn a_well_that_turns_on_a_horizon_touches_it_and_a_little_deeper_dips_into_the_bed_below() {
    let made = Made::text(LAYERS);
    let at = |x: f64, z: f64| Station {
        md: None,
        point: DVec3::new(x, 500.0, z),
        tangent: None,
    };
    // Three stations: a parabola with its lowest point in the middle.
    let parabola = |lowest: f64| {
        let stations = vec![
            at(400.0, lowest + 20.0),
            at(500.0, lowest),
            at(600.0, lowest + 20.0),
        ];
        Well::new(stations, Path::Spline(Parametrization::ChordLength)).unwrap()
    };
    let touching = made.log(&parabola(-40.0));
    assert_eq!(made.names(&touching), ["upper"]);
    assert_eq!(touching.touches.len(), 1, "{touching:?}");
    assert!((touching.touches[0].point.x - 500.0).abs() < 0.01);
    let deeper = made.log(&parabola(-40.0 - 1e-5));
    assert_eq!(made.names(&deeper), ["upper", "lower", "upper"]);
    // z = -40 − 1e-5 + 20 (x/100)²: half as wide as 100 √(1e-5/20).
    let half = 100.0 * (1e-5_f64 / 20.0).sqrt();
    assert!(
        (deeper.intervals[1].length() - 2.0 * half).abs() < 1e-6,
        "{deeper:?}"
    );
    assert_eq!(made.names(&made.log(&parabola(-39.999))), ["upper"]);
}

/// A stream of numbers from 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 9_007_199_254_740_992.0
    }

    fn within(&mut self, low: DVec3, high: DVec3) -> DVec3 {
        let part = DVec3::new(self.next(), self.next(), self.next());
        low + (high - low) * part
    }
}

/// Where the evaluator's answer changes between samples, by halving.
fn sampled(made: &Made, well: &Well, samples: usize) -> Vec<f64> {
    let (first, last) = well.range();
    let at = |k: usize| first + (last - first) * k as f64 / samples as f64;
    let owner = |md: f64| made.owner(well.point(md));
    let mut changes = Vec::new();
    let mut above = owner(first);
    for k in 1..=samples {
        let below = owner(at(k));
        if below != above {
            let (mut low, mut high) = (at(k - 1), at(k));
            while high - low > 1e-9 {
                let middle = f64::midpoint(low, high);
                if owner(middle) == above {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            changes.push(high);
        }
        above = below;
    }
    changes
}

/// A random well of a model, and all that must be true of its log.
fn compare(made: &Made, random: &mut Random, name: &str) -> usize {
    let domain = &made.model.domain;
    let corner = |i: usize| DVec3::new(domain.x[i], domain.y[i], domain.z[i]);
    let margin = 0.05 * (corner(1) - corner(0));
    let (low, high) = (corner(0) - margin, corner(1) + margin);
    let points: Vec<DVec3> = match random.next() {
        // Vertical, straight, or a spline through up to six places.
        kind if kind < 0.2 => {
            let top = random.within(low, high);
            vec![top.with_z(high.z), top.with_z(low.z)]
        }
        kind if kind < 0.4 => vec![random.within(low, high), random.within(low, high)],
        kind => (0..if kind < 0.7 { 3 } else { 6 })
            .map(|_| random.within(low, high))
            .collect(),
    };
    let stations = points.iter().map(|point| Station {
        md: None,
        point: *point,
        tangent: None,
    });
    let well = Well::new(
        stations.collect(),
        Path::Spline(Parametrization::Centripetal),
    )
    .unwrap();
    let log = made.log(&well);
    let (first, last) = well.range();
    assert_eq!(log.intervals[0].md[0], first);
    assert_eq!(log.intervals[log.intervals.len() - 1].md[1], last);
    let boundaries: Vec<f64> = log.intervals[1..].iter().map(|one| one.md[0]).collect();
    // Millions of metres from the origin a number is exact to 1e-9; a well that grazes a surface stretches that.
    let same = if name.starts_with("far/") { 1e-5 } else { 1e-6 };
    // What sampling finds is there.
    for change in sampled(made, &well, 300) {
        let nearest = boundaries
            .iter()
            .map(|md| (md - change).abs())
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < same, "{name}: {points:?} at {change}: {nearest}");
    }
    // What is there is true, right beside its ends, too.
    for one in &log.intervals {
        let [from, to] = one.md;
        if to - from > 4.0 * same {
            for md in [from + same, f64::midpoint(from, to), to - same] {
                assert_eq!(
                    made.owner(well.point(md)),
                    one.volume,
                    "{name}: {points:?} at {md}"
                );
            }
        }
    }
    for pair in log.intervals.windows(2) {
        assert!(pair[0].md[1] == pair[1].md[0] && pair[0].volume != pair[1].volume);
    }
    assert_eq!(log.unexplained, 0, "{name}: {points:?}");
    for crossing in &log.crossings {
        assert!(
            !crossing.surfaces.is_empty(),
            "{name}: {points:?} {crossing:?}"
        );
    }
    log.crossings.len()
}

#[test]
fn a_thousand_random_wells_change_volumes_where_dense_sampling_of_the_evaluator_says() {
    let models = [
        "coastal/coastal",
        "channel-complex/channel-complex",
        "fig09-warp/fig09-warp",
        "strata/bounds",
        "strata/undulating",
        "isochores/isochores",
        "nodules/nodules",
        "fig08a-point-bars/fig08a-point-bars",
        "fig06c-clinoforms/fig06c-clinoforms",
        "fig07-join/fig07-join",
        "lobes/lobes",
        "contacts/pieces",
        "far/channels",
    ];
    let mut random = Random(1);
    let mut crossings = 0;
    for name in models {
        let made = Made::of(checked::checked(&checked::source(name)));
        for _ in 0..78 {
            crossings += compare(&made, &mut random, name);
        }
    }
    assert!(crossings > 4000, "{crossings}");
}

#[test]
fn the_log_of_the_models_wells_is_as_long_as_they_are_in_the_domain() {
    let text = format!(
        "{LAYERS}\n[[well]]\nid = \"A\"\nhead = [500, 500]\ndatum = 25\npath = \"minimum-curvature\"\nsurvey = [{{ md = 0, inc_deg = 0, azi_deg = 0 }}, {{ md = 80, inc_deg = 0, azi_deg = 0 }}, {{ md = 200, inc_deg = 60, azi_deg = 90 }}]\ncompletions = [[60, 70], [90, 100]]\n"
    );
    let made = Made::of(Model::check(&Source::from_text("a.toml", text, Format::Toml)).unwrap());
    let spec = &made.model.wells[0];
    let log = made.log(&spec.well);
    let inside: f64 = log
        .intervals
        .iter()
        .filter(|one| one.volume.is_some())
        .map(Interval::length)
        .sum();
    // From the domain's top, 25 m below the datum, to its base or the end.
    assert_eq!(log.intervals[0].volume, None);
    assert!((log.intervals[0].md[1] - 25.0).abs() < 1e-7);
    let outside: f64 = log
        .intervals
        .iter()
        .filter(|one| one.volume.is_none())
        .map(Interval::length)
        .sum();
    assert!((inside + outside - 200.0).abs() < 1e-9);
    assert!((log.intervals[1].md[1] - 65.0).abs() < 1e-7);
    assert!((spec.open(log.intervals[1].md) - 5.0).abs() < 1e-7);
    assert_eq!(log.at(64.9), made.realisation.volume("upper"));
    assert_eq!(log.at(65.1), made.realisation.volume("lower"));
}

const TOPS: &str = "well,horizon,md\nA,upper,42.5\nB,upper,38\nC,upper,40.25\nA,lower,69\n";

/// Layers with three vertical wells and tops in them; `honours` goes into the upper horizon.
fn with_tops(honours: &str) -> Model {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tops.csv"), TOPS).unwrap();
    let mut text = format!("tops = \"tops.csv\"\n{LAYERS}{honours}\n");
    for (id, x, y) in [("A", 200, 300), ("B", 260, 300), ("C", 800, 700)] {
        let _ = write!(
            text,
            "[[well]]\nid = \"{id}\"\nhead = [{x}, {y}]\nsurvey = [{{ md = 0, inc_deg = 0, azi_deg = 0 }}, {{ md = 90, inc_deg = 0, azi_deg = 0 }}]\n"
        );
    }
    let source = Source::from_text("tops.toml", text, Format::Toml).in_folder(folder.path());
    checked::checked(&source)
}

#[test]
fn a_horizon_misses_its_tops_by_their_depth_less_its_own_and_passes_through_them_where_it_honours_them()
 {
    let plain = Made::of(with_tops(""));
    let misfits = |made: &Made| -> Vec<f64> {
        let misfit = |top: &clinothem::model::wells::spec::TopSpec| {
            top.misfit(&made.realisation).above.unwrap()
        };
        made.model.tops.iter().map(misfit).collect()
    };
    for (found, expected) in misfits(&plain).iter().zip([2.5, -2.0, 0.25, -1.0]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    let honouring = Made::of(with_tops("honours_tops = { reach = 400 }"));
    let after = misfits(&honouring);
    assert!(
        after[..3].iter().all(|misfit| misfit.abs() < 1e-5),
        "{after:?}"
    );
    assert!((after[3] + 1.0).abs() < 1e-9);
    // So the wells enter the bed below where they were picked.
    for (well, md) in honouring.model.wells.iter().zip([42.5, 38.0, 40.25]) {
        let log = honouring.log(&well.well);
        assert_eq!(honouring.names(&log), ["upper", "lower", "background"]);
        assert!((log.intervals[0].md[1] - md).abs() < 1e-5, "{log:?}");
    }
    let decisions = honouring.realisation.decisions.join("\n");
    assert!(
        decisions.contains("upper passes through 3 tops, of which it was 2.50 m off at most"),
        "{decisions}"
    );
    // Far from them nothing is changed.
    let far = DVec3::new(990.0, 10.0, -40.0 + 1e-3);
    assert_eq!(
        honouring.owners.at(far),
        honouring.realisation.volume("upper")
    );
    assert_eq!(
        honouring.owners.at(far - 2e-3 * DVec3::Z),
        honouring.realisation.volume("lower")
    );
}

#[test]
fn the_wells_of_the_figure_leave_one_site_and_end_in_the_rocks_that_they_were_drilled_for() {
    let made = Made::of(checked::checked(&checked::source(
        "fig02-wells/fig02-wells",
    )));
    let names: Vec<&str> = made
        .model
        .wells
        .iter()
        .map(|well| well.name.as_str())
        .collect();
    assert_eq!(names, ["A-1", "A-2", "A-3", "A-3/lower", "A-4", "A-5"]);
    assert!(made.model.notes.is_empty(), "{:?}", made.model.notes);
    // Local coordinates of the site, 25 m above the sea, which is 2000 m above the model's top.
    let site = DVec3::new(220.0, 80.0, 2025.0);
    for well in &made.model.wells {
        let log = made.log(&well.well);
        let inside: f64 = log
            .intervals
            .iter()
            .filter(|one| one.volume.is_some())
            .map(Interval::length)
            .sum();
        assert_eq!(log.unexplained, 0);
        assert!(
            log.along.is_empty() && log.touches.is_empty(),
            "{}",
            well.name
        );
        if well.mother.is_none() {
            assert!(well.well.point(0.0).distance(site) < 1e-6, "{}", well.name);
            assert!(inside > 50.0, "{}: {inside}", well.name);
        }
        let open: f64 = well.completions.iter().map(|[from, to]| to - from).sum();
        let perforated: f64 = log.intervals.iter().map(|one| well.open(one.md)).sum();
        assert!((open - perforated).abs() < 1e-9);
    }
    let (mother, lateral) = (&made.model.wells[2].well, &made.model.wells[3].well);
    let first = lateral.curve().points()[0];
    assert!(mother.curve().points().contains(&first));
    // A straight well is 51.816 m in a domain so thick, and the horizons are where they are.
    let log = made.log(&made.model.wells[0].well);
    assert!((log.intervals[0].md[1] - 2025.0).abs() < 1e-7);
    assert!(
        log.crossings
            .iter()
            .any(|one| (one.point.z + 21.336).abs() < 1e-7)
    );
}
