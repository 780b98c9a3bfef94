//! Tables with a header: names of columns, between commas, semicolons, tabs or blanks.
//!
//! Between semicolons or tabs numbers may have a decimal comma.

use ::csv::{ReaderBuilder, StringRecord, Trim};
use glam::DVec2;

use super::error::DataError;
use super::format::Format;
use super::heights::{Heights, Layout, Point};
use super::text;

/// What columns are called, in small letters, if nobody says which they are; the first that is there counts.
const NAMES: [&[&str]; 3] = [
    &[
        "x", "easting", "east", "x_utm", "utm_x", "xcoord", "x_coord", "x (m)", "lon_m",
    ],
    &[
        "y", "northing", "north", "y_utm", "utm_y", "ycoord", "y_coord", "y (m)", "lat_m",
    ],
    &[
        "z",
        "elevation",
        "height",
        "tvdss",
        "depth",
        "z (m)",
        "value",
    ],
];
/// Cells that stand for no data.
const NONE: [&str; 6] = ["", "nan", "null", "none", "na", "-"];

pub(super) fn read(text: &str, columns: Option<&[String; 3]>) -> Result<Heights, DataError> {
    let Some((first, names)) = text::uncommented(text).next() else {
        return Err(DataError::Empty);
    };
    let delimiter = [';', '\t', ',']
        .into_iter()
        .find(|one| names.contains(*one));
    let mut points = Vec::new();
    let mut places = None;
    let mut take = |line: usize, cells: &[&str]| -> Result<(), DataError> {
        let Some(places) = places else {
            places = Some(places_of(line, cells, columns)?);
            return Ok(());
        };
        points.push(point(line, cells, places, delimiter)?);
        Ok(())
    };
    let Some(delimiter) = delimiter else {
        for (line, row) in text::uncommented(text) {
            let cells: Vec<&str> = row.split_whitespace().collect();
            take(line, &cells)?;
        }
        return Ok(made(points));
    };
    // Comments above the header may begin otherwise than those that the reader knows.
    let above: usize = text
        .split_inclusive('\n')
        .take(first - 1)
        .map(str::len)
        .sum();
    let mut reader = ReaderBuilder::new()
        .delimiter(u8::try_from(delimiter).unwrap_or(b','))
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(&text.as_bytes()[above..]);
    let mut record = StringRecord::new();
    loop {
        let line = line_of(reader.position().line()) + first - 1;
        let more = reader.read_record(&mut record);
        let more = more.map_err(|error| DataError::Number {
            line,
            found: error.to_string(),
        })?;
        if !more {
            return Ok(made(points));
        }
        let own = record
            .position()
            .map_or(line, |at| line_of(at.line()) + first - 1);
        let cells: Vec<&str> = record.iter().collect();
        if cells.iter().any(|cell| !cell.is_empty()) {
            take(own, &cells)?;
        }
    }
}

fn made(points: Vec<Point>) -> Heights {
    Heights {
        format: Format::Csv,
        layout: Layout::Points(points),
        positive: None,
    }
}

fn line_of(line: u64) -> usize {
    usize::try_from(line).unwrap_or(usize::MAX)
}

/// Where x, y and z stand in a row.
fn places_of(
    line: usize,
    header: &[&str],
    columns: Option<&[String; 3]>,
) -> Result<[usize; 3], DataError> {
    let is = |at: usize, name: &str| header[at].eq_ignore_ascii_case(name);
    let find = |name: &str| (0..header.len()).find(|at| is(*at, name));
    let mut places = [0; 3];
    for (axis, place) in places.iter_mut().enumerate() {
        let (found, wanted) = if let Some(columns) = columns {
            let column = &columns[axis];
            let numbered = column.parse::<usize>().ok();
            let numbered = numbered.and_then(|n| n.checked_sub(1));
            let numbered = numbered.filter(|at| *at < header.len());
            (find(column).or(numbered), column.clone())
        } else {
            let found = NAMES[axis].iter().find_map(|name| find(name));
            (found, NAMES[axis][0].to_owned())
        };
        *place = found.ok_or_else(|| DataError::Column {
            line,
            column: wanted,
            found: header.join(", "),
        })?;
    }
    Ok(places)
}

fn point(
    line: usize,
    cells: &[&str],
    places: [usize; 3],
    delimiter: Option<char>,
) -> Result<Point, DataError> {
    let [x, y, z] = places.map(|place| cells.get(place).copied());
    let (Some(x), Some(y)) = (x, y) else {
        return Err(DataError::Header {
            line,
            expected: "as many cells as the header has names",
            found: cells.join(" "),
        });
    };
    let number = |cell: &str| {
        if delimiter != Some(',') && cell.contains(',') && text::number(cell).is_none() {
            return text::need(&cell.replace(',', "."), line);
        }
        text::need(cell, line)
    };
    let z = z.unwrap_or_default();
    let is_none = NONE.iter().any(|none| z.eq_ignore_ascii_case(none));
    Ok(Point {
        at: DVec2::new(number(x)?, number(y)?),
        height: if is_none { None } else { Some(number(z)?) },
        line: u32::try_from(line).unwrap_or(u32::MAX),
    })
}
