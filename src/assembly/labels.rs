//! Labels: which volume each of the kernel's cells belongs to.
//!
//! A face of a cell comes from faces of the arguments. Crossing it flips the side of exactly those
//! arguments, and its orientation tells which side is inside. So the sides of every cell follow from
//! its own faces and from its neighbours', without asking a kernel where a point lies. Whatever
//! contradicts itself is a fault of the partition and is reported, never repaired.

use crate::model::plan::{Cover, PlannedBody};
use crate::model::rules::{BACKGROUND, Rules};

/// Which volumes' insides hold a place, told from the sides of regions: domain, lids, shells.
#[derive(Clone, Debug)]
pub(crate) struct Holders {
    /// By volume: shell and what it must stay below, if it takes part.
    bodies: Vec<Option<(usize, Option<Cover>)>>,
    first_shell: usize,
}

impl Holders {
    pub(crate) fn new(bodies: &[PlannedBody], volumes: usize, lids: usize) -> Self {
        let mut of_volume = vec![None; volumes];
        for body in bodies {
            of_volume[body.volume] = Some((body.shell, body.below));
        }
        Self {
            bodies: of_volume,
            first_shell: 1 + lids,
        }
    }

    /// The volume that holds a place; `None` outside the domain.
    pub(crate) fn owner(&self, rules: &Rules, inside: &[bool]) -> Option<usize> {
        let holds = |volume: usize| {
            self.bodies[volume].is_some_and(|(shell, below)| {
                let cover = match below {
                    None => None,
                    Some(Cover::Lid(lid)) => Some(1 + lid),
                    Some(Cover::Horizon(shell)) => Some(self.first_shell + shell),
                };
                inside[self.first_shell + shell] && !cover.is_some_and(|region| inside[region])
            })
        };
        // That is known already, so it is asked first.
        let holders = (1..self.bodies.len()).filter(|volume| holds(*volume));
        inside[0].then(|| rules.owner_since(BACKGROUND, holders, holds))
    }
}

/// A face of the partition, seen from the cells.
#[derive(Clone, Debug, Default)]
pub(crate) struct Side {
    /// Arguments whose boundary the face lies on, with whether their outward normal is the face's.
    pub(crate) origins: Vec<(usize, bool)>,
}

/// A cell as the list of its faces; `true` = its outward normal is opposite to the face's.
pub(crate) type CellFaces = Vec<(usize, bool)>;

/// A partition that contradicts itself.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum LabelError {
    /// More than two cells use a face.
    #[error("face {face} bounds {cells} cells; a face has two sides")]
    TooManyCells { face: usize, cells: usize },
    /// Two cells lie on the same side of a face.
    #[error("cells {first} and {second} lie on the same side of face {face}")]
    SameSide {
        face: usize,
        first: usize,
        second: usize,
    },
    /// One face says inside, another outside.
    #[error("cell {cell} is both inside and outside of argument {argument}")]
    Contradiction { cell: usize, argument: usize },
    /// A cell that is connected to nothing known.
    #[error("the side of cell {cell} to argument {argument} cannot be told")]
    Unknown { cell: usize, argument: usize },
    /// The kernel's own images disagree.
    #[error("cell {cell}: its faces and the kernel disagree on argument {argument}")]
    SecondOpinion { cell: usize, argument: usize },
}

/// Whether each cell lies inside each argument: `[cell][argument]`.
pub(crate) fn sides(
    cells: &[CellFaces],
    faces: &[Side],
    arguments: usize,
) -> Result<Vec<Vec<bool>>, LabelError> {
    let users = users(cells, faces.len())?;
    let mut known: Vec<Vec<Option<bool>>> = vec![vec![None; arguments]; cells.len()];
    for (cell, bounded_by) in cells.iter().enumerate() {
        for &(face, reversed) in bounded_by {
            for &(argument, same) in &faces[face].origins {
                // Both outward normals agree: the argument's material is where the cell is.
                let inside = same != reversed;
                set(&mut known, cell, argument, inside)?;
            }
            // Nothing lies beyond a face that bounds one cell only: whatever is not bounded by it there
            // is outside.
            if users[face].len() == 1 {
                for argument in 0..arguments {
                    if !faces[face]
                        .origins
                        .iter()
                        .any(|origin| origin.0 == argument)
                    {
                        set(&mut known, cell, argument, false)?;
                    }
                }
            }
        }
    }
    spread(&mut known, cells, faces, &users, arguments)?;
    let settled = known.iter().enumerate().map(|(cell, sides)| {
        let told = |(argument, side): (usize, &Option<bool>)| {
            side.ok_or(LabelError::Unknown { cell, argument })
        };
        sides.iter().enumerate().map(told).collect()
    });
    settled.collect()
}

/// The cells of each face, with the side on which they lie.
fn users(cells: &[CellFaces], faces: usize) -> Result<Vec<Vec<(usize, bool)>>, LabelError> {
    let mut users: Vec<Vec<(usize, bool)>> = vec![Vec::new(); faces];
    for (cell, bounded_by) in cells.iter().enumerate() {
        for &(face, reversed) in bounded_by {
            users[face].push((cell, reversed));
        }
    }
    for (face, used) in users.iter().enumerate() {
        match used[..] {
            [(first, a), (second, b)] if a == b => {
                return Err(LabelError::SameSide {
                    face,
                    first,
                    second,
                });
            }
            [] | [_] | [_, _] => {}
            _ => {
                return Err(LabelError::TooManyCells {
                    face,
                    cells: used.len(),
                });
            }
        }
    }
    Ok(users)
}

/// Carries sides across faces: what a face does not belong to is the same on both of its sides.
fn spread(
    known: &mut [Vec<Option<bool>>],
    cells: &[CellFaces],
    faces: &[Side],
    users: &[Vec<(usize, bool)>],
    arguments: usize,
) -> Result<(), LabelError> {
    for argument in 0..arguments {
        let mut waiting: Vec<usize> = (0..cells.len())
            .filter(|&cell| known[cell][argument].is_some())
            .collect();
        while let Some(cell) = waiting.pop() {
            let Some(side) = known[cell][argument] else {
                continue;
            };
            for &(face, _) in &cells[cell] {
                if faces[face]
                    .origins
                    .iter()
                    .any(|origin| origin.0 == argument)
                {
                    continue;
                }
                for &(neighbour, _) in users[face].iter().filter(|user| user.0 != cell) {
                    let fresh = known[neighbour][argument].is_none();
                    set(known, neighbour, argument, side)?;
                    if fresh {
                        waiting.push(neighbour);
                    }
                }
            }
        }
    }
    Ok(())
}

fn set(
    known: &mut [Vec<Option<bool>>],
    cell: usize,
    argument: usize,
    inside: bool,
) -> Result<(), LabelError> {
    let side = &mut known[cell][argument];
    if side.is_some_and(|other| other != inside) {
        return Err(LabelError::Contradiction { cell, argument });
    }
    *side = Some(inside);
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    /// A box (argument 0) with a smaller one (argument 1) wholly inside: face 0 is the outer skin, face
    /// 1 the inner one, both with outward normals.
    fn nested() -> (Vec<CellFaces>, Vec<Side>) {
        let faces = vec![
            Side {
                origins: vec![(0, true)],
            },
            Side {
                origins: vec![(1, true)],
            },
        ];
        // The outer cell has the inner skin as a hole: its outward normal points into the hole.
        (vec![vec![(0, false), (1, true)], vec![(1, false)]], faces)
    }

    #[test]
    fn a_body_inside_another_is_inside_both() {
        let (cells, faces) = nested();
        assert_eq!(
            sides(&cells, &faces, 2).unwrap(),
            [[true, false], [true, true]]
        );
    }

    #[test]
    fn orientation_of_the_origin_does_not_change_the_sides() {
        let (mut cells, mut faces) = nested();
        // The kernel may keep the inner face the other way round.
        faces[1].origins[0].1 = false;
        cells[0][1].1 = false;
        cells[1][0].1 = true;
        assert_eq!(
            sides(&cells, &faces, 2).unwrap(),
            [[true, false], [true, true]]
        );
    }

    #[test]
    fn a_face_of_two_arguments_flips_both() {
        // Two boxes side by side (arguments 0, 1) share face 2.
        let faces = vec![
            Side {
                origins: vec![(0, true)],
            },
            Side {
                origins: vec![(1, true)],
            },
            Side {
                origins: vec![(0, true), (1, false)],
            },
        ];
        let cells = vec![vec![(0, false), (2, false)], vec![(1, false), (2, true)]];
        assert_eq!(
            sides(&cells, &faces, 2).unwrap(),
            [[true, false], [false, true]]
        );
    }

    #[test]
    fn a_lost_cell_shows_as_a_contradiction() {
        // The background was lost: only the inner cell is left, so its skin would end the world.
        let (cells, faces) = nested();
        let lost = vec![cells[1].clone()];
        // Its only face belongs to argument 1, so it would lie outside of argument 0.
        assert_eq!(sides(&lost, &faces, 2).unwrap(), [[false, true]]);
        let twice = vec![cells[0].clone(), cells[1].clone(), cells[1].clone()];
        assert!(matches!(
            sides(&twice, &faces, 2),
            Err(LabelError::TooManyCells { .. })
        ));
        let flipped = vec![cells[0].clone(), vec![(1, true)]];
        assert!(matches!(
            sides(&flipped, &faces, 2),
            Err(LabelError::SameSide { .. })
        ));
    }
}
