//! Kinds of rock.

use super::values::property::PropertySpec;

/// A kind of rock, with its colour and properties.
#[derive(Clone, Debug, PartialEq)]
pub struct Facies {
    /// Its id.
    pub name: String,
    /// What it is called where people read; its id if absent.
    pub title: Option<String>,
    /// Its colour in pictures and files.
    pub color: Rgb,
    /// A sentence about it.
    pub description: Option<String>,
    /// Its rock properties, in file order: which are drawn for each volume of it.
    pub properties: Vec<(String, PropertySpec)>,
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
