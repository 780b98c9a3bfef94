//! GOCAD triangulated surfaces (`.ts`): the vertices of their triangles.
//!
//! `VRTX i x y z` and `PVRTX i x y z …`, `ATOM i j` for a copy of a vertex, `TRGL a b c`; numbers of vertices may begin anywhere, and a
//! file may have several parts. `ZPOSITIVE Depth` tells that z grows downwards.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3};

use super::error::DataError;
use super::format::Format;
use super::heights::{Heights, Layout, Point, Positive};
use super::text;

pub(super) fn read(text: &str) -> Result<Heights, DataError> {
    let mut vertices: BTreeMap<u64, (DVec3, u32)> = BTreeMap::new();
    let mut used: BTreeSet<u64> = BTreeSet::new();
    let mut positive = None;
    let (mut last, mut is_complete) = (1, false);
    for (line, found) in text::uncommented(text) {
        let words: Vec<&str> = found.split_whitespace().collect();
        match words[0].to_ascii_uppercase().as_str() {
            "VRTX" | "PVRTX" => {
                let numbers = rest(&words, 4, line, found, "VRTX, its number, x, y and z")?;
                let at = DVec3::new(numbers[1], numbers[2], numbers[3]);
                vertices.insert(whole(numbers[0], line)?, (at, number_of(line)));
            }
            "ATOM" | "PATOM" => {
                let numbers = rest(&words, 2, line, found, "ATOM, its number and a vertex's")?;
                let (own, other) = (whole(numbers[0], line)?, whole(numbers[1], line)?);
                let vertex = vertices.get(&other).copied();
                let vertex = vertex.ok_or(DataError::Vertex {
                    line,
                    vertex: other,
                })?;
                vertices.insert(own, vertex);
            }
            "TRGL" => {
                for vertex in rest(&words, 3, line, found, "TRGL and three vertices")? {
                    let vertex = whole(vertex, line)?;
                    if !vertices.contains_key(&vertex) {
                        return Err(DataError::Vertex { line, vertex });
                    }
                    used.insert(vertex);
                }
            }
            "ZPOSITIVE" => {
                let word = words.get(1).copied().unwrap_or_default();
                let is_depth = word.eq_ignore_ascii_case("depth");
                positive = Some(if is_depth {
                    Positive::Down
                } else {
                    Positive::Up
                });
            }
            "END" => is_complete = true,
            _ => {}
        }
        last = line;
    }
    if !is_complete || used.is_empty() {
        return Err(DataError::Missing {
            line: last,
            what: if is_complete {
                "any triangle (TRGL)"
            } else {
                "END"
            },
        });
    }
    let points = vertices.into_iter().filter(|(id, _)| used.contains(id));
    let points = points.map(|(_, (at, line))| Point {
        at: DVec2::new(at.x, at.y),
        height: Some(at.z),
        line,
    });
    Ok(Heights {
        format: Format::Tsurf,
        layout: Layout::Points(points.collect()),
        positive,
    })
}

/// The first numbers after a keyword.
fn rest(
    words: &[&str],
    count: usize,
    line: usize,
    found: &str,
    expected: &'static str,
) -> Result<Vec<f64>, DataError> {
    if words.len() <= count {
        return Err(DataError::header((line, found), expected));
    }
    let words = &words[1..=count];
    words.iter().map(|word| text::need(word, line)).collect()
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be a whole number below 2^53"
)]
fn whole(value: f64, line: usize) -> Result<u64, DataError> {
    if value.fract() == 0.0 && (0.0..9e15).contains(&value) {
        return Ok(value as u64);
    }
    let found = value.to_string();
    Err(DataError::Number { line, found })
}

fn number_of(line: usize) -> u32 {
    u32::try_from(line).unwrap_or(u32::MAX)
}
