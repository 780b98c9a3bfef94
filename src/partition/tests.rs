//! Damage to what one stage hands to the next must be counted: a counter that nothing raises proves nothing.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::type_complexity,
    reason = "a test fails by panicking"
)]

use glam::DVec3;

use super::arcs::{self, Arc};
use super::check::Faults;
use super::crossings::{self, Crossings, EdgeRoot};
use super::faces::{self, Face};
use super::pair::Tolerances;
use super::quadrature::{self, Integral};
use super::region::{Region, Regions};
use super::solids::Parts;
use super::tracks::{Geometry, Source, Tracks};
use super::{Label, MARGIN, Options, partition};

type Damage<T> = Box<dyn Fn(&Regions, &mut T)>;

/// What is done to the results of stages.
struct Injected {
    roots: Damage<Vec<EdgeRoot>>,
    crossings: Damage<Crossings>,
    tracks: Damage<Tracks>,
    arcs: Box<dyn Fn(&Regions, &Tracks, &mut Vec<Arc>)>,
    faces: Damage<Vec<Face>>,
    integrals: Damage<Vec<Integral>>,
}

impl Default for Injected {
    fn default() -> Self {
        Self {
            roots: Box::new(|_, _| {}),
            crossings: Box::new(|_, _| {}),
            tracks: Box::new(|_, _| {}),
            arcs: Box::new(|_, _, _| {}),
            faces: Box::new(|_, _| {}),
            integrals: Box::new(|_, _| {}),
        }
    }
}

/// Every combination of regions is a volume of its own.
fn combinations(holds: &[bool]) -> Label {
    let bit = |(at, held): (usize, &bool)| if *held { 1 << at } else { 0 };
    holds[0].then(|| holds.iter().enumerate().skip(1).map(bit).sum())
}

/// A block, a box wholly inside it, a level through both, and a second box through a wall of the first.
fn scene() -> Vec<Region> {
    let block = |low: [f64; 3], high: [f64; 3]| Region::Block {
        low: DVec3::from_array(low),
        high: DVec3::from_array(high),
    };
    vec![
        block([-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]),
        block([-1.1, -0.9, -0.8], [0.7, 1.2, 1.0]),
        Region::Above(0.13),
        block([0.2, -0.4, -0.5], [1.6, 0.5, 0.6]),
    ]
}

/// The stages of a partition with damage between them: faults, and sizes of solids.
fn staged(injected: &Injected) -> (Faults, Vec<f64>) {
    let regions = Regions::new(scene(), &Options::default()).unwrap();
    let scale = regions.domain.diagonal();
    let tolerances = Tolerances::new(scale, 1.0);
    let clip = regions.domain.grown(MARGIN * scale);
    let mut faults = Faults::default();
    let mut roots = crossings::edge_roots(&regions, tolerances, clip, &mut faults);
    (injected.roots)(&regions, &mut roots);
    let settings = crossings::Settings {
        tolerances,
        clip,
        stop: &|| false,
    };
    let mut crossings = Crossings::from_roots(&regions, roots, settings, &mut faults);
    (injected.crossings)(&regions, &mut crossings);
    let geometry = Geometry {
        regions: &regions,
        crossings: &crossings,
    };
    let mut tracks = Tracks::new(&regions, &crossings, tolerances, &mut faults);
    (injected.tracks)(&regions, &mut tracks);
    let mut arcs = arcs::arcs(geometry, &tracks, &combinations, &mut faults);
    (injected.arcs)(&regions, &tracks, &mut arcs);
    let mut faces = faces::faces(geometry, &tracks, &arcs, &mut faults);
    (injected.faces)(&regions, &mut faces);
    let mut integrals = quadrature::integrals(geometry, &tracks, &arcs, &faces);
    (injected.integrals)(&regions, &mut integrals);
    let parts = Parts {
        geometry,
        tracks: &tracks,
        arcs: &arcs,
        faces: &faces,
        integrals: &integrals,
        tolerances,
    };
    let solids = parts.solids(&mut faults);
    (faults, solids.iter().map(|solid| solid.volume).collect())
}

fn faults(injected: &Injected) -> Faults {
    staged(injected).0
}

/// The first arc of a crossing between sheets of two regions.
fn crossing_arc(regions: &Regions, tracks: &Tracks, arcs: &[Arc], of: [usize; 2]) -> usize {
    let between = |arc: &Arc| {
        let track = &tracks.tracks[arc.track];
        let own = track.sheets.map(|sheet| regions.sheets[sheet].region);
        matches!(track.source, Source::Crossing(_)) && (own == of || own == [of[1], of[0]])
    };
    arcs.iter().position(between).unwrap()
}

#[test]
fn stages_without_damage_give_what_partition_gives() {
    let (faults, sizes) = staged(&Injected::default());
    assert!(faults.is_none(), "{faults}");
    let made = partition(scene(), &combinations, &Options::default()).unwrap();
    let whole: Vec<f64> = made
        .topology
        .solids
        .iter()
        .map(|solid| solid.size)
        .collect();
    assert_eq!(sizes, whole);
    assert_eq!(sizes.len(), 8);
}

#[test]
fn a_dropped_root_leaves_a_branch_without_one() {
    let drop = Injected {
        roots: Box::new(|_, roots| {
            roots.remove(0);
        }),
        ..Injected::default()
    };
    assert!(faults(&drop).lost_ends > 0, "{}", faults(&drop));
}

#[test]
fn an_invented_root_is_used_by_no_branch() {
    // The edge of a box with a lid that is parallel to the level.
    let invent = Injected {
        roots: Box::new(|regions, roots| {
            let level = regions
                .sheets
                .iter()
                .position(|sheet| sheet.region == 2)
                .unwrap();
            let upright = |edge: &usize| {
                let points = regions.edges[*edge].curve.points();
                (points[0] - points[1]).z.abs() > 0.5
            };
            let flat = (0..regions.edges.len())
                .find(|edge| regions.edges[*edge].region == 1 && !upright(edge));
            let mut root = *roots.iter().find(|root| root.sheet == level).unwrap();
            root.edge = flat.unwrap();
            roots.push(root);
        }),
        ..Injected::default()
    };
    assert!(faults(&invent).unused_roots > 0, "{}", faults(&invent));
}

#[test]
fn a_point_of_three_sheets_that_one_curve_misses_is_put_back() {
    let (_, sizes) = staged(&Injected::default());
    let drop = Injected {
        crossings: Box::new(|_, crossings| {
            crossings.triples.remove(0);
        }),
        ..Injected::default()
    };
    let (faults, again) = staged(&drop);
    assert!(faults.is_none(), "{faults}");
    assert_eq!(sizes.len(), again.len());
    for (a, b) in sizes.iter().zip(again) {
        assert!((a - b).abs() < 1e-9);
    }
}

#[test]
fn a_point_of_three_sheets_found_twice_on_one_curve_is_inconsistent() {
    let twice = Injected {
        crossings: Box::new(|_, crossings| {
            let again = crossings.triples[0];
            crossings.triples.push(again);
        }),
        ..Injected::default()
    };
    assert_eq!(faults(&twice).triples, 1, "{}", faults(&twice));
}

#[test]
fn a_point_of_three_sheets_whose_curve_was_dropped_is_inconsistent() {
    let drop = Injected {
        crossings: Box::new(|_, crossings| {
            let gone = crossings.triples[0].crossing;
            crossings.triples.retain(|triple| triple.crossing != gone);
            // What is left of the curve ends before the point.
            let branch = &mut crossings.curves[gone].branch;
            branch.nodes.truncate(2);
            branch.lengths.truncate(2);
        }),
        ..Injected::default()
    };
    assert!(faults(&drop).triples > 0, "{}", faults(&drop));
}

#[test]
fn a_cut_that_names_another_region_contradicts_the_sides() {
    let rename = Injected {
        tracks: Box::new(|regions, tracks| {
            let track = tracks
                .tracks
                .iter_mut()
                .find(|track| regions.sheets[track.sheets[0]].region == 1 && track.cuts.len() > 2);
            let cut = &mut track.unwrap().cuts[1];
            cut.region = Some(if cut.region == Some(3) { 2 } else { 3 });
        }),
        ..Injected::default()
    };
    assert!(faults(&rename).sides > 0, "{}", faults(&rename));
}

#[test]
fn a_dropped_arc_leaves_dead_ends() {
    // At a corner of the block each wall has two edges only.
    let drop = Injected {
        arcs: Box::new(|regions, tracks, arcs| {
            arcs.retain(|arc| tracks.tracks[arc.track].source != Source::Edge(0));
            assert_eq!(regions.edges[0].region, 0);
        }),
        ..Injected::default()
    };
    assert!(faults(&drop).dead_ends > 0, "{}", faults(&drop));
}

#[test]
fn an_arc_twice_makes_turns_ambiguous() {
    let twice = Injected {
        arcs: Box::new(|regions, tracks, arcs| {
            let at = crossing_arc(regions, tracks, arcs, [1, 2]);
            arcs.push(arcs[at].clone());
        }),
        ..Injected::default()
    };
    assert!(faults(&twice).ambiguous > 0, "{}", faults(&twice));
}

#[test]
fn a_flap_with_its_labels_exchanged_mixes_a_loop() {
    let flip = Injected {
        arcs: Box::new(|regions, tracks, arcs| {
            let at = crossing_arc(regions, tracks, arcs, [1, 2]);
            arcs[at].flaps[0].labels.reverse();
        }),
        ..Injected::default()
    };
    assert!(faults(&flip).mixed_loops > 0, "{}", faults(&flip));
}

#[test]
fn a_hole_with_other_labels_than_what_is_around_it_has_no_face() {
    // Without the second box, the first one's hole in the level.
    let rename = Injected {
        arcs: Box::new(|regions, tracks, arcs| {
            for arc in arcs {
                let sheets = tracks.tracks[arc.track].sheets;
                for flap in &mut arc.flaps {
                    let level = regions.sheets[sheets[flap.side]].region == 2;
                    if level
                        && flap.labels == [Some(0b100), Some(0)]
                        && sheets.iter().all(|s| regions.sheets[*s].region != 0)
                    {
                        flap.labels = [Some(77), Some(78)];
                    }
                }
            }
        }),
        ..Injected::default()
    };
    assert_eq!(faults(&rename).homeless_holes, 1, "{}", faults(&rename));
}

#[test]
fn a_face_with_another_label_mixes_a_shell() {
    let rename = Injected {
        faces: Box::new(|_, faces| faces[0].labels[0] = Some(77)),
        ..Injected::default()
    };
    assert!(faults(&rename).mixed_shells > 0, "{}", faults(&rename));
}

#[test]
fn a_shell_turned_inside_out_is_a_void_of_nothing() {
    let turn = Injected {
        integrals: Box::new(|_, integrals| {
            for one in integrals {
                one.flux = -one.flux;
            }
        }),
        ..Injected::default()
    };
    assert_eq!(faults(&turn).homeless_voids, 8, "{}", faults(&turn));
}

#[test]
fn a_dropped_face_opens_two_shells() {
    let drop = Injected {
        faces: Box::new(|_, faces| {
            faces.pop();
        }),
        ..Injected::default()
    };
    assert!(faults(&drop).open_shells > 0, "{}", faults(&drop));
}

#[test]
fn sheets_that_run_along_each_other_are_undecided() {
    let mut regions = scene();
    regions.push(Region::Above(1.0));
    let made = partition(regions, &combinations, &Options::default()).unwrap();
    assert!(made.faults.undecided > 0, "{}", made.faults);
}

/// Boxes through each other, of which the younger takes from the older.
fn boxes_in_boxes() -> Vec<Region> {
    let at = |k: u32, ratio: f64| (f64::from(k) * ratio).fract();
    let mut regions = vec![Region::Block {
        low: DVec3::splat(-2.0),
        high: DVec3::splat(2.0),
    }];
    regions.extend((1..9).map(|k| {
        let middle = DVec3::new(at(k, 0.7549), at(k, 0.5698), at(k, 0.4302)) - 0.5;
        let half = 0.4 + 0.5 * DVec3::new(at(k, 0.3819), at(k, 0.2361), at(k, 0.8541));
        Region::Block {
            low: middle - half,
            high: middle + half,
        }
    }));
    regions
}

#[test]
fn not_looking_where_nothing_depends_on_it_changes_nothing_that_is_made() {
    let youngest = |holds: &[bool]| {
        let last = holds.iter().rposition(|held| *held);
        last.filter(|_| holds[0])
    };
    let younger_hides = |by: usize, inside: bool, other: usize| inside && 0 < other && other < by;
    let seeing_all = Options::default();
    let looking_less = Options {
        hides: &younger_hides,
        ..Options::default()
    };
    let made = [&seeing_all, &looking_less].map(|options| {
        let made = partition(boxes_in_boxes(), &youngest, options).unwrap();
        assert!(made.faults.is_none(), "{}", made.faults);
        let topology = made.topology;
        let sizes: Vec<(usize, f64)> = topology
            .solids
            .iter()
            .map(|solid| (solid.label, solid.size))
            .collect();
        (sizes, topology.faces.len(), topology.edges.len())
    });
    assert_eq!(made[0].1, made[1].1);
    assert_eq!(made[0].2, made[1].2);
    assert_eq!(made[0].0.len(), made[1].0.len());
    for (all, less) in made[0].0.iter().zip(&made[1].0) {
        assert_eq!(all.0, less.0);
        assert!((all.1 - less.1).abs() < 1e-12 * all.1, "{all:?} {less:?}");
    }
    let triples = [&seeing_all, &looking_less].map(|options| {
        let regions = Regions::new(boxes_in_boxes(), options).unwrap();
        let tolerances = Tolerances::new(regions.domain.diagonal(), 1.0);
        let settings = crossings::Settings {
            tolerances,
            clip: regions.domain,
            stop: &|| false,
        };
        let found = Crossings::find(&regions, settings, &mut Faults::default());
        found.triples.len()
    });
    assert!(3 * triples[1] < 2 * triples[0], "{triples:?}");
}

#[test]
fn what_is_hidden_wrongly_is_not_made_in_silence() {
    // The older boxes are said to be hidden, but the label asks for them.
    let wrong = |by: usize, inside: bool, other: usize| inside && 0 < other && other < by;
    let options = Options {
        hides: &wrong,
        ..Options::default()
    };
    let made = partition(boxes_in_boxes(), &combinations, &options).unwrap();
    assert!(!made.faults.is_none());
}
