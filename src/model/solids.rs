//! Solids from files of CAD programs: what the model asks of whoever can read them. That is the CAD kernel, which nothing here
//! knows; a [`Source`](super::Source) is given a reader.

use crate::features::imported::Original;

/// How a file of a solid is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolidFormat {
    /// STEP, which says its unit.
    Step,
    /// OpenCASCADE's BREP, of whose numbers one is so many metres.
    Brep {
        /// Metres.
        unit: f64,
    },
}

/// A solid that was read, in metres.
#[derive(Debug)]
pub struct ReadSolid {
    /// The solid.
    pub original: Original,
    /// The unit that the file says, in its own words.
    pub unit: Option<String>,
}

/// Why a file holds no solid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct SolidError {
    /// What is wrong with it.
    pub reason: String,
    /// What to do about it.
    pub remedy: String,
}

/// Reads a solid from what a file holds.
pub type SolidReader = fn(&[u8], SolidFormat) -> Result<ReadSolid, SolidError>;

/// How a file is written, as its first bytes say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Written {
    Step,
    Brep,
}

impl Written {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Step => "STEP",
            Self::Brep => "BREP",
        }
    }

    /// What a file is, or what it is not and what to do about it.
    pub(crate) fn of(bytes: &[u8]) -> Result<Self, (String, &'static str)> {
        const LOOKED_AT: usize = 400;
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(LOOKED_AT)]);
        let start = start.trim_start_matches('\u{feff}').trim_start();
        if start.starts_with("ISO-10303-21") {
            return Ok(Self::Step);
        }
        if start.starts_with("DBRep_DrawableShape") || start.starts_with("CASCADE Topology") {
            return Ok(Self::Brep);
        }
        if start.is_empty() {
            return Err((
                "the file is empty".to_owned(),
                "export the solid again as STEP",
            ));
        }
        let upper = start.to_ascii_uppercase();
        if upper.starts_with("SOLID") || upper.starts_with("# BLENDER") || upper.starts_with("PLY")
        {
            return Err((
                "this is a mesh of triangles, no solid".to_owned(),
                "export the solid that it was made of, as STEP",
            ));
        }
        let first: String = start
            .lines()
            .next()
            .unwrap_or_default()
            .chars()
            .take(40)
            .collect();
        Err((
            format!("it begins with {first:?}, which is neither STEP nor BREP"),
            "export the solid as STEP, or as OpenCASCADE's BREP (text)",
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_is_says_its_first_line() {
        assert_eq!(Written::of(b"\n ISO-10303-21;\nHEADER;"), Ok(Written::Step));
        assert_eq!(
            Written::of(b"\nCASCADE Topology V1, (c) Matra-Datavision"),
            Ok(Written::Brep)
        );
        assert_eq!(
            Written::of(b"DBRep_DrawableShape\n\nCASCADE"),
            Ok(Written::Brep)
        );
        let told = |bytes: &[u8]| Written::of(bytes).map_err(|(reason, _)| reason);
        assert_eq!(told(b"  \n"), Err("the file is empty".to_owned()));
        assert_eq!(
            told(b"solid dome\nfacet normal 0 0 1"),
            Err("this is a mesh of triangles, no solid".to_owned())
        );
        assert_eq!(
            told(b"x,y,z\n1,2,3\n"),
            Err("it begins with \"x,y,z\", which is neither STEP nor BREP".to_owned())
        );
    }
}
