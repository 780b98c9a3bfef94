//! Rock properties as volumes have them, once they are drawn: a volume is homogeneous, so each is one value.

/// The value of a rock property.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Property {
    /// One number.
    Scalar(f64),
    /// One number along each of x, y and z.
    Vector([f64; 3]),
    /// A symmetric tensor in x, y and z, by rows.
    Tensor([[f64; 3]; 3]),
}

impl Property {
    /// Its numbers: one; three along x, y and z; or the six of a tensor, xx yy zz xy yz xz.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Scalar(value) => vec![*value],
            Self::Vector(values) => values.to_vec(),
            Self::Tensor([[xx, xy, xz], [_, yy, yz], [_, _, zz]]) => {
                vec![*xx, *yy, *zz, *xy, *yz, *xz]
            }
        }
    }

    /// As it stands in reports: a number, a list of three, or a tensor's rows.
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            Self::Scalar(value) => serde_json::json!(value),
            Self::Vector(values) => serde_json::json!(values),
            Self::Tensor(rows) => serde_json::json!(rows),
        }
    }

    /// As a tensor; that of one number is the same along all axes.
    pub fn tensor(&self) -> [[f64; 3]; 3] {
        let diagonal = |[x, y, z]: [f64; 3]| [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        match self {
            Self::Scalar(value) => diagonal([*value; 3]),
            Self::Vector(values) => diagonal(*values),
            Self::Tensor(tensor) => *tensor,
        }
    }
}

/// The rock properties of one volume.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VolumeProperties {
    /// By name, in the order of the facies and then of the feature.
    pub values: Vec<(String, Property)>,
    /// What was drawn for them, by parameter.
    pub drawn: Vec<(String, f64)>,
}

impl VolumeProperties {
    /// The property of this name.
    pub fn get(&self, name: &str) -> Option<Property> {
        let mut values = self.values.iter();
        let (_, value) = values.find(|(key, _)| key == name)?;
        Some(*value)
    }

    /// The property of this name, if it is one number.
    pub fn scalar(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Property::Scalar(value) => Some(value),
            Property::Vector(_) | Property::Tensor(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Property;

    #[test]
    fn a_number_and_three_are_tensors_along_the_axes() {
        assert_eq!(
            Property::Vector([1.0, 2.0, 3.0]).tensor(),
            [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]]
        );
        assert_eq!(
            Property::Scalar(2.0).tensor(),
            Property::Vector([2.0; 3]).tensor()
        );
        let tensor = Property::Tensor([[1.0, 4.0, 6.0], [4.0, 2.0, 5.0], [6.0, 5.0, 3.0]]);
        assert_eq!(tensor.numbers(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }
}
