//! Eclipse's grid keywords (GRDECL): corner points, active cells and arrays.
//!
//! ```text
//! I eastward, J from north to south, K downward; elevations as depths, positive down (m)
//! ```
//! so that the grid is right-handed with z down, as Eclipse takes it to be where a file does not say. There is no MAPAXES:
//! coordinates are those of the map. Pillars are upright. Cells outside of the domain, and cells without thickness, are not active.
//! A property that a volume does not have is 0 there, since the format has no other word for it.

use std::io::{self, Write};

use super::arrays::{Arrays, NO_NUMBER, RockArray};
use super::frame::Cells;
use super::gslib::number;
use super::labels::OUTSIDE;
use super::layers::Layers;
use super::repeats::Repeats;
use super::sampled::Grid;
use crate::export::text::ascii;

/// Words that mean something else to readers.
const TAKEN: [&str; 12] = [
    "SPECGRID", "COORD", "ZCORN", "ACTNUM", "MAPAXES", "GRIDUNIT", "MAPUNITS", "COORDSYS",
    "VOLUME", "FACIES", "INCLUDE", "ECHO",
];

/// Most letters of a keyword.
const LONGEST: usize = 8;

/// Writes the grid.
pub(super) fn write(to: &mut dyn Write, grid: &Grid<'_>) -> io::Result<()> {
    let [nx, ny, nz] = grid.labels().counts();
    let model = grid.source.model;
    writeln!(
        to,
        "-- {}, seed {}; {} {}",
        short(&ascii(&model.name)),
        model.seed,
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION")
    )?;
    writeln!(
        to,
        "-- I eastward, J from north to south, K downward; depths in metres, positive down; permeability in mD\n\
         -- numbers of VOLUME and FACIES: see the tables beside this file\n"
    )?;
    writeln!(to, "SPECGRID\n {nx} {ny} {nz} 1 F\n/\n")?;
    coord(to, grid)?;
    match grid.source.cells {
        Cells::Boxes { height, .. } => zcorn_of_boxes(to, grid, *height)?,
        Cells::Layers(layers) => zcorn_of_layers(to, grid, layers)?,
    }
    let volumes = grid.arrays.volumes.len();
    array(to, grid, "ACTNUM", &vec!["1".to_owned(); volumes], "0")?;
    let whole = |values: &[i32]| values.iter().map(i32::to_string).collect::<Vec<_>>();
    let none = NO_NUMBER.to_string();
    array(to, grid, "VOLUME", &whole(&grid.arrays.volumes), &none)?;
    array(to, grid, "FACIES", &whole(&grid.arrays.facies), &none)?;
    for (rock, keyword) in grid.arrays.rock.iter().zip(keywords(&grid.arrays)) {
        let Some(keyword) = keyword else { continue };
        let known = |value: &f32| if value.is_nan() { 0.0 } else { *value };
        let values: Vec<String> = rock.values.iter().map(|v| number(known(v))).collect();
        writeln!(to, "-- {}{}", short(&ascii(&rock.name)), in_unit(rock))?;
        array(to, grid, &keyword, &values, "0.0")?;
    }
    Ok(())
}

fn in_unit(rock: &RockArray) -> String {
    match rock.unit {
        "" => String::new(),
        unit => format!(" ({unit})"),
    }
}

/// As much as fits on a line.
fn short(text: &str) -> &str {
    // All ASCII.
    &text[..text.len().min(60)]
}

/// The keyword of each rock property; none where the format has no word: permeabilities between two axes.
pub(super) fn keywords(arrays: &Arrays) -> Vec<Option<String>> {
    let mut found: Vec<Option<String>> = Vec::new();
    for rock in &arrays.rock {
        if rock.is_mixed {
            found.push(None);
            continue;
        }
        let known = match rock.name.as_str() {
            "porosity" => "PORO",
            "permeability_x" => "PERMX",
            "permeability_y" => "PERMY",
            "permeability_z" => "PERMZ",
            "net" => "NTG",
            _ => "",
        };
        let is_free = |word: &str| {
            !TAKEN.contains(&word) && !found.iter().any(|one| one.as_deref() == Some(word))
        };
        let keyword = if known.is_empty() {
            own_keyword(&rock.name, &is_free)
        } else {
            known.to_owned()
        };
        found.push(Some(keyword));
    }
    found
}

/// A keyword of letters and digits that begins with a letter, with a number at its end where that is needed.
fn own_keyword(name: &str, is_free: &dyn Fn(&str) -> bool) -> String {
    let plain: String = ascii(name)
        .to_uppercase()
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .skip_while(char::is_ascii_digit)
        .take(LONGEST)
        .collect();
    let plain = if plain.is_empty() {
        "PROP".to_owned()
    } else {
        plain
    };
    let numbered = (2_u32..).map(|number| {
        let number = number.to_string();
        let kept = plain.len().min(LONGEST - number.len().min(LONGEST));
        format!("{}{number}", &plain[..kept])
    });
    std::iter::once(plain.clone())
        .chain(numbered)
        .find(|word| is_free(word))
        .unwrap_or(plain)
}

/// An elevation as a depth, to a micrometre.
fn depth(elevation: f64) -> String {
    // From +0: there is no depth of −0.
    length(0.0 - elevation)
}

/// A length to a micrometre, without zeros at its end.
fn length(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// The pillars: from west to east, then from north to south.
fn coord(to: &mut dyn Write, grid: &Grid<'_>) -> io::Result<()> {
    let cells = grid.source.cells;
    let shift = grid.source.shift;
    let [nx, ny] = cells.plan().counts;
    writeln!(to, "COORD")?;
    for j in (0..=ny).rev() {
        for i in 0..=nx {
            let at = cells.plan().at(i, j, glam::DVec2::ZERO);
            let [low, high] = match cells {
                Cells::Boxes {
                    base,
                    height,
                    count,
                    ..
                } => [*base, base + height * *count as f64],
                Cells::Layers(layers) => layers.pillar([i, j]),
            };
            let place = format!("{} {}", length(at.x + shift.x), length(at.y + shift.y));
            let [above, below] = [high, low].map(|z| depth(z + shift.z));
            writeln!(to, " {place} {above} {place} {below}")?;
        }
    }
    writeln!(to, "/\n")
}

fn zcorn_of_boxes(to: &mut dyn Write, grid: &Grid<'_>, height: f64) -> io::Result<()> {
    let [nx, ny, nz] = grid.labels().counts();
    let base = grid.corner().z;
    let corners = 4 * (nx * ny) as u64;
    let mut values = Repeats::new(to, "ZCORN")?;
    for k in (0..nz).rev() {
        for plane in [k + 1, k] {
            let z = base + height * plane as f64;
            values.add(depth(z).as_bytes(), corners)?;
        }
    }
    values.end()
}

fn zcorn_of_layers(to: &mut dyn Write, grid: &Grid<'_>, layers: &Layers) -> io::Result<()> {
    let [nx, ny, nz] = grid.labels().counts();
    let mut values = Repeats::new(to, "ZCORN")?;
    for k in (0..nz).rev() {
        for part in [1.0, 0.0] {
            for j in (0..ny).rev() {
                // The northern edge of a row of cells, then the southern one.
                for edge in [j + 1, j] {
                    let z = |i: usize| layers.elevation([i, edge], k, part) + grid.source.shift.z;
                    for i in 0..nx {
                        values.add(depth(z(i)).as_bytes(), 1)?;
                        values.add(depth(z(i + 1)).as_bytes(), 1)?;
                    }
                }
            }
        }
    }
    values.end()
}

/// An array over the cells.
fn array(
    to: &mut dyn Write,
    grid: &Grid<'_>,
    keyword: &str,
    values: &[String],
    outside: &str,
) -> io::Result<()> {
    let mut repeats = Repeats::new(to, keyword)?;
    grid.labels().downward(|row| {
        row.iter().try_for_each(|label| match *label {
            OUTSIDE => repeats.add(outside.as_bytes(), 1),
            label => repeats.add(values[label as usize].as_bytes(), 1),
        })
    })?;
    repeats.end()
}

/// Bytes for each cell where nothing repeats.
pub(super) fn bytes_per_cell(cells: &Cells, arrays: &Arrays) -> f64 {
    let corners = match cells {
        Cells::Boxes { .. } => 0.0,
        Cells::Layers(_) => 8.0 * 12.0,
    };
    // ACTNUM, and the numbers as the lines of GSLIB have them.
    corners + 2.0 + super::gslib::bytes_per_cell(arrays)
}

#[cfg(test)]
mod tests {
    use super::{Arrays, RockArray, depth, keywords};

    #[test]
    fn keywords_are_short_and_no_two_are_the_same() {
        let rock = |name: &str, is_mixed| RockArray {
            name: name.to_owned(),
            unit: "",
            is_mixed,
            values: Vec::new(),
        };
        let arrays = Arrays {
            volumes: Vec::new(),
            facies: Vec::new(),
            rock: vec![
                rock("porosity", false),
                rock("permeability_x", false),
                rock("permeability_xy", true),
                rock("net", false),
                rock("grain size mean", false),
                rock("grain size median", false),
                rock("7", false),
                rock("facies", false),
            ],
        };
        let found: Vec<Option<String>> = keywords(&arrays);
        let found: Vec<Option<&str>> = found.iter().map(Option::as_deref).collect();
        assert_eq!(
            found,
            [
                Some("PORO"),
                Some("PERMX"),
                None,
                Some("NTG"),
                Some("GRAINSIZ"),
                Some("GRAINSI2"),
                Some("PROP"),
                Some("FACIES2"),
            ]
        );
    }

    #[test]
    fn depths_count_down_from_zero() {
        assert_eq!(depth(-12.5), "12.5");
        assert_eq!(depth(0.0), "0");
        assert_eq!(depth(3.0), "-3");
        assert_eq!(depth(-1e-9), "0");
        assert_eq!(depth(-1000.0), "1000");
    }
}
