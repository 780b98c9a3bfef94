//! Kinds of rock.

/// A kind of rock, with its colour and properties.
#[derive(Clone, Debug, PartialEq)]
pub struct Facies {
    /// Its id.
    pub name: String,
    /// Its colour in pictures and files.
    pub color: Rgb,
    /// A sentence about it.
    pub description: Option<String>,
    /// Whether it counts as net (reservoir) rock; unknown if not said.
    pub net: Option<bool>,
    /// Porosity (a fraction), permeability (mD; x, y, z) and any other number, in file order.
    pub properties: Vec<(String, Property)>,
}

/// A colour of 8 bits a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
}

/// The value of a rock property.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Property {
    /// One number.
    Scalar(f64),
    /// One number for each of x, y and z.
    Vector([f64; 3]),
}
