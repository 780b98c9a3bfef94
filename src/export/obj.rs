//! Wavefront OBJ: all parts in one file as objects, with the exact surfaces' normals, and a file of their colours beside it.
//!
//! Indices count from 1 through the whole file. Each object has points of its own, so each closes by itself.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::part::Parts;

/// The file of all parts, which takes its colours from a file of that name.
pub fn text(parts: &Parts, colors: &str) -> String {
    let mut out = format!("# {}\nmtllib {colors}\n", parts.words());
    let (mut points, mut normals) = (1, 1);
    for part in &parts.all {
        let mesh = &part.mesh;
        line(&mut out, format_args!("o {}", word(&part.name)));
        for point in &mesh.positions {
            line(
                &mut out,
                format_args!("v {} {} {}", point.x, point.y, point.z),
            );
        }
        for corner in &mesh.corners {
            let normal = corner.normal;
            line(
                &mut out,
                format_args!("vn {:.5} {:.5} {:.5}", normal.x, normal.y, normal.z),
            );
        }
        line(&mut out, format_args!("usemtl {}", word(&part.material)));
        for triangle in &mesh.triangles {
            out.push('f');
            for (corner, point) in triangle.iter().zip(part.points(*triangle)) {
                let (point, normal) = (points + u64::from(point), normals + u64::from(*corner));
                // A string takes whatever is written.
                let _ = write!(out, " {point}//{normal}");
            }
            out.push('\n');
        }
        points += mesh.positions.len() as u64;
        normals += mesh.corners.len() as u64;
    }
    out
}

/// The file of colours.
pub fn colors(parts: &Parts) -> String {
    let all: BTreeMap<&str, [u8; 3]> = parts
        .all
        .iter()
        .map(|part| (part.material.as_str(), part.color))
        .collect();
    let mut out = String::new();
    for (material, color) in all {
        let [r, g, b] = color.map(|value| f64::from(value) / 255.0);
        line(
            &mut out,
            format_args!(
                "newmtl {}\nKd {r:.4} {g:.4} {b:.4}\nKs 0 0 0\nillum 1\n",
                word(material)
            ),
        );
    }
    out
}

fn line(out: &mut String, what: std::fmt::Arguments<'_>) {
    // A string takes whatever is written.
    let _ = out.write_fmt(what);
    out.push('\n');
}

/// A name without blanks, at which readers cut it off.
fn word(name: &str) -> String {
    name.replace(char::is_whitespace, "_")
}

#[cfg(test)]
mod tests {
    use super::super::part::tests::tetrahedron;
    use super::*;
    use glam::DVec3;

    #[test]
    fn indices_go_on_from_one_object_to_the_next_and_name_points_and_normals() {
        let mut parts = tetrahedron(DVec3::new(1.5, 0.0, -2.0));
        let mut second = parts.all[0].clone();
        second.name = "other body".to_owned();
        parts.all.push(second);
        let text = text(&parts, "Test.mtl");
        assert_eq!(
            text.lines().filter(|line| line.starts_with("v ")).count(),
            8
        );
        let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
        assert_eq!(faces[0], "f 1//1 3//2 2//3");
        assert_eq!(faces[4], "f 5//13 7//14 6//15");
        assert!(text.contains("\no other_body\n") && text.contains("\nv 1.5 0 -2\n"));
        assert!(colors(&parts).starts_with("newmtl sand\nKd 0.9020 0.7608 0.3608\n"));
    }
}
