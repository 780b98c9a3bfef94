//! Views in three dimensions: solids as triangles, the domain's faces coloured by owner, cut-aways.
//!
//! A **block diagram** gives [`Scene::png`] an owner function: the domain's outer faces and the faces of the cut are then
//! coloured by the owner of their points. Where the function answers `None` a face is open, so that bodies are seen
//! inside a wire box. Parts are closed or open surfaces of triangles; a cut opens them, and the owner function closes
//! the openings.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use super::{
    PictureError, Rgb, Swatch, Volume, byte,
    camera::Eye,
    canvas::Canvas,
    check::size,
    face::{self, Asked, OPEN},
    furniture,
    legend::Legend,
    page::{Layout, Page},
    plot::heading,
    raster::{self, Drawing, Object, Skin},
    scale_bar::ScaleBar,
    solid::{HalfSpace, Vertex, removed, triangles},
};

/// Who owns a point: an index into [`Scene::volumes`], or `None` where nothing shall be shown. Asked from several
/// threads.
pub type Owner<'a> = &'a (dyn Fn(DVec3) -> Option<u32> + Sync);

/// A box along the axes, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Box3 {
    /// Least easting, northing and elevation.
    pub low: DVec3,
    /// Greatest easting, northing and elevation.
    pub high: DVec3,
}

impl Box3 {
    pub(super) fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.low.x } else { self.high.x },
                if i & 2 == 0 { self.low.y } else { self.high.y },
                if i & 4 == 0 { self.low.z } else { self.high.z },
            )
        })
    }

    pub(super) fn sides(&self) -> [HalfSpace; 6] {
        let side = |normal: DVec3, point: DVec3| HalfSpace {
            normal,
            offset: normal.dot(point),
        };
        [
            side(-DVec3::X, self.low),
            side(DVec3::X, self.high),
            side(-DVec3::Y, self.low),
            side(DVec3::Y, self.high),
            side(-DVec3::Z, self.low),
            side(DVec3::Z, self.high),
        ]
    }
}

/// A surface of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Which of [`Scene::volumes`] it shows: an index, for its name and colour.
    pub volume: usize,
    /// Points.
    pub positions: Vec<DVec3>,
    /// Normals at the points; without them they are made from the triangles, smooth up to angles of 40°.
    pub normals: Option<Vec<DVec3>>,
    /// Three points each, counter-clockwise as seen from outside (this matters only for triangles that lie exactly in
    /// the plane of a cut).
    pub triangles: Vec<[u32; 3]>,
    /// From 0 (not drawn) to 1 (hides what is behind).
    pub opacity: f64,
}

/// How depth is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Parallel lines stay parallel: lengths can be compared.
    Orthographic,
    /// What is farther away is smaller; the viewer is this many diagonals of the (exaggerated) domain from its middle.
    Perspective {
        /// In diagonals of the domain, 1.5 to 100; 3 is mild.
        distance: f64,
    },
}

/// Where the view is taken from; it always looks at the middle of the domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Bearing of the viewer from the domain's middle, degrees clockwise from north: 180 looks at the model from the
    /// south, with north behind.
    pub azimuth_deg: f64,
    /// Height of the viewer above the horizon in degrees, −90 (straight from below) to 90 (a map).
    pub elevation_deg: f64,
    /// How many times elevations are stretched against distances.
    pub vertical_exaggeration: f64,
    /// Orthographic or perspective.
    pub projection: Projection,
}

impl Camera {
    /// From the south-south-west, 28° above the horizon, orthographic.
    pub const fn from_above(vertical_exaggeration: f64) -> Self {
        Self {
            azimuth_deg: 212.0,
            elevation_deg: 28.0,
            vertical_exaggeration,
            projection: Projection::Orthographic,
        }
    }

    /// The same from 28° below the horizon.
    pub const fn from_below(vertical_exaggeration: f64) -> Self {
        Self {
            elevation_deg: -28.0,
            ..Self::from_above(vertical_exaggeration)
        }
    }
}

/// What is cut away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cut {
    /// All on one side of a plane.
    Plane {
        /// A point of the plane.
        point: DVec3,
        /// Points from the plane to the side that is taken away.
        removes: DVec3,
    },
    /// All inside a box, such as the corner of the domain nearest to the viewer.
    Corner {
        /// Least coordinates of the box; at or beyond the domain's for none of its sides there.
        low: DVec3,
        /// Greatest coordinates of the box.
        high: DVec3,
    },
}

/// A view to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The first line, bold.
    pub title: String,
    /// A line below it; empty for none. The viewpoint and the exaggeration are added by the view.
    pub subtitle: String,
    /// The model's domain, drawn as a wire box with axes.
    pub domain: Box3,
    /// Surfaces to be drawn.
    pub parts: Vec<Part>,
    /// What parts and the owner function refer to.
    pub volumes: Vec<Volume>,
    /// Facies and their colours; the legend shows those that are drawn, in this order. It has room for about fifty.
    pub legend: Vec<Swatch>,
    /// The viewpoint.
    pub camera: Camera,
    /// What is cut away.
    pub cut: Option<Cut>,
}

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
            .map_or_else(Vec::new, |cut| removed(cut, &self.domain));
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

        // Pictures in pixels, text in pixels of the page.
        let fine = eye.finer(page.scale);
        let asked = owner.map(|owner| Asked {
            owner,
            volumes: self.volumes.len(),
            eye: &fine,
            domain: &self.domain,
        });
        let faces = match asked {
            Some(asked) => face::faces(asked, &removed)?,
            None => Vec::new(),
        };
        let mut labels: BTreeSet<u32> = faces.iter().flat_map(face::Face::labels).collect();
        labels.remove(&OPEN);
        let drawing = Drawing {
            objects: self.objects(&faces, &fine, &removed),
            colors: self.volumes.iter().map(|v| self.color(v)).collect(),
            asked,
            eye: &fine,
            line: 0.5 * page.scale,
        };
        let image = raster::draw(&drawing, width as usize, height as usize)?;

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

    /// Viewpoint and exaggeration in words.
    fn note(&self) -> String {
        const WINDS: [&str; 16] = [
            "N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW",
            "NW", "NNW",
        ];
        let Camera {
            azimuth_deg,
            elevation_deg,
            vertical_exaggeration,
            ..
        } = self.camera;
        let sixteenth = byte(azimuth_deg.rem_euclid(360.0) / 22.5);
        let from = WINDS[usize::from(sixteenth) % 16];
        let height = elevation_deg.abs().round();
        let viewpoint = if height >= 90.0 {
            let side = if elevation_deg > 0.0 {
                "above"
            } else {
                "below"
            };
            format!("seen straight from {side}")
        } else {
            let side = if elevation_deg >= 0.0 {
                "above"
            } else {
                "below"
            };
            format!("seen from the {from}, {height}° {side} the horizon")
        };
        if height >= 90.0 && self.camera.projection == Projection::Orthographic {
            viewpoint
        } else if vertical_exaggeration == 1.0 {
            format!("{viewpoint} · no vertical exaggeration")
        } else {
            format!("{viewpoint} · vertical exaggeration {vertical_exaggeration}×")
        }
    }
}

/// Room around the domain for ticks and their numbers, in pixels of the page.
const MARGIN: f64 = 92.0;
/// Width of the column with arrow, scale and legend.
const COLUMN: f64 = 230.0;

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
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
    use super::*;
    use resvg::tiny_skia::Pixmap;

    const GREY_MUD: Rgb = Rgb(0x50, 0x90, 0x50);
    const SAND: Rgb = Rgb(0xe0, 0x40, 0x30);
    const COAL: Rgb = Rgb(0x30, 0x40, 0xe0);
    const PALETTE: [Rgb; 3] = [GREY_MUD, SAND, COAL];

    fn camera(azimuth_deg: f64, elevation_deg: f64) -> Camera {
        Camera {
            azimuth_deg,
            elevation_deg,
            vertical_exaggeration: 1.0,
            projection: Projection::Orthographic,
        }
    }

    fn scene(camera: Camera, parts: Vec<Part>) -> Scene {
        let names = ["mud", "sand", "coal"];
        Scene {
            title: "Test".to_owned(),
            subtitle: String::new(),
            domain: Box3 {
                low: DVec3::ZERO,
                high: DVec3::splat(100.0),
            },
            parts,
            volumes: (0..3)
                .map(|swatch| Volume {
                    name: names[swatch].to_owned(),
                    swatch,
                })
                .collect(),
            legend: names
                .iter()
                .zip(PALETTE)
                .map(|(name, color)| Swatch {
                    name: (*name).to_owned(),
                    color,
                })
                .collect(),
            camera,
            cut: None,
        }
    }

    fn solid_box(volume: usize, low: [f64; 3], high: [f64; 3]) -> Part {
        let bounds = Box3 {
            low: DVec3::from(low),
            high: DVec3::from(high),
        };
        Part {
            volume,
            positions: bounds.corners().to_vec(),
            normals: None,
            triangles: vec![
                [0, 4, 2],
                [2, 4, 6],
                [1, 3, 5],
                [3, 7, 5],
                [0, 1, 4],
                [1, 5, 4],
                [2, 6, 3],
                [3, 6, 7],
                [0, 2, 1],
                [1, 2, 3],
                [4, 5, 6],
                [5, 7, 6],
            ],
            opacity: 1.0,
        }
    }

    /// The picture without its column: which colour of the palette each pixel has, whatever the light.
    struct Picture {
        width: usize,
        hues: Vec<Option<usize>>,
        low: [usize; 2],
        high: [usize; 2],
    }

    impl Picture {
        fn of(scene: &Scene, owner: Option<Owner<'_>>) -> Self {
            let pixels = Pixmap::decode_png(&scene.png(650, 350, owner).unwrap()).unwrap();
            let width = 520;
            let hues: Vec<Option<usize>> = (0..350)
                .flat_map(|y| (0..width).map(move |x| (x, y)))
                .map(|(x, y)| {
                    let pixel = pixels.pixel(x, y).unwrap();
                    let seen = [pixel.red(), pixel.green(), pixel.blue()].map(f64::from);
                    let colorful = seen.iter().copied().fold(0.0, f64::max)
                        - seen.iter().copied().fold(255.0, f64::min);
                    PALETTE.iter().position(|c| {
                        let own = [c.0, c.1, c.2].map(f64::from);
                        let dot =
                            |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
                        colorful > 25.0
                            && dot(seen, own) / (dot(seen, seen) * dot(own, own)).sqrt() > 0.98
                    })
                })
                .collect();
            let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
            for (i, hue) in hues.iter().enumerate() {
                if hue.is_some() {
                    for (axis, at) in [i % width as usize, i / width as usize]
                        .into_iter()
                        .enumerate()
                    {
                        low[axis] = low[axis].min(at);
                        high[axis] = high[axis].max(at);
                    }
                }
            }
            Self {
                width: width as usize,
                hues,
                low,
                high,
            }
        }

        /// At fractions of what is coloured, from the left and from the top.
        fn at(&self, x: f64, y: f64) -> Option<usize> {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "inside"
            )]
            let [column, row] = [(0, x), (1, y)].map(|(axis, f): (usize, f64)| {
                self.low[axis] + (f * (self.high[axis] - self.low[axis]) as f64).round() as usize
            });
            self.hues[row * self.width + column]
        }

        fn count(&self, hue: usize) -> f64 {
            self.hues.iter().filter(|seen| **seen == Some(hue)).count() as f64
        }
    }

    #[test]
    fn the_south_side_shows_the_owners_as_a_section_does() {
        // Sand in the west, coal on top in the east.
        let owner = |p: DVec3| {
            Some(if p.x < 40.0 {
                1
            } else {
                2 * u32::from(p.z > 70.0)
            })
        };
        let picture = Picture::of(&scene(camera(180.0, 0.0), vec![]), Some(&owner));
        assert_eq!(picture.at(0.2, 0.5), Some(1), "west is left");
        assert_eq!(picture.at(0.8, 0.5), Some(0));
        assert_eq!(picture.at(0.8, 0.1), Some(2), "up is up");
        assert_eq!(picture.at(0.37, 0.9), Some(1));
        assert_eq!(picture.at(0.43, 0.9), Some(0));
        let from_north = Picture::of(&scene(camera(0.0, 0.0), vec![]), Some(&owner));
        assert_eq!(from_north.at(0.8, 0.5), Some(1), "west is right");
    }

    #[test]
    fn maps_have_north_up_and_views_from_below_are_mirrored() {
        let owner = |p: DVec3| Some(u32::from(p.x > 50.0 && p.y > 50.0));
        let above = Picture::of(&scene(camera(180.0, 90.0), vec![]), Some(&owner));
        let quarters = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)];
        let seen = |picture: &Picture| quarters.map(|(x, y)| picture.at(x, y).unwrap());
        assert_eq!(seen(&above), [0, 1, 0, 0], "north-east is upper right");
        let below = Picture::of(&scene(camera(180.0, -90.0), vec![]), Some(&owner));
        assert_eq!(seen(&below), [0, 0, 0, 1]);
    }

    #[test]
    fn nearer_bodies_hide_farther_ones() {
        let parts = vec![
            solid_box(1, [20.0, 10.0, 10.0], [80.0, 30.0, 90.0]),
            solid_box(2, [20.0, 60.0, 10.0], [80.0, 80.0, 90.0]),
        ];
        for (azimuth, nearer) in [(180.0, 1), (0.0, 2)] {
            let picture = Picture::of(&scene(camera(azimuth, 0.0), parts.clone()), None);
            assert_eq!(picture.at(0.5, 0.5), Some(nearer));
            assert_eq!(picture.count(3 - nearer), 0.0);
        }
        // From the west the northern one is left and the southern one right.
        let picture = Picture::of(&scene(camera(270.0, 0.0), parts), None);
        assert_eq!(picture.at(0.1, 0.5), Some(2));
        assert_eq!(picture.at(0.9, 0.5), Some(1));
    }

    #[test]
    fn a_plane_cuts_away_exactly_its_side_of_faces_and_bodies() {
        let whole = |p: DVec3| Some(u32::from(p.z > 1000.0));
        let body = solid_box(1, [0.0, 0.0, 0.0], [100.0, 100.0, 100.0]);
        for (removes, left, right) in [(DVec3::X, true, false), (-DVec3::X, false, true)] {
            let mut faces = scene(camera(180.0, 0.0), vec![]);
            let full = Picture::of(&faces, Some(&whole)).count(0);
            let cut = Some(Cut::Plane {
                point: DVec3::new(60.0, 0.0, 0.0),
                removes: removes * 7.0,
            });
            faces.cut = cut;
            let picture = Picture::of(&faces, Some(&whole));
            let kept = if left { 0.6 } else { 0.4 };
            assert!((picture.count(0) / full - kept).abs() < 0.02);
            let mut solid = scene(camera(180.0, 0.0), vec![body.clone()]);
            solid.cut = cut;
            let open = Picture::of(&solid, None);
            assert!((open.count(1) / full - kept).abs() < 0.02);
            // The wire box keeps its place, so columns can be compared.
            let middle = usize::midpoint(picture.low[0], picture.high[0]);
            assert_eq!(left, middle < 220, "{middle}");
            assert_eq!(right, middle > 220);
        }
    }

    #[test]
    fn a_corner_cut_away_leaves_three_quarters_of_the_map_and_shows_what_lies_below() {
        // Sand fills the lower half.
        let owner = |p: DVec3| Some(u32::from(p.z < 50.0));
        let mut block = scene(camera(180.0, 90.0), vec![]);
        let full = Picture::of(&block, Some(&owner)).count(0);
        block.cut = Some(Cut::Corner {
            low: DVec3::new(50.0, 50.0, 30.0),
            high: DVec3::splat(200.0),
        });
        let picture = Picture::of(&block, Some(&owner));
        assert!((picture.count(0) / full - 0.75).abs() < 0.02);
        assert!((picture.count(1) / full - 0.25).abs() < 0.02);
        assert_eq!(picture.at(0.75, 0.25), Some(1), "the north-east");
    }

    #[test]
    fn open_faces_let_bodies_be_seen() {
        let owner = |p: DVec3| (p.x > 50.0).then_some(0);
        let body = solid_box(1, [10.0, 10.0, 10.0], [90.0, 90.0, 90.0]);
        let picture = Picture::of(&scene(camera(180.0, 0.0), vec![body]), Some(&owner));
        assert_eq!(picture.at(0.2, 0.5), Some(1));
        assert_eq!(picture.at(0.9, 0.5), Some(0));
    }

    #[test]
    fn glass_lets_half_of_what_is_behind_through() {
        let mut front = solid_box(2, [0.0, 0.0, 0.0], [100.0, 10.0, 100.0]);
        let back = solid_box(1, [0.0, 50.0, 0.0], [100.0, 90.0, 100.0]);
        let middle = |parts: Vec<Part>| {
            let png = scene(camera(180.0, 0.0), parts)
                .png(650, 350, None)
                .unwrap();
            let pixels = Pixmap::decode_png(&png).unwrap();
            let pixel = pixels.pixel(225, 150).unwrap();
            [pixel.red(), pixel.green(), pixel.blue()].map(f64::from)
        };
        let (blue, red) = (middle(vec![front.clone()]), middle(vec![back.clone()]));
        front.opacity = 0.5;
        let both = middle(vec![front, back]);
        for i in 0..3 {
            // Front and back of the glass: two layers of one half leave a quarter of what is behind.
            assert!((both[i] - (0.75 * blue[i] + 0.25 * red[i])).abs() < 2.0);
        }
    }

    #[test]
    fn winding_and_thread_count_do_not_change_a_byte() {
        let owner = |p: DVec3| (p.x + p.y > 90.0).then_some(u32::from(p.z < 50.0));
        let mut block = scene(
            Camera::from_above(2.0),
            vec![solid_box(1, [5.0, 10.0, 20.0], [70.0, 60.0, 70.0])],
        );
        block.parts[0].opacity = 0.7;
        block
            .parts
            .push(solid_box(2, [30.0, 5.0, 40.0], [95.0, 40.0, 80.0]));
        block.cut = Some(Cut::Plane {
            point: DVec3::new(40.0, 40.0, 50.0),
            removes: DVec3::new(-1.0, -1.0, 0.3),
        });
        let drawn = |threads: usize, block: &Scene| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| block.png(400, 300, Some(&owner)).unwrap())
        };
        let one = drawn(1, &block);
        assert!(one == drawn(2, &block));
        assert!(one == drawn(5, &block));
        for part in &mut block.parts {
            for triangle in &mut part.triangles {
                triangle.swap(1, 2);
            }
        }
        let pixels = |png: &[u8]| Pixmap::decode_png(png).unwrap().take();
        let (a, b) = (pixels(&one), pixels(&drawn(2, &block)));
        let differing = a
            .iter()
            .zip(&b)
            .filter(|(a, b)| a.abs_diff(**b) > 1)
            .count();
        // Only where a sample lies on the very rim of a triangle may rounding decide.
        assert!(differing * 1000 < a.len(), "{differing} of {}", a.len());
    }

    #[test]
    fn the_legend_has_what_is_drawn_once_and_in_order() {
        let mut view = scene(
            camera(180.0, 30.0),
            vec![
                solid_box(2, [0.0; 3], [10.0; 3]),
                solid_box(2, [20.0; 3], [30.0; 3]),
                solid_box(1, [40.0; 3], [50.0; 3]),
            ],
        );
        view.parts[2].opacity = 0.0;
        let names = |labels: &[u32]| -> Vec<String> {
            let swatches = view.swatches(&labels.iter().copied().collect());
            swatches.iter().map(|swatch| swatch.name.clone()).collect()
        };
        assert_eq!(names(&[]), ["coal"], "what is hidden is not in the legend");
        assert_eq!(names(&[0, 2]), ["mud", "coal"]);
    }

    #[test]
    fn a_png_has_the_size_that_was_asked_for() {
        let view = scene(Camera::from_above(1.0), vec![]);
        for (width, height) in [(64, 64), (301, 977), (1201, 90)] {
            let pixels = Pixmap::decode_png(&view.png(width, height, None).unwrap()).unwrap();
            assert_eq!((pixels.width(), pixels.height()), (width, height));
        }
    }

    #[test]
    fn what_cannot_be_drawn_is_refused_with_its_place() {
        type Break = fn(&mut Scene);
        let broken: [(Break, &str); 14] = [
            (|s| s.domain.high.z = 0.0, "range of elevations"),
            (|s| s.domain.low.x = f64::NAN, "range of eastings is NaN"),
            (|s| s.camera.azimuth_deg = f64::INFINITY, "azimuth is inf"),
            (|s| s.camera.elevation_deg = 91.0, "from -90 to 90"),
            (
                |s| s.camera.vertical_exaggeration = 0.0,
                "vertical exaggeration is 0",
            ),
            (
                |s| s.camera.projection = Projection::Perspective { distance: 0.2 },
                "distance in diagonals is 0.2",
            ),
            (
                |s| s.parts[0].positions[3].y = f64::NAN,
                "coordinate 1 of point 3 of sand",
            ),
            (
                |s| s.parts[0].positions[3].z = 1e9,
                "coordinate 2 of point 3 of sand",
            ),
            (
                |s| s.parts[0].triangles[5][2] = 8,
                "triangle 5 of sand refers to 8",
            ),
            (|s| s.parts[0].normals = Some(vec![]), "there are only 0"),
            (|s| s.parts[0].volume = 3, "part 0 refers to 3"),
            (|s| s.parts[0].opacity = 1.5, "opacity of sand"),
            (
                |s| {
                    s.cut = Some(Cut::Plane {
                        point: DVec3::ZERO,
                        removes: DVec3::ZERO,
                    });
                },
                "direction is 0",
            ),
            (
                |s| {
                    s.cut = Some(Cut::Corner {
                        low: s.domain.low,
                        high: s.domain.high,
                    });
                },
                "leaves nothing",
            ),
        ];
        let whole = |_: DVec3| Some(0);
        for (breaking, words) in broken {
            let mut view = scene(
                Camera::from_above(1.0),
                vec![solid_box(1, [0.0; 3], [9.0; 3])],
            );
            breaking(&mut view);
            let message = view.png(400, 300, Some(&whole)).unwrap_err().to_string();
            assert!(message.contains(words), "{message} / {words}");
        }
        let view = scene(Camera::from_above(1.0), vec![]);
        for (width, height) in [(0, 300), (300, 0), (20_000, 100), (16_384, 16_384)] {
            assert!(view.png(width, height, None).is_err());
        }
        let wrong = |_: DVec3| Some(3);
        let message = view.png(400, 300, Some(&wrong)).unwrap_err().to_string();
        assert!(message.contains("owner of the point"), "{message}");
    }
}
