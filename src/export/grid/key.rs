//! What the numbers of a grid mean: `MODEL.grid.json`, and `MODEL.grid.csv` with a line for each volume.

use serde::Serialize;

use super::format::Format;
use super::frame::Cells;
use super::gslib;
use super::sampled::Grid;
use crate::model::labels;

/// All that a grid's files do not say themselves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Key {
    /// Name and version of this schema.
    pub schema: &'static str,
    /// The model's name.
    pub model: String,
    /// The seed of its draws.
    pub seed: u64,
    /// Cells along x, y and z.
    pub cells: [usize; 3],
    /// The lower south-western corner (m, z up).
    pub corner: [f64; 3],
    /// A cell's extents along x, y and z (m); null if layers follow horizons.
    pub size: Option<[f64; 3]>,
    /// Layers between horizons, from the base up.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<LayersEntry>,
    /// Samples in each cell; of one it is the middle.
    pub samples: usize,
    /// What was added to the model's coordinates (m).
    pub shift: [f64; 3],
    /// Cells outside of the domain, or without thickness.
    pub cells_outside: u64,
    /// The arrays, in their order.
    pub arrays: Vec<ArrayEntry>,
    /// The files, with how cells follow each other in them.
    pub files: Vec<FileEntry>,
    /// The facies, by number.
    pub facies: Vec<FaciesShare>,
    /// The volumes, by number.
    pub volumes: Vec<VolumeShare>,
}

/// Layers of one interval.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayersEntry {
    /// The unit.
    pub unit: String,
    /// How many layers.
    pub layers: usize,
}

/// An array.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArrayEntry {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its keyword in GRDECL; null if it is not there.
    pub keyword: Option<String>,
    /// Facies with volumes that lack it.
    pub unknown_in: Vec<String>,
}

/// A file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FileEntry {
    /// Its format.
    pub format: &'static str,
    /// Its name; of npy, which has a file for each array, with that one's name in the place of `*`.
    pub file: String,
    /// How cells follow each other.
    pub order: &'static str,
    /// What stands for cells outside, and for what is not known.
    pub null: &'static str,
}

/// What a facies has of the grid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FaciesShare {
    /// Its number.
    pub number: i32,
    /// Its name.
    pub facies: String,
    /// Cells.
    pub cells: u64,
    /// Volume of these (m³).
    pub volume_m3: f64,
    /// Share of all cells' volume.
    pub fraction: f64,
}

/// What a volume has of the grid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VolumeShare {
    /// Its number.
    pub number: i32,
    /// Its name, the same in every file.
    pub volume: String,
    /// What it is called where people read; null if that is its name.
    pub display_name: Option<String>,
    /// Its facies.
    pub facies: String,
    /// The number of that.
    pub facies_number: i32,
    /// The facies' colour.
    pub color: String,
    /// Cells.
    pub cells: u64,
    /// Volume of these (m³).
    pub volume_m3: f64,
    /// Share of all cells' volume.
    pub fraction: f64,
}

impl Key {
    /// Of a grid, and of its files in these formats with names that begin with `stem`.
    pub fn new(grid: &Grid<'_>, formats: &[Format], stem: &str) -> Self {
        let source = grid.source;
        let layers = match source.cells {
            Cells::Boxes { .. } => &[],
            Cells::Layers(layers) => layers.intervals(),
        };
        Self {
            schema: "clinothem-grid-1",
            model: source.model.name.clone(),
            seed: source.model.seed,
            cells: source.cells.counts(),
            corner: grid.corner().to_array(),
            size: grid.size().map(|size| size.to_array()),
            layers: layers
                .iter()
                .map(|interval| LayersEntry {
                    unit: interval.name.clone(),
                    layers: interval.layers,
                })
                .collect(),
            samples: source.samples.pow(3),
            shift: source.shift.to_array(),
            cells_outside: grid.labels.outside,
            arrays: arrays(grid),
            files: formats.iter().map(|format| file(*format, stem)).collect(),
            facies: facies(grid),
            volumes: volumes(grid),
        }
    }

    /// As JSON, with a line break at its end.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// The volumes as a table.
    pub fn to_csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for volume in &self.volumes {
            writer.serialize(volume)?;
        }
        writer
            .into_inner()
            .map_err(|error| csv::Error::from(error.into_error()))
    }
}

fn total(grid: &Grid<'_>) -> f64 {
    grid.labels.sizes.iter().sum()
}

fn arrays(grid: &Grid<'_>) -> Vec<ArrayEntry> {
    let whole = |name: &str| ArrayEntry {
        name: name.to_owned(),
        unit: "",
        keyword: Some(name.to_uppercase()),
        unknown_in: Vec::new(),
    };
    let mut all = vec![whole("volume"), whole("facies")];
    let keywords = super::grdecl::keywords(&grid.arrays);
    for (rock, keyword) in grid.arrays.rock.iter().zip(keywords) {
        // Only what has cells is missed.
        let lacking = (0..rock.values.len())
            .filter(|volume| rock.values[*volume].is_nan() && grid.labels.cells[*volume] > 0);
        let mut unknown_in: Vec<String> = lacking
            .map(|volume| grid.source.realisation.volumes[volume].facies.clone())
            .collect();
        unknown_in.sort();
        unknown_in.dedup();
        all.push(ArrayEntry {
            name: rock.name.clone(),
            unit: rock.unit,
            keyword,
            unknown_in,
        });
    }
    all
}

fn file(format: Format, stem: &str) -> FileEntry {
    const UPWARD: &str = "x eastward fastest, then y northward, then z upward";
    let (name, order, null) = match format {
        Format::Vti => ("vti", UPWARD, "-1 in whole numbers, else NaN"),
        Format::Npy => (
            "*.npy",
            "a[i, j, k]: i eastward, j northward, k upward, from 0; the first index runs fastest",
            "-1 in whole numbers, else NaN",
        ),
        Format::Gslib => ("gslib", UPWARD, gslib::Flavour::Gslib.null()),
        Format::Sgems => ("sgems", UPWARD, gslib::Flavour::Sgems.null()),
        Format::Grdecl => (
            "grdecl",
            "I eastward fastest, then J from north to south, then K downward; depths positive down",
            "ACTNUM 0; -1 in whole numbers, else 0",
        ),
    };
    FileEntry {
        format: format.name(),
        file: format!("{stem}.{name}"),
        order,
        null,
    }
}

fn facies(grid: &Grid<'_>) -> Vec<FaciesShare> {
    let total = total(grid);
    let labels = &grid.labels;
    let of = |(at, facies): (usize, &crate::model::Facies)| {
        let number = i32::try_from(at + 1).unwrap_or(i32::MAX);
        let own = (0..labels.cells.len()).filter(|volume| grid.arrays.facies[*volume] == number);
        let volume_m3 = own
            .clone()
            .fold(0.0, |sum, volume| sum + labels.sizes[volume]);
        FaciesShare {
            number,
            facies: facies.name.clone(),
            cells: own.map(|volume| labels.cells[volume]).sum(),
            volume_m3,
            fraction: share(volume_m3, total),
        }
    };
    grid.source
        .model
        .facies
        .iter()
        .enumerate()
        .map(of)
        .collect()
}

fn share(part: f64, total: f64) -> f64 {
    if total > 0.0 { part / total } else { 0.0 }
}

fn volumes(grid: &Grid<'_>) -> Vec<VolumeShare> {
    let source = grid.source;
    let total = total(grid);
    let display = labels::labels(source.model, &source.realisation.volumes);
    let rules = &source.realisation.rules;
    let wholes = (0..source.realisation.volumes.len()).filter(|at| rules.whole(*at) == *at);
    let entry = |volume: usize| {
        let own = &source.realisation.volumes[volume];
        let facies = source.model.facies.iter();
        let color = facies
            .clone()
            .find(|facies| facies.name == own.facies)
            .map(|facies| facies.color);
        VolumeShare {
            number: grid.arrays.volumes[volume],
            volume: own.name.clone(),
            display_name: display[volume].clone(),
            facies: own.facies.clone(),
            facies_number: grid.arrays.facies[volume],
            color: color.map_or_else(String::new, |c| {
                format!("#{:02x}{:02x}{:02x}", c.r, c.g, c.b)
            }),
            cells: grid.labels.cells[volume],
            volume_m3: grid.labels.sizes[volume],
            fraction: share(grid.labels.sizes[volume], total),
        }
    };
    wholes.map(entry).collect()
}
