//! glTF, binary (`.glb`): a node with a mesh for each part, named and coloured.
//!
//! glTF looks along −z with y up, so a node above all turns the model and, if asked, stretches elevations. Positions have single
//! precision; of a model far from its origin they are counted from a round point, which stands in that node's translation.
//! Points are there once for each face that they belong to, with the exact surface's normal.
//! Our own writer: what it says is a page of JSON and a buffer, and `gltf-json` would add types for all the rest of the standard.

use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use super::part::{Part, Parts};
use super::stl::single;

const MAGIC: u32 = 0x4654_6C67;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;
const ARRAY: u32 = 34962;
const ELEMENTS: u32 = 34963;
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;

/// Why there is no file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the triangles need {0} bytes, and a .glb file holds 4 294 967 295 at most; take a larger chord tolerance"
)]
pub struct TooLarge(usize);

/// The file of all parts, with elevations stretched so many times.
pub fn bytes(parts: &Parts, exaggeration: f64) -> Result<Vec<u8>, TooLarge> {
    let base = parts.base();
    let mut file = File::default();
    let children: Vec<usize> = (1..=parts.all.len()).collect();
    let mut nodes = vec![json!({
        "name": parts.name,
        "children": children,
        "matrix": upright(base, exaggeration),
        "extras": { "metres": true, "vertical_exaggeration": exaggeration },
    })];
    let mut meshes = Vec::new();
    for part in &parts.all {
        nodes.push(json!({ "name": part.label, "mesh": meshes.len() }));
        meshes.push(file.mesh(part, base));
    }
    let content = json!({
        "asset": { "version": "2.0", "generator": parts.words() },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": file.materials,
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{ "byteLength": file.buffer.len() }],
    });
    chunks(content.to_string().into_bytes(), file.buffer)
}

/// Both chunks, padded to multiples of four bytes, behind the header.
fn chunks(mut text: Vec<u8>, mut buffer: Vec<u8>) -> Result<Vec<u8>, TooLarge> {
    text.resize(text.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let total = 12 + 8 + text.len() + 8 + buffer.len();
    let length = |bytes: usize| u32::try_from(bytes).map_err(|_| TooLarge(total));
    let mut out = Vec::with_capacity(total);
    for number in [MAGIC, 2, length(total)?, length(text.len())?, JSON_CHUNK] {
        out.extend(number.to_le_bytes());
    }
    out.extend(text);
    for number in [length(buffer.len())?, BINARY_CHUNK] {
        out.extend(number.to_le_bytes());
    }
    out.extend(buffer);
    Ok(out)
}

/// Columns of the matrix that takes (x, y, z) from a point to (x, s z, −y).
fn upright(base: DVec3, s: f64) -> [f64; 16] {
    let [x, y, z] = base.to_array();
    [
        1.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        -1.0,
        0.0,
        0.0,
        s,
        0.0,
        0.0,
        x,
        s * z + 0.0,
        0.0 - y,
        1.0,
    ]
}

#[derive(Default)]
struct File {
    buffer: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    /// Name and colour of each material.
    known: Vec<(String, [u8; 3])>,
}

impl File {
    fn mesh(&mut self, part: &Part, base: DVec3) -> Value {
        let corners = &part.mesh.corners;
        let place = |point: u32| single(part.mesh.positions[point as usize] - base);
        let places: Vec<Vec3> = corners.iter().map(|corner| place(corner.point)).collect();
        let low = places.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = places.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let positions = self.vectors(places.into_iter());
        self.accessors[positions]["min"] = json!(low.to_array());
        self.accessors[positions]["max"] = json!(high.to_array());
        let normals = self.vectors(
            corners
                .iter()
                .map(|corner| single(corner.normal).normalize_or(Vec3::Z)),
        );
        let from = self.buffer.len();
        for corner in part.mesh.triangles.as_flattened() {
            self.buffer.extend(corner.to_le_bytes());
        }
        let indices = self.accessor(
            from,
            ELEMENTS,
            UNSIGNED,
            "SCALAR",
            3 * part.mesh.triangles.len(),
        );
        json!({
            "name": part.label,
            "primitives": [{
                "attributes": { "POSITION": positions, "NORMAL": normals },
                "indices": indices,
                "material": self.material(part),
            }],
        })
    }

    fn vectors(&mut self, vectors: impl ExactSizeIterator<Item = Vec3>) -> usize {
        let (from, count) = (self.buffer.len(), vectors.len());
        for number in vectors.flat_map(|vector| vector.to_array()) {
            self.buffer.extend(number.to_le_bytes());
        }
        self.accessor(from, ARRAY, FLOAT, "VEC3", count)
    }

    /// What the buffer holds from a place on.
    fn accessor(
        &mut self,
        from: usize,
        target: u32,
        component: u32,
        kind: &str,
        count: usize,
    ) -> usize {
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": from,
            "byteLength": self.buffer.len() - from,
            "target": target,
        }));
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": component,
            "type": kind,
            "count": count,
        }));
        self.accessors.len() - 1
    }

    fn material(&mut self, part: &Part) -> usize {
        let own = (part.material.clone(), part.color);
        if let Some(known) = self.known.iter().position(|known| *known == own) {
            return known;
        }
        let [r, g, b] = part.color.map(linear);
        self.materials.push(json!({
            "name": part.material,
            "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.9,
            },
        }));
        self.known.push(own);
        self.known.len() - 1
    }
}

/// A value of sRGB (IEC 61966-2-1) as light.
fn linear(value: u8) -> f64 {
    let share = f64::from(value) / 255.0;
    if share <= 0.040_45 {
        share / 12.92
    } else {
        ((share + 0.055) / 1.055).powf(2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_goes_into_the_picture_and_up_is_up_however_stretched() {
        let base = DVec3::new(1000.0, 2000.0, -30.0);
        let matrix = upright(base, 5.0);
        let apply = |p: [f64; 3]| {
            let row =
                |r: usize| (0..3).map(|c| matrix[4 * c + r] * p[c]).sum::<f64>() + matrix[12 + r];
            [row(0), row(1), row(2)]
        };
        // The model's (1001, 2002, -27) is (1, 2, 3) from the base.
        assert_eq!(apply([1.0, 2.0, 3.0]), [1001.0, -135.0, -2002.0]);
    }

    #[test]
    fn half_of_srgb_is_a_fifth_of_the_light() {
        assert!((linear(128) - 0.2158).abs() < 1e-4);
        assert_eq!([linear(0), linear(255)], [0.0, 1.0]);
    }
}
