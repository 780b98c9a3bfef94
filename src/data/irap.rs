//! IRAP classic ASCII grids.
//!
//! ```text
//! -996 NROW XINC YINC
//! XMIN XMAX YMIN YMAX
//! NCOL ROTATION XROT YROT
//! 0 0 0 0 0 0 0
//! heights, x fastest from the south-west node
//! ```
//! The number of rows comes first. The grid is turned counter-clockwise by degrees about (XROT, YROT); its limits are those before
//! it is turned. Heights of 9999900 and more stand for no data.

use glam::DVec2;

use super::error::DataError;
use super::format::Format;
use super::heights::{Grid, Heights, Layout};
use super::text::{self, Values};

/// From here on a height stands for no data.
const NULL: f64 = 9_999_900.0;

pub(super) fn read(text: &str) -> Result<Heights, DataError> {
    let mut words = text::words_after(text, 0);
    let mut last = 1;
    let mut number = |expected: &'static str| {
        let Some((line, word)) = words.next() else {
            return Err(DataError::Missing {
                line: last,
                what: expected,
            });
        };
        last = line;
        let found = || word.chars().take(40).collect();
        text::number(word)
            .map(|value| (value, line))
            .ok_or_else(|| DataError::Header {
                line,
                expected,
                found: found(),
            })
    };
    let (id, line) = number("-996")?;
    if id != -996.0 {
        return Err(DataError::Header {
            line,
            expected: "-996, with which IRAP classic grids begin",
            found: id.to_string(),
        });
    }
    let rows = number("the number of rows")?;
    let steps = [number("the step along x")?, number("the step along y")?];
    let [west, _, south, _] = [
        number("the least x")?,
        number("the greatest x")?,
        number("the least y")?,
        number("the greatest y")?,
    ];
    let columns = number("the number of columns")?;
    let turned = number("the rotation in degrees")?;
    let about = [number("x of the rotation")?, number("y of the rotation")?];
    for _ in 0..7 {
        number("seven zeros")?;
    }
    let counts = [
        text::count(columns.0, "columns", columns.1)?,
        text::count(rows.0, "rows", rows.1)?,
    ];
    let step = DVec2::new(
        text::step(steps[0].0, "column", steps[0].1)?,
        text::step(steps[1].0, "row", steps[1].1)?,
    );
    let line = last;
    let values = Values {
        words,
        line,
        bytes: text.len(),
        counts,
    };
    let values = values.read(|z| z >= NULL)?;
    let rotation = turned.0.to_radians();
    let centre = DVec2::new(about[0].0, about[1].0);
    let corner = DVec2::new(west.0, south.0);
    let first = if rotation == 0.0 {
        corner
    } else {
        centre + DVec2::from_angle(rotation).rotate(corner - centre)
    };
    let [nx, ny] = counts;
    let heights = (0..nx * ny).map(|entry| values[entry % ny * nx + entry / ny]);
    Ok(Heights {
        format: Format::Irap,
        layout: Layout::Grid(Grid {
            first,
            step,
            rotation,
            counts,
            heights: heights.collect(),
        }),
        positive: None,
    })
}
