//! Lengths that vary along a line, such as the throw along a fault's strike.

/// A length along a line: one for all of it, or through given ones at places along it. Between these it is a cubic that nowhere exceeds
/// its ends (Fritsch & Carlson 1980), once differentiable; beyond them it goes on straight.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Places (m) with values (m) and slopes.
    nodes: Vec<[f64; 3]>,
}

impl Variation {
    /// The same everywhere.
    pub fn constant(value: f64) -> Self {
        Self {
            nodes: vec![[0.0, value, 0.0]],
        }
    }

    /// Through values at places that grow (m); nothing if they do not, are no numbers or there are none.
    pub fn through(places: &[[f64; 2]]) -> Option<Self> {
        let is_good = places.iter().flatten().all(|x| x.is_finite())
            && places.windows(2).all(|pair| pair[1][0] > pair[0][0]);
        let first = *places.first().filter(|_| is_good)?;
        if places.iter().all(|place| place[1] == first[1]) {
            return Some(Self::constant(first[1]));
        }
        let secants: Vec<f64> = places
            .windows(2)
            .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]))
            .collect();
        let last = secants.len();
        let slope = |k: usize| {
            if k == 0 || k == last {
                return secants[k.min(last - 1)];
            }
            let (a, b) = (secants[k - 1], secants[k]);
            // The harmonic mean of neighbours of one sign is below twice the smaller: the cubics are monotonic.
            if a * b > 0.0 {
                2.0 * a * b / (a + b)
            } else {
                0.0
            }
        };
        let nodes = places.iter().enumerate();
        let nodes = nodes.map(|(k, [at, value])| [*at, *value, slope(k)]);
        Some(Self {
            nodes: nodes.collect(),
        })
    }

    /// The value, if it is the same everywhere (m).
    pub fn fixed(&self) -> Option<f64> {
        match self.nodes[..] {
            [[_, value, _]] => Some(value),
            _ => None,
        }
    }

    /// The value at a place (m).
    pub fn value(&self, at: f64) -> f64 {
        self.jet(at)[0]
    }

    /// How it changes along the line at a place.
    pub fn slope(&self, at: f64) -> f64 {
        self.jet(at)[1]
    }

    fn jet(&self, at: f64) -> [f64; 2] {
        let nodes = &self.nodes;
        let after = nodes.partition_point(|node| node[0] <= at);
        let straight = |[x, value, slope]: [f64; 3]| [value + slope * (at - x), slope];
        if after == 0 {
            return straight(nodes[0]);
        }
        if after == nodes.len() {
            return straight(nodes[after - 1]);
        }
        let ([x0, f0, d0], [x1, f1, d1]) = (nodes[after - 1], nodes[after]);
        let h = x1 - x0;
        let t = (at - x0) / h;
        let secant = (f1 - f0) / h;
        let (c2, c3) = (3.0 * secant - 2.0 * d0 - d1, d0 + d1 - 2.0 * secant);
        let value = f0 + h * t * (d0 + t * (c2 + t * c3));
        [value, d0 + t * (2.0 * c2 + 3.0 * t * c3)]
    }

    /// Least and greatest value between two places (m).
    pub fn range(&self, from: f64, to: f64) -> [f64; 2] {
        let inner = self.nodes.iter().map(|node| node[0]);
        let places = inner.filter(|x| (from..=to).contains(x)).chain([from, to]);
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], at| {
            let value = self.value(at);
            [least.min(value), most.max(value)]
        })
    }

    /// The steepest slope anywhere, as a magnitude.
    pub fn steepest(&self) -> f64 {
        let nodes = self.nodes.iter().map(|node| node[2].abs());
        // A cubic's slope is a parabola: where that is steepest inside, its secant says enough.
        let inner = self
            .nodes
            .windows(2)
            .map(|pair| 1.5 * ((pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).abs());
        nodes.chain(inner).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::Variation;

    #[test]
    fn values_are_met_between_two_it_is_straight_and_nowhere_exceeds_its_neighbours() {
        let line = Variation::through(&[[0.0, 10.0], [400.0, 30.0]]).unwrap();
        for x in [-40.0, 0.0, 13.0, 400.0, 444.0] {
            assert!((line.value(x) - (10.0 + 0.05 * x)).abs() < 1e-12);
            assert!((line.slope(x) - 0.05).abs() < 1e-15);
        }
        let places = [[0.0, 5.0], [10.0, 20.0], [30.0, 20.5], [50.0, 3.0]];
        let bent = Variation::through(&places).unwrap();
        for pair in places.windows(2) {
            for k in 0..=50 {
                let x = pair[0][0] + (pair[1][0] - pair[0][0]) * f64::from(k) / 50.0;
                let value = bent.value(x);
                let [a, b] = [pair[0][1], pair[1][1]];
                assert!(value >= a.min(b) - 1e-12 && value <= a.max(b) + 1e-12);
                let numeric = (bent.value(x + 1e-6) - bent.value(x - 1e-6)) / 2e-6;
                assert!((bent.slope(x) - numeric).abs() < 1e-5);
                assert!(bent.slope(x).abs() <= bent.steepest());
            }
        }
        for [x, value] in places {
            assert_eq!(bent.value(x), value);
        }
        assert!(Variation::through(&[[1.0, 2.0], [1.0, 3.0]]).is_none());
        assert_eq!(
            Variation::through(&[[1.0, 2.0], [9.0, 2.0]])
                .unwrap()
                .fixed(),
            Some(2.0)
        );
    }
}
