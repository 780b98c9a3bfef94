//! Faces on planes, without what of their borders is none: seams and poles.
//!
//! A flat sheet with a pole (the base of a lobe) has a seam from the pole to its rim, at both ends of a parameter. In these parameters
//! a face that crosses the seam has it twice in its border, once in each direction. A plane knows no seam: there the two make a slit
//! that leads nowhere, and holes hang on it. So such edges are left out, and what they linked is linked anew: each loop goes on behind
//! the slit where the other side of it goes on.

use std::collections::BTreeMap;

/// A step of a border: an edge, run through forwards or backwards; or none, at a pole.
pub(super) type Step = (Option<usize>, bool);

/// The loops of a face without slits and poles; of several the outer one first, by a measure of their sizes.
pub(super) fn left_out(loops: &[Vec<Step>], size: impl Fn(&[Step]) -> f64) -> Vec<Vec<Step>> {
    let steps: Vec<Step> = loops.concat();
    let mut times: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (at, step) in steps.iter().enumerate() {
        if let Some(edge) = step.0 {
            times.entry(edge).or_default().push(at);
        }
    }
    let mut next: Vec<usize> = Vec::with_capacity(steps.len());
    for own in loops {
        let first = next.len();
        next.extend((0..own.len()).map(|at| first + (at + 1) % own.len()));
    }
    let mut is_left: Vec<bool> = steps.iter().map(|step| step.0.is_some()).collect();
    // By step, what comes after it once slits are gone: behind one side of a slit comes what is behind its other side.
    let mut other: Vec<usize> = (0..steps.len()).collect();
    for pair in times.values() {
        if let [one, two] = pair[..]
            && steps[one].1 != steps[two].1
        {
            is_left[one] = false;
            is_left[two] = false;
            (other[one], other[two]) = (two, one);
        }
    }
    let after = |at: usize| {
        let mut at = next[at];
        // Each slit is passed by its other side, each pole as it is; no more often than there are steps.
        for _ in 0..=2 * steps.len() {
            if is_left[at] {
                break;
            }
            at = next[other[at]];
        }
        at
    };
    let mut made: Vec<Vec<Step>> = Vec::new();
    let mut is_done = vec![false; steps.len()];
    for start in 0..steps.len() {
        let mut own = Vec::new();
        let mut at = start;
        while is_left[at] && !is_done[at] {
            is_done[at] = true;
            own.push(steps[at]);
            at = after(at);
        }
        if !own.is_empty() {
            made.push(own);
        }
    }
    if made.len() > 1 {
        let sizes: Vec<f64> = made.iter().map(|own| size(own)).collect();
        let outer = (0..made.len()).fold(
            0,
            |best, at| if sizes[at] > sizes[best] { at } else { best },
        );
        made.swap(0, outer);
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(edges: &[i32]) -> Vec<Step> {
        let step = |edge: &i32| match edge {
            0 => (None, false),
            edge => (Some(edge.unsigned_abs() as usize), *edge < 0),
        };
        edges.iter().map(step).collect()
    }

    /// The loops of a face, of which the one with the greatest edge is the largest.
    fn without_slits(loops: &[&[i32]]) -> Vec<Vec<i32>> {
        let loops: Vec<Vec<Step>> = loops.iter().map(|own| steps(own)).collect();
        let size = |own: &[Step]| own.iter().filter_map(|step| step.0).max().unwrap_or(0) as f64;
        left_out(&loops, size)
            .iter()
            .map(|own| {
                let number = |step: &Step| {
                    let edge = i32::try_from(step.0.unwrap_or(0)).unwrap_or(0);
                    if step.1 { -edge } else { edge }
                };
                own.iter().map(number).collect()
            })
            .collect()
    }

    #[test]
    fn a_disc_is_its_rim() {
        // The rim, inwards along the seam, around the pole, outwards.
        assert_eq!(without_slits(&[&[9, 2, 0, -2]]), [[9]]);
        // The rim in two pieces, the seam too.
        assert_eq!(without_slits(&[&[8, 9, 2, 3, 0, -3, -2]]), [[8, 9]]);
    }

    #[test]
    fn a_ring_is_an_outer_loop_and_a_hole() {
        assert_eq!(without_slits(&[&[4, 2, 9, -2]]), [[9], [4]]);
        // With a hole beside the seam, and another one that the seam passes through.
        assert_eq!(
            without_slits(&[&[9, 2, 4, 3, 0, -3, 5, -2], &[6, 7]]),
            [vec![9], vec![4, 5], vec![6, 7]]
        );
    }

    #[test]
    fn a_seam_between_two_faces_stays() {
        assert_eq!(without_slits(&[&[4, 2, 9, 3]]), [[4, 2, 9, 3]]);
    }
}
