//! Solids from files of CAD programs, read by the kernel.

use super::boundary::tables;
use super::kernel::{self, BodyError, BodyFormat, BoundaryShape};
use crate::features::imported::Original;
use crate::model::solids::{ReadSolid, SolidError, SolidFormat};

/// What to do about a file that holds no closed body.
const CLOSE: &str = "make one closed solid of it in the program that it comes from (sew its faces, fill its holes), and export that";

/// Reads the one solid that a file holds: what [`Source::with_solids`](crate::model::Source::with_solids) asks for.
pub fn read_solid(bytes: &[u8], format: SolidFormat) -> Result<ReadSolid, SolidError> {
    let format = match format {
        SolidFormat::Step => BodyFormat::Step,
        SolidFormat::Brep { unit } => BodyFormat::Brep { unit },
    };
    let body = kernel::read_body(bytes, format).map_err(|error| refused(&error))?;
    let failed = |reason: String| SolidError {
        reason,
        remedy: "export it in another way: from its own program, or as BREP in the place of STEP"
            .to_owned(),
    };
    let of_kernel = |error: kernel::BridgeError| failed(error.to_string());
    let boundary = kernel::boundary(std::slice::from_ref(&body.shape)).map_err(of_kernel)?;
    let faces = match &boundary.shapes[..] {
        [BoundaryShape::Solid(shells)] => shells.concat(),
        _ => return Err(failed("the kernel finds no solid in it".to_owned())),
    };
    let kernel = body.shape.to_bytes().map_err(of_kernel)?;
    let tables = tables(&boundary).map_err(failed)?;
    let original =
        Original::new(tables, &faces, body.tolerance, (kernel, body.volume)).map_err(|error| {
            SolidError {
                reason: error.to_string(),
                remedy: CLOSE.to_owned(),
            }
        })?;
    Ok(ReadSolid {
        original,
        unit: body.unit,
    })
}

fn refused(error: &BodyError) -> SolidError {
    let remedy = match error {
        BodyError::Unreadable(_) => "export it again; it may have been cut off",
        BodyError::Empty(_) => {
            "export the solid itself, not a sketch, a part of an assembly that is hidden, or an empty file"
        }
        BodyError::Several(_) => {
            "export one solid a file, and give each a feature of its own; or make one of them where they touch"
        }
        BodyError::Open(_) => CLOSE,
        BodyError::Invalid(_) => {
            "repair it in the program that it comes from, or export it in another way, for example with splines in the place of surfaces of revolution"
        }
        BodyError::Kernel(_) => {
            "export it in another way: from its own program, or as BREP in the place of STEP"
        }
    };
    SolidError {
        reason: error.to_string(),
        remedy: remedy.to_owned(),
    }
}
