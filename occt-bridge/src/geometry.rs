//! Curves and surfaces, and everything about them that can be checked without evaluating them.

/// A curve in space.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// `start + t (end - start)`, t in 0..1.
    Line {
        /// At t = 0.
        start: [f64; 3],
        /// At t = 1.
        end: [f64; 3],
    },
    /// A clamped B-spline. If all its poles are within the tolerance of each other its edges are degenerate (a pole of a sphere).
    BSpline {
        /// Degree, at least 1.
        degree: usize,
        /// Flat, clamped knots: number of poles + degree + 1.
        knots: Vec<f64>,
        /// Control points.
        poles: Vec<[f64; 3]>,
        /// One positive weight per pole, if rational.
        weights: Option<Vec<f64>>,
    },
}

/// A surface.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// An unbounded plane.
    Plane {
        /// A point of it.
        origin: [f64; 3],
        /// Its normal, of any length.
        normal: [f64; 3],
        /// A direction that becomes u; not parallel to the normal.
        x_axis: [f64; 3],
    },
    /// A clamped B-spline surface; its normal is ∂u × ∂v.
    BSpline {
        /// Degree in u, at least 1.
        degree_u: usize,
        /// Degree in v, at least 1.
        degree_v: usize,
        /// Flat, clamped knots in u.
        knots_u: Vec<f64>,
        /// Flat, clamped knots in v.
        knots_v: Vec<f64>,
        /// Control points, u-major: (i, j) at i · nv + j.
        poles: Vec<[f64; 3]>,
        /// One positive weight per pole, if rational.
        weights: Option<Vec<f64>>,
    },
}

/// A curve in the parameters of a surface.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Debug, Clone, PartialEq)]
pub enum Pcurve {
    /// `origin + t direction`, t being the edge's parameter.
    Line {
        /// At t = 0.
        origin: [f64; 2],
        /// (du/dt, dv/dt), of any length.
        direction: [f64; 2],
    },
    /// A clamped B-spline over the edge's range.
    BSpline {
        /// Degree, at least 1.
        degree: usize,
        /// Flat, clamped knots.
        knots: Vec<f64>,
        /// Control points.
        poles: Vec<[f64; 2]>,
        /// One positive weight per pole, if rational.
        weights: Option<Vec<f64>>,
    },
}

/// Largest degree of the kernel's B-splines.
const MAX_DEGREE: usize = 25;

pub(crate) fn check_curve(curve: &Curve) -> Result<(), String> {
    match curve {
        Curve::Line { start, end } => finite("the ends of the line", [*start, *end].as_flattened()),
        Curve::BSpline {
            degree,
            knots,
            poles,
            weights,
        } => {
            check_knots("", knots, *degree, poles.len())?;
            finite("poles", poles.as_flattened())?;
            check_weights(weights.as_deref(), poles.len())
        }
    }
}

pub(crate) fn check_surface(surface: &Surface) -> Result<(), String> {
    match surface {
        Surface::Plane {
            origin,
            normal,
            x_axis,
        } => {
            finite(
                "origin, normal and x axis",
                [*origin, *normal, *x_axis].as_flattened(),
            )?;
            let cross: [f64; 3] = std::array::from_fn(|i| {
                let (a, b) = ((i + 1) % 3, (i + 2) % 3);
                normal[a] * x_axis[b] - normal[b] * x_axis[a]
            });
            let length = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length(&cross) <= 1e-9 * length(normal) * length(x_axis) {
                return Err(format!(
                    "the normal {normal:?} and the x axis {x_axis:?} do not span a plane"
                ));
            }
            Ok(())
        }
        Surface::BSpline {
            degree_u,
            degree_v,
            knots_u,
            knots_v,
            poles,
            weights,
        } => {
            let (nu, nv) = (
                pole_count(knots_u, *degree_u),
                pole_count(knots_v, *degree_v),
            );
            check_knots(" in u", knots_u, *degree_u, nu)?;
            check_knots(" in v", knots_v, *degree_v, nv)?;
            if poles.len() != nu * nv {
                return Err(format!(
                    "there are {} poles; the knots want {nu} × {nv}",
                    poles.len()
                ));
            }
            finite("poles", poles.as_flattened())?;
            check_weights(weights.as_deref(), poles.len())
        }
    }
}

pub(crate) fn check_pcurve(pcurve: &Pcurve) -> Result<(), String> {
    match pcurve {
        Pcurve::Line { origin, direction } => {
            finite("origin and direction", [*origin, *direction].as_flattened())?;
            if *direction == [0.0, 0.0] {
                return Err("the direction of its curve on the surface is zero".to_owned());
            }
            Ok(())
        }
        Pcurve::BSpline {
            degree,
            knots,
            poles,
            weights,
        } => {
            check_knots("", knots, *degree, poles.len())?;
            finite("poles", poles.as_flattened())?;
            check_weights(weights.as_deref(), poles.len())
        }
    }
}

/// First and last parameter of a checked curve.
pub(crate) fn curve_domain(curve: &Curve) -> (f64, f64) {
    match curve {
        Curve::Line { .. } => (0.0, 1.0),
        Curve::BSpline { knots, .. } => ends(knots),
    }
}

/// First and last parameter of a checked curve on a surface; `None` if it has no ends.
pub(crate) fn pcurve_domain(pcurve: &Pcurve) -> Option<(f64, f64)> {
    match pcurve {
        Pcurve::Line { .. } => None,
        Pcurve::BSpline { knots, .. } => Some(ends(knots)),
    }
}

fn ends(knots: &[f64]) -> (f64, f64) {
    (knots[0], knots[knots.len() - 1])
}

/// Number of poles that flat knots want.
pub(crate) fn pole_count(knots: &[f64], degree: usize) -> usize {
    knots.len().saturating_sub(degree + 1)
}

pub(crate) fn finite(what: &str, values: &[f64]) -> Result<(), String> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(at) => Err(format!(
            "{what} hold {} at number {at}; only finite numbers can be used",
            values[at]
        )),
        None => Ok(()),
    }
}

fn check_knots(what: &str, knots: &[f64], degree: usize, poles: usize) -> Result<(), String> {
    if degree == 0 || degree > MAX_DEGREE {
        return Err(format!(
            "the degree{what} is {degree}; it must be between 1 and {MAX_DEGREE}"
        ));
    }
    finite("knots", knots)?;
    if poles < degree + 1 || knots.len() != poles + degree + 1 {
        return Err(format!(
            "there are {} knots{what} for {poles} poles of degree {degree}; poles + degree + 1 are needed, and at least degree + 1 poles",
            knots.len()
        ));
    }
    if let Some(i) = knots.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(format!(
            "knot {} is {}, below the previous knot {}",
            i + 1,
            knots[i + 1],
            knots[i]
        ));
    }
    let clamped = knots[..=degree].iter().all(|k| *k == knots[0])
        && knots[poles..].iter().all(|k| *k == knots[poles]);
    // With clamped ends, an inner knot of multiplicity above the degree would tear the curve.
    let torn = (1..poles).any(|i| knots[i] == knots[i + degree]);
    if !clamped || torn || knots[degree] == knots[poles] {
        return Err(format!(
            "the knots{what} are not clamped: the first and last must be there exactly degree + 1 times, others at most degree times"
        ));
    }
    Ok(())
}

fn check_weights(weights: Option<&[f64]>, poles: usize) -> Result<(), String> {
    let Some(weights) = weights else {
        return Ok(());
    };
    if weights.len() != poles {
        return Err(format!(
            "there are {} weights for {poles} poles",
            weights.len()
        ));
    }
    match weights.iter().position(|w| !(*w > 0.0 && w.is_finite())) {
        Some(i) => Err(format!("weight {i} is {}; it must be above 0", weights[i])),
        None => Ok(()),
    }
}

pub(crate) fn small(value: usize) -> Result<u32, String> {
    u32::try_from(value).map_err(|_| format!("{value} is too large"))
}

pub(crate) fn index(what: &str, value: usize, length: usize) -> Result<(), String> {
    if value < length {
        Ok(())
    } else {
        Err(format!("names {what} {value}, but there are {length}"))
    }
}
