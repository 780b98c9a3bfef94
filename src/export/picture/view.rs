//! Views in three dimensions: solids as triangles, the domain's faces coloured by owner, cut-aways.
//!
//! A **block diagram** gives [`Scene::png`] an owner function: the domain's outer faces and the faces of the cut are then
//! coloured by the owner of their points. Where the function answers `None` a face is open, so that bodies are seen
//! inside a wire box. Parts are closed or open surfaces of triangles; a cut opens them, and the owner function closes
//! the openings.

use std::collections::BTreeSet;

use glam::DVec2;

pub use super::scene::{Box3, Camera, Cut, Owner, Part, Projection, Scene};
use super::{
    PictureError, Rgb, Swatch, Volume,
    camera::Eye,
    canvas::Canvas,
    check::size,
    face::{self, Asked, OPEN},
    furniture,
    halfspace::{HalfSpace, Vertex},
    legend::Legend,
    page::{Layout, Page},
    plot::heading,
    raster,
    samples::{Drawing, Object, Skin},
    scale_bar::ScaleBar,
    solid::triangles,
};

impl Scene {
    /// The view as a PNG file. With an owner function the faces of the domain and of the cut are coloured by it.
    pub fn png(
        &self,
        width: u32,
        height: u32,
        owner: Option<Owner<'_>>,
    ) -> Result<Vec<u8>, PictureError> {
        self.check()?;
        size(width, height)?;
        let page = Page::new(width, height);
        let removed = self
            .cut
            .as_ref()
            .map_or_else(Vec::new, |cut| cut.half_spaces(&self.domain));
        let eye = Eye::new(&self.camera, &self.domain);

        // Text first: it decides how much room is left.
        let mut over = Canvas::default();
        let notes = [self.subtitle.clone(), self.note()];
        let top = heading(&mut over, &self.title, &notes, page.size.x)?;
        let strip = match page.layout {
            Layout::Column => 0.0,
            Layout::Strip => {
                let all: Vec<&Swatch> = self.legend.iter().collect();
                let legend = strip_legend(&page, &all)?;
                (legend.height + 32.0).max(108.0)
            }
        };
        let eye = eye.fitted(
            &self.domain,
            DVec2::new(MARGIN, top + 24.0),
            match page.layout {
                Layout::Column => page.size - DVec2::new(COLUMN + MARGIN, MARGIN),
                Layout::Strip => page.size - DVec2::new(MARGIN, MARGIN + strip),
            },
        );

        let (image, labels) = self.image(&page, &eye, owner, &removed)?;
        let edges = furniture::edges(&self.domain, &eye);
        let mut under = Canvas::default();
        furniture::back(&mut under, &edges, &eye, &self.domain, &removed);
        furniture::front(&mut over, &edges, &eye, &removed);
        furniture::axes(&mut over, &edges, &eye, &self.domain)?;
        self.key(
            &mut over,
            &page,
            &eye,
            &self.swatches(&labels),
            [top, strip],
        )?;
        page.compose(&under, &image, &over)
    }

    /// The same without heading, axes and legend: to be shown among many others.
    pub fn tile(
        &self,
        width: u32,
        height: u32,
        owner: Option<Owner<'_>>,
    ) -> Result<Vec<u8>, PictureError> {
        self.check()?;
        size(width, height)?;
        let page = Page::plain(width, height);
        let removed = self
            .cut
            .as_ref()
            .map_or_else(Vec::new, |cut| cut.half_spaces(&self.domain));
        let margin = DVec2::splat(TILE_MARGIN);
        let eye = Eye::new(&self.camera, &self.domain);
        let eye = eye.fitted(&self.domain, margin, page.size - margin);
        let (image, _) = self.image(&page, &eye, owner, &removed)?;
        let edges = furniture::edges(&self.domain, &eye);
        let (mut under, mut over) = (Canvas::default(), Canvas::default());
        furniture::back(&mut under, &edges, &eye, &self.domain, &removed);
        furniture::front(&mut over, &edges, &eye, &removed);
        page.compose(&under, &image, &over)
    }

    /// Parts and faces as pixels, and the owners that the faces show.
    fn image(
        &self,
        page: &Page,
        eye: &Eye,
        owner: Option<Owner<'_>>,
        removed: &[HalfSpace],
    ) -> Result<(Vec<u8>, BTreeSet<u32>), PictureError> {
        // Pictures in pixels, text in pixels of the page.
        let fine = eye.finer(page.scale);
        let asked = owner.map(|owner| Asked {
            owner,
            volumes: self.volumes.len(),
            eye: &fine,
            domain: &self.domain,
        });
        let faces = match asked {
            Some(asked) => face::faces(asked, removed)?,
            None => Vec::new(),
        };
        let mut labels: BTreeSet<u32> = faces.iter().flat_map(face::Face::labels).collect();
        labels.remove(&OPEN);
        let drawing = Drawing {
            objects: self.objects(&faces, &fine, removed),
            colors: self.volumes.iter().map(|v| self.color(v)).collect(),
            asked,
            eye: &fine,
            line: 0.5 * page.scale,
        };
        let [width, height] = page.pixels().map(|pixels| pixels as usize);
        Ok((raster::draw(&drawing, width, height)?, labels))
    }

    /// North arrow, scale bar and legend, below the heading at `top` or in the lowest `strip` pixels.
    fn key(
        &self,
        canvas: &mut Canvas,
        page: &Page,
        eye: &Eye,
        swatches: &[&Swatch],
        [top, strip]: [f64; 2],
    ) -> Result<(), PictureError> {
        // In perspective there is no one scale.
        let bar = (self.camera.projection == Projection::Orthographic)
            .then(|| ScaleBar::new(eye.scale, COLUMN - 60.0));
        match page.layout {
            Layout::Column => {
                let corner = DVec2::new(page.size.x - COLUMN - 16.0, top + 20.0);
                furniture::north_arrow(canvas, corner + DVec2::new(46.0, 50.0), eye);
                let mut legend_top = corner.y + 112.0;
                if let Some(bar) = bar {
                    let at = DVec2::new(corner.x + 6.0, legend_top);
                    bar.draw(canvas, at);
                    legend_top += 56.0;
                }
                let mut legend = Legend::column(swatches, COLUMN, 14.0)?;
                for text in [12.0, 10.0, 8.0] {
                    if legend_top + legend.height > page.size.y {
                        legend = Legend::column(swatches, COLUMN, text)?;
                    }
                }
                legend.draw(canvas, DVec2::new(corner.x, legend_top));
            }
            Layout::Strip => {
                let corner = DVec2::new(24.0, page.size.y - strip);
                furniture::north_arrow(canvas, corner + DVec2::new(46.0, 46.0), eye);
                if let Some(bar) = bar {
                    let at = corner + DVec2::new(112.0, 24.0);
                    bar.draw(canvas, at);
                }
                let legend = strip_legend(page, swatches)?;
                legend.draw(canvas, DVec2::new(STRIP_LEFT, corner.y + 20.0));
            }
        }
        Ok(())
    }

    fn color(&self, volume: &Volume) -> Rgb {
        self.legend[volume.swatch].color
    }

    /// Parts first, so that faces win only where they are nearer.
    fn objects<'a>(
        &self,
        faces: &'a [face::Face],
        eye: &Eye,
        removed: &[HalfSpace],
    ) -> Vec<Object<'a>> {
        let parts = self.parts.iter().filter(|part| part.opacity > 0.0);
        let solids = parts.map(|part| Object {
            triangles: triangles(part, eye, removed),
            skin: Skin::Plain {
                color: self.color(&self.volumes[part.volume]),
                opacity: part.opacity,
            },
        });
        let flats = faces.iter().map(|face| Object {
            triangles: face
                .pieces
                .iter()
                .flat_map(|piece| {
                    let corner = |i: usize| Vertex {
                        at: piece[i],
                        normal: face.normal,
                    };
                    (1..piece.len() - 1).map(move |i| [corner(0), corner(i), corner(i + 1)])
                })
                .collect(),
            skin: Skin::Owned(face),
        });
        solids.chain(flats).collect()
    }

    /// The swatches of what is drawn.
    fn swatches(&self, labels: &BTreeSet<u32>) -> Vec<&Swatch> {
        let mut used = vec![false; self.legend.len()];
        for part in self.parts.iter().filter(|part| part.opacity > 0.0) {
            used[self.volumes[part.volume].swatch] = true;
        }
        for &label in labels {
            used[self.volumes[label as usize].swatch] = true;
        }
        let swatches = self.legend.iter().zip(used);
        swatches
            .filter(|(_, used)| *used)
            .map(|(swatch, _)| swatch)
            .collect()
    }
}

/// Room around the domain for ticks and their numbers, in pixels of the page.
const MARGIN: f64 = 92.0;
/// Width of the column with arrow, scale and legend.
const COLUMN: f64 = 230.0;

/// Room around the domain where there is nothing else.
const TILE_MARGIN: f64 = 5.0;

/// Where the legend begins in a strip, beside arrow and scale.
const STRIP_LEFT: f64 = 360.0;

/// The legend of a strip, in text that leaves the picture at least half of the page where it can.
fn strip_legend<'a>(page: &Page, swatches: &[&'a Swatch]) -> Result<Legend<'a>, PictureError> {
    let width = page.size.x - STRIP_LEFT - 24.0;
    let mut legend = Legend::rows(swatches, width, 14.0)?;
    for text in [12.0, 10.0, 8.0] {
        if legend.height > 0.45 * page.size.y {
            legend = Legend::rows(swatches, width, text)?;
        }
    }
    Ok(legend)
}

#[cfg(test)]
mod tests;
