//! Grids: what cells hold, where they are, and in which order files have them.
//!
//! The oracles are closed forms of volumes, the point evaluator at places that are worked out here, and readers of the formats
//! that are written here from their descriptions.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "a test fails by panicking, and its counts are small"
)]

#[path = "assembled/checked.rs"]
mod checked;

use std::f64::consts::PI;
use std::path::Path;

use checked::{checked, from_text, source};
use clinothem::export::grid;
use clinothem::export::grid::format::Format;
use clinothem::export::grid::frame::Cells;
use clinothem::export::grid::key::Key;
use clinothem::export::grid::labels::OUTSIDE;
use clinothem::export::grid::layers::{Layers, LayersError};
use clinothem::export::grid::plan::{Division, Plan};
use clinothem::export::grid::sampled::{Grid, Source};
use clinothem::model::Model;
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use glam::DVec3;

/// A model that is ready for sampling.
struct Ready {
    model: Model,
    realisation: Realisation,
    owners: Owners,
}

impl Ready {
    fn new(model: Model) -> Self {
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let owners = Owners::new(&realisation).unwrap();
        Self {
            model,
            realisation,
            owners,
        }
    }

    fn boxes(&self, counts: [usize; 3]) -> Cells {
        Cells::boxes(&self.realisation.extent, &Division::Counts(counts.to_vec())).unwrap()
    }

    fn layers(&self, plan: [usize; 2], numbers: &[usize]) -> Result<Cells, LayersError> {
        let division = Division::Counts(plan.to_vec());
        let plan = Plan::new(&self.realisation.extent, &division).unwrap();
        Layers::new(&self.realisation, plan, numbers).map(Cells::Layers)
    }

    /// The grid with its files of these formats in a folder.
    fn write<'a>(
        &'a self,
        cells: &'a Cells,
        samples: usize,
        formats: &[Format],
        folder: &Path,
    ) -> Grid<'a> {
        let source = Source {
            model: &self.model,
            realisation: &self.realisation,
            owners: &self.owners,
            cells,
            samples,
            shift: DVec3::from_array(self.model.origin),
        };
        let grid = Grid::new(source, folder, &|_| {}).unwrap();
        for format in formats {
            grid::write(&grid, *format, folder, "m").unwrap();
        }
        grid
    }

    /// Shares of the volumes, by number.
    fn shares(&self, cells: &Cells, samples: usize) -> Vec<f64> {
        let folder = tempfile::tempdir().unwrap();
        let grid = self.write(cells, samples, &[], folder.path());
        let key = Key::new(&grid, &[], "m");
        key.volumes.iter().map(|volume| volume.fraction).collect()
    }
}

fn labels(grid: &Grid<'_>) -> Vec<u32> {
    let mut all = Vec::new();
    let keep = |labels: &[u32]| {
        all.extend_from_slice(labels);
        Ok(())
    };
    grid.labels().upward(keep).unwrap();
    all
}

/// A block with a unit above a level horizon and an ellipsoid in its north-eastern upper part, in world coordinates.
const CORNERS: &str = r#"
name = "Corners"
origin = [1000, 20000, -300]
[domain]
x = [0, 60]
y = [0, 40]
z = [-30, 0]
facies = "mud"
[facies.mud]
porosity = 0.05
permeability = 0.1
[facies.sand]
porosity = 0.25
permeability = [100, 50, 10]
[facies.nodule]
[[feature]]
id = "upper"
kind = "horizon"
facies = "sand"
surface = { level = -12 }
[[feature]]
id = "egg"
kind = "ellipsoid"
facies = "nodule"
center = [45, 24, -4]
semi_axes = [3, 4, 2]
"#;

fn corners() -> Ready {
    Ready::new(from_text(CORNERS, &[]))
}

#[test]
fn cells_on_either_side_of_a_level_horizon_share_as_the_heights_do() {
    let ready = Ready::new(from_text(CORNERS, &["feature.egg.enabled=false"]));
    assert_eq!(ready.shares(&ready.boxes([3, 2, 5]), 1), [0.6, 0.4]);
    // By most of the samples a cell that the horizon halves belongs to the younger side, and one that it cuts at two thirds to
    // the larger part.
    assert_eq!(ready.shares(&ready.boxes([3, 2, 5]), 2), [0.6, 0.4]);
    let thirds = ready.shares(&ready.boxes([1, 1, 2]), 3);
    assert_eq!(thirds, [0.5, 0.5]);
    // One cell: 18 of 30 m are mud.
    assert_eq!(ready.shares(&ready.boxes([1, 1, 1]), 5), [1.0, 0.0]);
}

#[test]
fn the_share_of_an_ellipsoid_tends_to_its_volume_as_cells_shrink() {
    let ready = corners();
    let exact = 4.0 / 3.0 * PI * 4.0 * 3.0 * 2.0 / (60.0 * 40.0 * 30.0);
    let miss = |counts: [usize; 3]| (ready.shares(&ready.boxes(counts), 1)[2] / exact - 1.0).abs();
    // Cells at the surface err at random: about the root of their number.
    assert!(miss([60, 40, 30]) < 0.15);
    assert!(miss([240, 160, 120]) < 0.004);
}

/// The volume that a cell of boxes should have, worked out here: `i` eastward, `j` northward, `k` upward.
fn expected(ready: &Ready, counts: [usize; 3], [i, j, k]: [usize; 3]) -> i32 {
    let extent = &ready.realisation.extent;
    let size = extent.high() - extent.low();
    let part = |at: usize, axis: usize| (at as f64 + 0.5) / counts[axis] as f64;
    let place = extent.low() + size * DVec3::new(part(i, 0), part(j, 1), part(k, 2));
    ready.owners.at(place).map_or(-1, |owner| owner as i32)
}

const COUNTS: [usize; 3] = [6, 4, 10];

fn all_cells([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
}

#[test]
fn numpy_files_have_the_cell_i_east_j_north_k_up_at_i_j_k() {
    let ready = corners();
    let folder = tempfile::tempdir().unwrap();
    ready.write(&ready.boxes(COUNTS), 1, &[Format::Npy], folder.path());
    let bytes = std::fs::read(folder.path().join("m.volume.npy")).unwrap();
    let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let text = std::str::from_utf8(&bytes[10..10 + header]).unwrap();
    assert_eq!(
        text.trim_end(),
        "{'descr': '<i4', 'fortran_order': True, 'shape': (6, 4, 10), }"
    );
    let data = &bytes[10 + header..];
    assert_eq!(data.len(), 4 * 6 * 4 * 10);
    let mut nodules = 0;
    for [i, j, k] in all_cells(COUNTS) {
        // Fortran's order: the first index runs fastest.
        let at = 4 * (i + 6 * (j + 4 * k));
        let found = i32::from_le_bytes(data[at..at + 4].try_into().unwrap());
        assert_eq!(found, expected(&ready, COUNTS, [i, j, k]));
        nodules += usize::from(found == 2);
    }
    assert!(nodules > 0, "nothing shows that axes are not exchanged");
    let bytes = std::fs::read(folder.path().join("m.permeability_y.npy")).unwrap();
    let values = bytes[bytes.len() - 4 * 240..].chunks(4);
    let values: Vec<f32> = values
        .map(|one| f32::from_le_bytes(one.try_into().unwrap()))
        .collect();
    assert_eq!(values[0], 0.1);
    assert_eq!(values[239], 50.0);
    // The nodule's rock is not known.
    assert_eq!(values.iter().filter(|one| one.is_nan()).count(), nodules);
}

#[test]
fn gslib_and_sgems_rows_run_eastward_then_northward_then_upward() {
    let ready = corners();
    let folder = tempfile::tempdir().unwrap();
    let formats = [Format::Gslib, Format::Sgems];
    ready.write(&ready.boxes(COUNTS), 1, &formats, folder.path());
    for (name, null, title) in [
        (
            "m.gslib",
            "-999",
            "nx=6 ny=4 nz=10 middle of the first cell=1005 20005 -328.5 size=10 10 3 m",
        ),
        ("m.sgems", "-9966699", "Corners (6x4x10)"),
    ] {
        let text = std::fs::read_to_string(folder.path().join(name)).unwrap();
        let mut lines = text.lines();
        assert!(lines.next().unwrap().contains(title), "{text}");
        let count: usize = lines.next().unwrap().parse().unwrap();
        let names: Vec<&str> = lines.by_ref().take(count).collect();
        assert_eq!(
            names,
            [
                "volume",
                "facies",
                "porosity",
                "permeability_x",
                "permeability_y",
                "permeability_z"
            ]
        );
        for (cell, line) in all_cells(COUNTS).zip(lines.by_ref()) {
            let words: Vec<&str> = line.split(' ').collect();
            let volume = expected(&ready, COUNTS, cell);
            assert_eq!(words[0], volume.to_string());
            let rest = [
                ["1", "0.05", "0.1", "0.1", "0.1"],
                ["2", "0.25", "100.0", "50.0", "10.0"],
                ["3", null, null, null, null],
            ];
            assert_eq!(words[1..], rest[volume as usize]);
        }
        assert_eq!(lines.next(), None);
    }
}

/// Keywords of a GRDECL file with their values, repeats written out.
fn keyword(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines().filter(|line| !line.starts_with("--"));
    lines.find(|line| line.trim() == name).unwrap();
    let mut values = Vec::new();
    for word in lines.flat_map(str::split_whitespace) {
        if word == "/" {
            break;
        }
        let (count, value) = word.split_once('*').unwrap_or(("1", word));
        // SPECGRID ends with a letter.
        let value: f64 = value.parse().unwrap_or(f64::NAN);
        values.extend(std::iter::repeat_n(value, count.parse().unwrap()));
    }
    values
}

/// A GRDECL file as its description has it: I eastward, J southward, K downward.
struct Corners {
    counts: [usize; 3],
    coord: Vec<f64>,
    zcorn: Vec<f64>,
}

impl Corners {
    fn read(text: &str) -> Self {
        let counts = keyword(text, "SPECGRID");
        let counts = [0, 1, 2].map(|at| counts[at] as usize);
        let [nx, ny, nz] = counts;
        let (coord, zcorn) = (keyword(text, "COORD"), keyword(text, "ZCORN"));
        assert_eq!(coord.len(), 6 * (nx + 1) * (ny + 1));
        assert_eq!(zcorn.len(), 8 * nx * ny * nz);
        Self {
            counts,
            coord,
            zcorn,
        }
    }

    /// A corner of a cell: further east, further south, deeper.
    fn corner(&self, [i, j, k]: [usize; 3], [di, dj, dk]: [usize; 3]) -> DVec3 {
        let [nx, ny, _] = self.counts;
        let pillar = 6 * ((j + dj) * (nx + 1) + i + di);
        let plane = (2 * k + dk) * 4 * nx * ny;
        let depth = self.zcorn[plane + (2 * j + dj) * 2 * nx + 2 * i + di];
        assert_eq!(
            self.coord[pillar..pillar + 2],
            self.coord[pillar + 3..pillar + 5]
        );
        DVec3::new(self.coord[pillar], self.coord[pillar + 1], depth)
    }

    fn corners(&self, cell: [usize; 3]) -> Vec<DVec3> {
        let both = [0, 1];
        let all = both.into_iter().flat_map(|k| {
            both.into_iter()
                .flat_map(move |j| both.into_iter().map(move |i| [i, j, k]))
        });
        all.map(|at| self.corner(cell, at)).collect()
    }

    /// The middle of a cell in the map, z up.
    fn middle(&self, cell: [usize; 3]) -> DVec3 {
        let middle = self.corners(cell).into_iter().sum::<DVec3>() / 8.0;
        middle.with_z(-middle.z)
    }

    /// Of upright pillars over a rectangle.
    fn volume(&self, cell: [usize; 3]) -> f64 {
        let corners = self.corners(cell);
        let area = (corners[1].x - corners[0].x) * (corners[0].y - corners[2].y);
        let thickness = (0..4).map(|at| corners[at + 4].z - corners[at].z);
        area * thickness.sum::<f64>() / 4.0
    }

    /// All cells in the file's order.
    fn cells(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        all_cells(self.counts)
    }
}

fn grdecl(ready: &Ready, cells: &Cells, samples: usize) -> String {
    let folder = tempfile::tempdir().unwrap();
    ready.write(cells, samples, &[Format::Grdecl], folder.path());
    std::fs::read_to_string(folder.path().join("m.grdecl")).unwrap()
}

/// Each active cell has what the point evaluator finds at the middle of its corners, and no other cell lies in the domain.
fn check_grdecl(ready: &Ready, text: &str) {
    let corners = Corners::read(text);
    assert!(text.lines().all(|line| line.len() < 128));
    let origin = DVec3::from_array(ready.model.origin);
    let [active, volume, facies] = ["ACTNUM", "VOLUME", "FACIES"].map(|name| keyword(text, name));
    let count: usize = corners.counts.iter().product();
    assert_eq!([active.len(), volume.len(), facies.len()], [count; 3]);
    for (number, cell) in corners.cells().enumerate() {
        let size = corners.volume(cell);
        assert!(size >= 0.0, "{cell:?} is inside out: {size}");
        if active[number] == 0.0 {
            assert_eq!([volume[number], facies[number]], [-1.0; 2]);
            let at = corners.middle(cell) - origin;
            assert!(size < 1e-3 || ready.owners.at(at).is_none(), "{cell:?}");
            continue;
        }
        let owner = ready.owners.at(corners.middle(cell) - origin).unwrap();
        assert_eq!(volume[number], owner as f64, "{cell:?}");
        let facies_of = &ready.realisation.volumes[owner].facies;
        let expected = ready
            .model
            .facies
            .iter()
            .position(|one| one.name == *facies_of);
        assert_eq!(facies[number], (expected.unwrap() + 1) as f64);
    }
}

#[test]
fn grdecl_boxes_run_eastward_southward_and_downward_with_depths() {
    let ready = corners();
    let text = grdecl(&ready, &ready.boxes(COUNTS), 1);
    check_grdecl(&ready, &text);
    let corners = Corners::read(&text);
    // The first corner is the north-western one of the top; the last the south-eastern one of the base.
    assert_eq!(
        corners.corner([0; 3], [0; 3]),
        DVec3::new(1000.0, 20040.0, 300.0)
    );
    assert_eq!(
        corners.corner([5, 3, 9], [1; 3]),
        DVec3::new(1060.0, 20000.0, 330.0)
    );
    let volumes = keyword(&text, "VOLUME");
    // The nodule is the fifth cell eastward, the second one from the north, and the second one down.
    let nodule = volumes.iter().position(|one| *one == 2.0).unwrap();
    assert_eq!(nodule, 4 + 6 * (1 + 4));
    let ports = keyword(&text, "PORO");
    assert_eq!(ports[nodule], 0.0);
    assert_eq!(ports[0], 0.25);
    assert_eq!(keyword(&text, "PERMY")[0], 50.0);
    assert_eq!(keyword(&text, "PERMZ").last(), Some(&0.1));
}

#[test]
fn cells_agree_with_the_point_evaluator_at_their_middles() {
    for (name, counts) in [
        ("channel-belt/channel-belt", [41, 37, 19]),
        ("strata/undulating", [17, 23, 31]),
        ("levees/levees", [50, 40, 11]),
    ] {
        let ready = Ready::new(checked(&source(name)));
        let cells = ready.boxes(counts);
        let folder = tempfile::tempdir().unwrap();
        let grid = ready.write(&cells, 1, &[], folder.path());
        let numbers = &grid.arrays().volumes;
        let mut outside = 0;
        for (cell, label) in all_cells(counts).zip(labels(&grid)) {
            if label == OUTSIDE {
                outside += 1;
                assert_eq!(expected(&ready, counts, cell), -1);
            } else {
                let expected = expected(&ready, counts, cell) as usize;
                assert_eq!(label as usize, expected);
                // Pieces of a volume have its number, so no number is left out.
                assert!((numbers[label as usize] as usize) <= expected);
            }
        }
        assert_eq!(outside, grid.labels().outside, "{name}");
        assert_eq!(outside > 0, name == "strata/undulating");
    }
}

/// Unit by unit from the base up: the volume of its layers.
fn volumes_of_intervals(text: &str, layers: &[usize]) -> Vec<f64> {
    let corners = Corners::read(text);
    let mut sums = vec![0.0; layers.len()];
    for cell in corners.cells() {
        let mut from_base = corners.counts[2] - 1 - cell[2];
        let interval = layers.iter().position(|count| {
            let is_here = from_base < *count;
            from_base = from_base.saturating_sub(*count);
            is_here
        });
        sums[interval.unwrap()] += corners.volume(cell);
    }
    sums
}

/// A level horizon, and a younger one that dips to the east through it and through the base.
fn wedge(relation: &str) -> Ready {
    let text = format!(
        r#"
        name = "Wedge"
        [domain]
        x = [0, 100]
        y = [0, 50]
        z = [-20, 0]
        facies = "mud"
        [facies.mud]
        [facies.sand]
        [facies.silt]
        [[feature]]
        id = "older"
        kind = "horizon"
        facies = "sand"
        surface = {{ level = -10 }}
        [[feature]]
        id = "younger"
        kind = "horizon"
        facies = "silt"
        relation = "{relation}"
        surface = {{ dipping = {{ through = [40, 0, -10], dip_deg = {dip}, azimuth_deg = 90 }} }}
        "#,
        dip = (0.25_f64).atan().to_degrees(),
    );
    Ready::new(from_text(&text, &[]))
}

#[test]
fn layers_end_where_a_younger_horizon_cuts_and_where_one_laps_onto_an_older() {
    // The younger surface is at −10 − (x − 40)/4: it is −10 at x = 40, −20 at x = 80, and 0 at x = 0. Pillars stand there.
    for (relation, expected) in [
        // Mud below −10 and below the younger one, sand between −10 and that, the rest silt.
        ("erosive", [5000.0 * 6.0, 10_000.0, 60_000.0]),
        ("onlapping", [50_000.0, 10_000.0, 40_000.0]),
    ] {
        let ready = wedge(relation);
        let cells = ready.layers([5, 3], &[2, 3, 4]).unwrap();
        let text = grdecl(&ready, &cells, 1);
        check_grdecl(&ready, &text);
        let found = volumes_of_intervals(&text, &[2, 3, 4]);
        for (found, expected) in found.iter().zip(expected) {
            // Depths are written to a micrometre.
            assert!(
                (found - expected).abs() < 0.01,
                "{relation}: {found} is {expected}"
            );
        }
    }
}

#[test]
fn layers_between_bent_bounds_and_beds_that_end_fill_the_domain() {
    for (name, numbers, intervals) in [
        ("strata/undulating", &[4][..], 2),
        ("isochores/isochores", &[3, 2, 2, 4, 1], 5),
        ("trends/trends", &[3], 3),
    ] {
        let ready = Ready::new(checked(&source(name)));
        let cells = ready.layers([60, 50], numbers).unwrap();
        let Cells::Layers(layers) = &cells else {
            panic!()
        };
        assert_eq!(layers.intervals().len(), intervals, "{name}");
        let text = grdecl(&ready, &cells, 1);
        check_grdecl(&ready, &text);
        let corners = Corners::read(&text);
        let sum: f64 = corners.cells().map(|cell| corners.volume(cell)).sum();
        let exact = ready.realisation.extent.volume();
        // The bent bounds between pillars are missed by their curvature.
        assert!((sum / exact - 1.0).abs() < 1e-3, "{name}: {sum} of {exact}");
        let inactive = keyword(&text, "ACTNUM")
            .iter()
            .filter(|one| **one == 0.0)
            .count();
        assert_eq!(inactive > 0, name == "isochores/isochores", "{name}");
    }
}

#[test]
fn each_unit_fills_its_own_layers() {
    let ready = Ready::new(checked(&source("isochores/isochores")));
    let cells = ready.layers([60, 50], &[2]).unwrap();
    let Cells::Layers(layers) = &cells else {
        panic!()
    };
    let names: Vec<&str> = layers
        .intervals()
        .iter()
        .map(|one| one.name.as_str())
        .collect();
    assert_eq!(
        names,
        ["background", "sheet-sand", "shale", "lobe", "cover"]
    );
    let text = grdecl(&ready, &cells, 1);
    let volumes = keyword(&text, "VOLUME");
    let corners = Corners::read(&text);
    let (mut own, mut all) = (0.0, 0.0);
    for (cell, volume) in corners.cells().zip(volumes) {
        if volume >= 0.0 {
            let interval = (corners.counts[2] - 1 - cell[2]) / 2;
            let size = corners.volume(cell);
            all += size;
            own += if volume as usize == interval {
                size
            } else {
                0.0
            };
        }
    }
    // But for thin edges of beds, where the middle of a wedge lies beyond it.
    assert!(own / all > 0.999, "{own} of {all}");
}

#[test]
fn numbers_of_layers_must_be_one_for_each_interval() {
    let ready = wedge("erosive");
    let error = ready.layers([5, 3], &[2, 3]).unwrap_err();
    assert!(
        error.to_string().contains("background, older, younger"),
        "{error}"
    );
    let error = ready.layers([5, 3], &[2, 0, 3]).unwrap_err();
    assert!(error.to_string().contains("0 layers in older"), "{error}");
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let ready = Ready::new(checked(&source("coastal/coastal")));
    let boxes = ready.boxes([50, 40, 30]);
    let layers = ready.layers([40, 30], &[3]).unwrap();
    let all = || {
        let folder = tempfile::tempdir().unwrap();
        ready.write(&boxes, 2, &Format::ALL, folder.path());
        let mut files: Vec<_> = std::fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| entry.unwrap())
            .map(|entry| (entry.file_name(), std::fs::read(entry.path()).unwrap()))
            .collect();
        files.sort();
        (files, grdecl(&ready, &layers, 1))
    };
    let pool = |threads: usize| {
        let builder = rayon::ThreadPoolBuilder::new().num_threads(threads);
        builder.build().unwrap()
    };
    let one = pool(1).install(all);
    assert!(one.0.len() > 6);
    assert_eq!(one, pool(7).install(all));
}

#[test]
fn what_a_grid_takes_is_estimated_from_above() {
    let ready = corners();
    let cells = ready.boxes([30, 20, 15]);
    for format in Format::ALL {
        let folder = tempfile::tempdir().unwrap();
        let grid = ready.write(&cells, 1, &[format], folder.path());
        let size: u64 = std::fs::read_dir(folder.path())
            .unwrap()
            .map(|entry| entry.unwrap().metadata().unwrap().len())
            .sum();
        let estimate = grid::bytes(&cells, grid.arrays(), &[format]);
        // But for headers, and the pillars of a small grid.
        assert!((size as f64) < estimate + 50_000.0, "{size} of {estimate}");
    }
}
