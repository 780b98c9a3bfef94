//! A channel's section by what docs/model-file.md and the code's own formula for its seven control points say,
//! evaluated here by de Boor's recursion; areas by layers.

/// Depth of a symmetric section of a given width and depth below its rims at a distance from its middle (m).
pub(crate) struct Section {
    half: f64,
    /// Half widths at evenly spaced parameters from the thalweg to a rim, with their depths.
    bank: Vec<[f64; 2]>,
}

const KNOTS: [f64; 11] = [0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0, 1.0];
/// Even, for Simpson's rule.
const STEPS: usize = 4096;

/// The cubic B-spline over [`KNOTS`] at t, by de Boor's recursion.
fn spline(values: [f64; 7], t: f64) -> f64 {
    let span = (3..7).rev().find(|k| KNOTS[*k] <= t).unwrap_or(3);
    let mut d: [f64; 4] = std::array::from_fn(|j| values[j + span - 3]);
    for r in 1..4 {
        for j in (r..4).rev() {
            let i = j + span - 3;
            let a = (t - KNOTS[i]) / (KNOTS[i + 4 - r] - KNOTS[i]);
            d[j] = (1.0 - a) * d[j - 1] + a * d[j];
        }
    }
    d[3]
}

impl Section {
    pub(crate) fn new(width: f64, depth: f64) -> Self {
        let half = width / 2.0;
        let across = [
            -half,
            -0.8 * half,
            -0.45 * half,
            0.0,
            0.45 * half,
            0.8 * half,
            half,
        ];
        let down = [0.0, 0.65, 1.0, 1.0, 1.0, 0.65, 0.0].map(|z| z * depth);
        let bank = (0..=STEPS)
            .map(|k| 0.5 + 0.5 * k as f64 / STEPS as f64)
            .map(|t| [spline(across, t), spline(down, t)])
            .collect();
        Self { half, bank }
    }

    /// ∫ f(half width, depth) d(depth) from the rims down: by Simpson's rule over the parameter, for smooth f.
    fn over_depth(&self, f: impl Fn(f64) -> f64) -> f64 {
        // Each knot span by itself: the third derivative jumps at knots. dz/dt by the spline's own differences
        // would lose digits, so ∫ f dz = −∫ f z' dt is taken by parts of exact cubic pieces: Richardson on trapezia.
        let trapezia = |step: usize| -> f64 {
            let ends = self.bank.iter().step_by(step);
            let next = self.bank.iter().step_by(step).skip(1);
            let pairs = ends.zip(next);
            pairs
                .map(|(a, b)| (a[1] - b[1]) * (f(a[0]) + f(b[0])) / 2.0)
                .sum()
        };
        let (coarse, fine) = (trapezia(2), trapezia(1));
        fine + (fine - coarse) / 3.0
    }

    /// Area (m²): the width at every depth, over the depths.
    pub(crate) fn area(&self) -> f64 {
        self.over_depth(|half| 2.0 * half)
    }

    /// Volume common to two such channels of one top that cross at right angles (m³): a square at every depth.
    pub(crate) fn crossing(&self) -> f64 {
        self.over_depth(|half| 4.0 * half * half)
    }

    /// ∫ depth · |distance from the middle| (m³): what a channel along a diagonal loses in a corner.
    pub(crate) fn moment(&self) -> f64 {
        self.over_depth(|half| half * half)
    }
}

#[test]
fn a_section_is_a_spline_through_its_rims_and_its_thalweg() {
    let section = Section::new(80.0, 10.0);
    assert_eq!(section.half, 40.0);
    let [first, last] = [section.bank[0], section.bank[STEPS]];
    assert!(first[0].abs() < 1e-12 && (first[1] - 10.0).abs() < 1e-12);
    assert!((last[0] - 40.0).abs() < 1e-12 && last[1].abs() < 1e-12);
    // ∫ y x' dt over the four spans in exact fractions is 611.65 m² for 80 m by 10 m.
    assert!((section.area() - 611.65).abs() < 5e-3, "{}", section.area());
}
