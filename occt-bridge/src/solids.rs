//! Solids that share their common faces: the assembled model.

use cxx::UniquePtr;

use crate::bytes::{Reader, Writer};
use crate::cells::FaceOrigin;
use crate::error::{BridgeError, from_kernel, input};
use crate::ffi::bridge;
use crate::shape::Shape;

/// Solids and the faces they share.
pub struct Solids {
    pub(crate) handle: UniquePtr<bridge::SolidsHandle>,
    bodies: Vec<Solid>,
    faces: Vec<SolidFace>,
}

/// One of [`Solids`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Solid {
    /// The owner that was given for its cells.
    pub owner: usize,
    /// Faces, shell by shell, by index into [`Solids::faces`], and whether reversed: a solid's faces look out of it.
    pub faces: Vec<(usize, bool)>,
    /// Number of shells: more than 1 where something lies wholly inside.
    pub shells: usize,
}

/// A face of [`Solids`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SolidFace {
    /// The faces of arguments that it is a piece of.
    pub origins: Vec<FaceOrigin>,
    /// The solids that it bounds: one or two.
    pub solids: Vec<usize>,
}

const MAGIC: [u8; 8] = *b"CLNSOL01";

impl Solids {
    pub(crate) fn new(
        handle: UniquePtr<bridge::SolidsHandle>,
        solids: Vec<Solid>,
        faces: Vec<SolidFace>,
    ) -> Self {
        Self {
            handle,
            bodies: solids,
            faces,
        }
    }

    /// The solids.
    pub fn solids(&self) -> &[Solid] {
        &self.bodies
    }

    /// The faces of all solids, each once.
    pub fn faces(&self) -> &[SolidFace] {
        &self.faces
    }

    /// Renames the arguments that faces come from.
    pub fn rename_arguments(&mut self, name: impl Fn(usize) -> usize) {
        let origins = self.faces.iter_mut().flat_map(|face| &mut face.origins);
        for origin in origins {
            origin.argument = name(origin.argument);
        }
    }

    /// Solid `index` as a shape.
    pub fn shape_of(&self, index: usize) -> Result<Shape, BridgeError> {
        bridge::solid_of(&self.handle, index)
            .map(Shape::new)
            .map_err(|e| from_kernel("taking a solid", &e))
    }

    /// Face `index` as a shape, not reversed.
    pub fn face_shape(&self, index: usize) -> Result<Shape, BridgeError> {
        bridge::face_of(&self.handle, index)
            .map(Shape::new)
            .map_err(|e| from_kernel("taking a face", &e))
    }

    /// All solids in one shape that keeps common faces common.
    pub fn compound(&self) -> Result<Shape, BridgeError> {
        bridge::compound_of_solids(&self.handle)
            .map(Shape::new)
            .map_err(|e| from_kernel("taking all solids", &e))
    }

    /// The number of edges, each counted once.
    pub fn edge_count(&self) -> Result<usize, BridgeError> {
        bridge::edges_of(&self.handle).map_err(|e| from_kernel("counting edges", &e))
    }

    /// Everything as bytes, exactly, for another process of the same build.
    pub fn to_bytes(&self) -> Result<Vec<u8>, BridgeError> {
        let shape = bridge::solids_to_bytes(&self.handle)
            .map_err(|e| from_kernel("writing solids to bytes", &e))?;
        let mut out = Writer::new(MAGIC);
        out.number(self.bodies.len());
        for solid in &self.bodies {
            out.number(solid.owner);
            out.number(solid.shells);
            out.number(solid.faces.len());
            for (face, reversed) in &solid.faces {
                out.number(2 * face + usize::from(*reversed));
            }
        }
        out.number(self.faces.len());
        for face in &self.faces {
            out.number(face.origins.len());
            for origin in &face.origins {
                out.number(origin.argument);
                out.number(2 * origin.face + usize::from(origin.same_orientation));
            }
            out.number(face.solids.len());
            for solid in &face.solids {
                out.number(*solid);
            }
        }
        out.block(&shape);
        Ok(out.finish())
    }

    /// Reads what [`Self::to_bytes`] wrote.
    ///
    /// # Errors
    /// [`BridgeError::Input`] if the bytes are not, or not all of, what it wrote.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, BridgeError> {
        let operation = "reading solids from bytes";
        let (solids, faces, block) =
            read_tables(bytes).map_err(|message| input(operation, message))?;
        let handle = bridge::solids_from_bytes(block).map_err(|e| from_kernel(operation, &e))?;
        Ok(Self::new(handle, solids, faces))
    }
}

type Tables<'a> = (Vec<Solid>, Vec<SolidFace>, &'a [u8]);

fn read_tables(bytes: &[u8]) -> Result<Tables<'_>, String> {
    let mut from = Reader::new(bytes, MAGIC)?;
    let mut solids = Vec::new();
    for _ in 0..from.count()? {
        let owner = from.number()?;
        let shells = from.number()?;
        let mut faces = Vec::new();
        for _ in 0..from.count()? {
            let code = from.number()?;
            faces.push((code / 2, code % 2 == 1));
        }
        solids.push(Solid {
            owner,
            faces,
            shells,
        });
    }
    let mut faces = Vec::new();
    for _ in 0..from.count()? {
        let mut origins = Vec::new();
        for _ in 0..from.count()? {
            let argument = from.number()?;
            let code = from.number()?;
            origins.push(FaceOrigin {
                argument,
                face: code / 2,
                same_orientation: code % 2 == 1,
            });
        }
        let mut users = Vec::new();
        for _ in 0..from.count()? {
            users.push(from.number()?);
        }
        faces.push(SolidFace {
            origins,
            solids: users,
        });
    }
    let block = from.block()?;
    let sound = solids
        .iter()
        .all(|s| s.faces.iter().all(|(f, _)| *f < faces.len()))
        && faces
            .iter()
            .all(|f| f.solids.iter().all(|s| *s < solids.len()));
    if !sound {
        return Err("the tables refer to faces or solids that are not there".to_owned());
    }
    Ok((solids, faces, block))
}

impl std::fmt::Debug for Solids {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solids")
            .field("solids", &self.bodies)
            .field("faces", &self.faces)
            .finish_non_exhaustive()
    }
}
