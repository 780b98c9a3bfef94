//! Random rational curves and surfaces with points and derivatives on them, as JSON: what
//! `tests/crosscheck/test_geomdl.py` compares with another program. `cargo run --example nurbs_samples -- 100`
use clinothem::nurbs::{Curve, KnotVector, Surface};
use glam::DVec3;
use serde_json::{Value, json};
use std::error::Error;
use std::io::Write;

/// `SplitMix64` (Steele, Lea & Flood 2014): the same numbers on every machine.
struct Draws(u64);

impl Draws {
    /// Evenly spread from `low` to `high`.
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        low + (high - low) * ((z >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A whole number from `low` to `high`, both included.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small and positive"
    )]
    fn count(&mut self, low: usize, high: usize) -> usize {
        self.within(low as f64, high as f64 + 1.0) as usize
    }

    fn knots(&mut self, most: usize) -> Result<KnotVector, Box<dyn Error>> {
        let degree = self.count(1, most);
        let mut at = self.within(-2.0, 2.0);
        let mut knots = vec![at; degree + 1];
        for _ in 0..self.count(0, 4) {
            at += self.within(0.1, 1.0);
            knots.extend(vec![at; self.count(1, degree)]);
        }
        knots.extend(vec![at + self.within(0.1, 1.0); degree + 1]);
        Ok(KnotVector::new(degree, knots)?)
    }

    fn net(&mut self, count: usize) -> (Vec<DVec3>, Vec<f64>) {
        let mut point = || DVec3::from_array([(); 3].map(|()| self.within(-100.0, 100.0)));
        let points = (0..count).map(|_| point()).collect();
        let weights = (0..count).map(|_| self.within(0.3, 3.0)).collect();
        (points, weights)
    }

    /// Parameters of a domain: its ends and some between.
    fn parameters(&mut self, knots: &KnotVector) -> Vec<f64> {
        let (start, end) = knots.domain();
        let inner: Vec<f64> = (0..5).map(|_| self.within(start, end)).collect();
        [vec![start, end], inner].concat()
    }
}

fn arrays(points: &[DVec3]) -> Vec<[f64; 3]> {
    points.iter().map(DVec3::to_array).collect()
}

fn curve(draws: &mut Draws) -> Result<Value, Box<dyn Error>> {
    let knots = draws.knots(5)?;
    let (points, weights) = draws.net(knots.count());
    let at = draws.parameters(&knots);
    let curve = Curve::rational(knots, points, weights)?;
    let samples: Vec<Value> = at
        .iter()
        .map(|&u| {
            let derivatives = arrays(&curve.derivatives(u, 3));
            json!({ "u": u, "point": curve.point(u).to_array(), "derivatives": derivatives })
        })
        .collect();
    Ok(json!({
        "degree": curve.degree(),
        "knots": curve.knots().as_slice(),
        "points": arrays(curve.points()),
        "weights": curve.weights(),
        "samples": samples,
    }))
}

fn surface(draws: &mut Draws) -> Result<Value, Box<dyn Error>> {
    let (u, v) = (draws.knots(4)?, draws.knots(4)?);
    let (net, weights) = draws.net(u.count() * v.count());
    let (at_u, at_v) = (draws.parameters(&u), draws.parameters(&v));
    let surface = Surface::rational(u, v, net, weights)?;
    let sample = |u: f64, v: f64| {
        let derivatives: Vec<_> = surface
            .derivatives(u, v, 2)
            .iter()
            .map(|row| arrays(row))
            .collect();
        json!({ "u": u, "v": v, "point": surface.point(u, v).to_array(), "derivatives": derivatives })
    };
    let samples: Vec<Value> = at_u
        .iter()
        .flat_map(|&u| at_v.iter().map(move |&v| (u, v)))
        .map(|(u, v)| sample(u, v))
        .collect();
    Ok(json!({
        "degrees": [surface.knots_u().degree(), surface.knots_v().degree()],
        "knots": [surface.knots_u().as_slice(), surface.knots_v().as_slice()],
        "points": arrays(surface.net()),
        "weights": surface.weights(),
        "samples": samples,
    }))
}

fn main() -> Result<(), Box<dyn Error>> {
    let count: usize = std::env::args()
        .nth(1)
        .map_or(Ok(100), |text| text.parse())?;
    let mut draws = Draws(20);
    let curves = (0..count)
        .map(|_| curve(&mut draws))
        .collect::<Result<Vec<_>, _>>()?;
    let surfaces = (0..count)
        .map(|_| surface(&mut draws))
        .collect::<Result<Vec<_>, _>>()?;
    serde_json::to_writer(
        std::io::stdout(),
        &json!({ "curves": curves, "surfaces": surfaces }),
    )?;
    writeln!(std::io::stdout())?;
    Ok(())
}
