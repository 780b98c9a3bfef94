//! What a number may be, in numbers and in words.

/// What a number may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Whether the limits themselves are excluded.
    pub(crate) open: bool,
    pub(crate) words: &'static str,
}

pub(crate) const ANY: Limits = Limits {
    low: f64::NEG_INFINITY,
    high: f64::INFINITY,
    open: false,
    words: "can be any number",
};

pub(crate) const POSITIVE: Limits = Limits {
    low: 0.0,
    high: f64::INFINITY,
    open: true,
    words: "must be above 0",
};

pub(crate) const CONCAVE: Limits = Limits {
    low: 1.0,
    high: f64::INFINITY,
    open: false,
    words: "must be 1 (straight) or more (concave upwards)",
};

pub(crate) const ASYMMETRY: Limits = Limits {
    low: -0.5,
    high: 0.5,
    open: true,
    words: "must lie between -0.5 and 0.5 (a fraction of the width, 0 in the middle)",
};

pub(crate) const BANK_ANGLE: Limits = Limits {
    low: 0.0,
    high: 180.0,
    open: true,
    words: "must lie between 0 and 180 degrees",
};

pub(crate) const AZIMUTH: Limits = Limits {
    low: -360.0,
    high: 360.0,
    open: false,
    words: "must lie between -360 and 360 degrees, clockwise from north",
};

pub(crate) const PLUNGE: Limits = Limits {
    low: -90.0,
    high: 90.0,
    open: false,
    words: "must lie between -90 and 90 degrees, downwards from the horizontal",
};

pub(crate) const NOT_NEGATIVE: Limits = Limits {
    low: 0.0,
    high: f64::INFINITY,
    open: false,
    words: "must not be below 0",
};

pub(crate) const DIP: Limits = Limits {
    low: 0.0,
    high: 89.0,
    open: false,
    words: "must lie between 0 and 89 degrees, downwards along the azimuth",
};

pub(crate) const FRACTION: Limits = Limits {
    low: 0.0,
    high: 1.0,
    open: false,
    words: "must lie between 0 and 1",
};

impl Limits {
    pub(crate) fn too_low(&self, value: f64, reached: bool) -> bool {
        value < self.low || (self.open && reached && value == self.low)
    }

    pub(crate) fn too_high(&self, value: f64) -> bool {
        value > self.high || (self.open && value == self.high && value.is_finite())
    }

    pub(crate) fn admit(&self, value: f64) -> bool {
        !self.too_low(value, true) && !self.too_high(value)
    }
}
