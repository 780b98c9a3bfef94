//! What pictures of a model have in common: volumes, legend, output files.

use std::path::Path;

use super::failure::Failure;
use super::files;
use super::load::Loaded;
use crate::export::picture::{PictureError, Rgb, Swatch, Volume};

/// The legend's facies, those first that volumes have, and the volumes.
pub(super) fn key(loaded: &Loaded) -> (Vec<Volume>, Vec<Swatch>) {
    let mut legend: Vec<Swatch> = Vec::new();
    let mut volumes = Vec::new();
    for rules in &loaded.realisation.volumes {
        let swatch = legend
            .iter()
            .position(|swatch| swatch.name == rules.facies)
            .unwrap_or_else(|| {
                let facies = loaded
                    .model
                    .facies
                    .iter()
                    .find(|facies| facies.name == rules.facies);
                let color = facies.map_or(Rgb(128, 128, 128), |facies| {
                    Rgb(facies.color.r, facies.color.g, facies.color.b)
                });
                legend.push(Swatch {
                    name: rules.facies.clone(),
                    color,
                });
                legend.len() - 1
            });
        volumes.push(Volume {
            name: rules.name.clone(),
            swatch,
        });
    }
    (volumes, legend)
}

/// Whether a file's name asks for SVG; anything but `.svg` and `.png` is refused.
pub(super) fn is_svg(path: &Path) -> Result<bool, Failure> {
    let ending = path
        .extension()
        .map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("svg") => Ok(true),
        Some("png") => Ok(false),
        _ => Err(Failure::Wrong(format!(
            "{}: a picture's name ends in .png or .svg",
            path.display()
        ))),
    }
}

/// A picture that cannot be drawn with these arguments.
pub(super) fn refused(error: &PictureError) -> Failure {
    Failure::Wrong(format!("the picture cannot be drawn: {error}"))
}

/// Writes a picture and says so.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    files::write(path, bytes)?;
    super::print::out(&format!("wrote {}", path.display()))
}
