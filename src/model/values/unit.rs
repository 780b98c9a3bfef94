//! Units of length of data: metres, and two feet.

use crate::model::checker::Checker;
use crate::model::read::Field;
use crate::model::tree::quoted;

/// What units are in metres: the foot is 0.3048 m exactly, that of old American surveys 1200/3937 m.
pub(crate) const UNITS: [(&str, f64); 3] = [("m", 1.0), ("ft", 0.3048), ("us-ft", 1200.0 / 3937.0)];

impl Checker<'_> {
    /// A unit in metres.
    pub(crate) fn unit(&self, field: Option<Field<String>>) -> f64 {
        let Some((node, word)) = field.and_then(Field::good) else {
            return 1.0;
        };
        let known = UNITS.iter().find(|(name, _)| *name == word);
        if known.is_none() {
            self.reader.wrong(
                node,
                format!("there is no unit {}", quoted(&word)),
                "write \"m\", \"ft\" (0.3048 m) or \"us-ft\" (1200/3937 m)",
            );
        }
        known.map_or(1.0, |(_, metres)| *metres)
    }
}
