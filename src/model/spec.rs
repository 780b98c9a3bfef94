//! The checked model: what the program works with once a model file has been read.
//!
//! Lengths are metres, z points up, x east, y north. References between facies and features are indices into the model's
//! own lists, so they cannot dangle.

use super::expression::Expression;
use super::profile::Profile;
use super::quantity::Quantity;
use crate::nurbs::interpolate::Parametrization;

/// A checked model.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// What the model is called.
    pub name: String,
    /// A sentence or two about it.
    pub description: Option<String>,
    /// The seed of all draws.
    pub seed: u64,
    /// Where the local origin lies in the world: recorded, never added to the coordinates.
    pub origin: [f64; 3],
    /// The block that is modelled.
    pub domain: Domain,
    /// The facies, in file order.
    pub facies: Vec<Facies>,
    /// The features from oldest to youngest, in file order.
    pub features: Vec<Feature>,
    /// What is worth saying about the file although it is right.
    pub notes: Vec<Note>,
}

/// The modelled block; its volume before any feature is called `background`.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain {
    /// West and east limits.
    pub x: [f64; 2],
    /// South and north limits.
    pub y: [f64; 2],
    /// Base and top.
    pub z: [f64; 2],
    /// A base above the block's own: below it the model has nothing.
    pub base: Option<HorizonSurface>,
    /// A top below the block's own: above it the model has nothing.
    pub top: Option<HorizonSurface>,
    /// A bed thinner than this at the nodes of its horizons' grids is absent there.
    pub least_thickness: f64,
    /// Index of the background's facies.
    pub facies: usize,
}

impl Domain {
    /// [`Self::least_thickness`] if none is given, as a fraction of the domain's diagonal: far below any geology.
    pub const LEAST_THICKNESS: f64 = 1e-10;

    /// Extents in x, y and z.
    pub fn size(&self) -> [f64; 3] {
        [self.x, self.y, self.z].map(|[lo, hi]| hi - lo)
    }
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

/// The value of a rock property.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Property {
    /// One number.
    Scalar(f64),
    /// One number for each of x, y and z.
    Vector([f64; 3]),
}

/// One entry of the feature list: one geological thing, or `count` alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Its id, unique in the model.
    pub id: String,
    /// What it is.
    pub kind: FeatureKind,
    /// Whether it takes part.
    pub enabled: bool,
    /// How many instances are made (per instance of the parent).
    pub count: usize,
    /// Hierarchical level, 1 = largest.
    pub level: u32,
    /// Index of the parent.
    pub parent: Option<usize>,
    /// Index of the facies of what it bounds.
    pub facies: usize,
    /// What it may remove.
    pub removes: Selector,
    /// What may remove it.
    pub removed_by: Selector,
    /// Whether it removes nothing but its parent and the background.
    pub preserve: bool,
    /// Where the file defines it.
    pub place: Place,
}

/// What a feature is.
#[derive(Clone, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a model has one for each feature, not for each instance"
)]
pub enum FeatureKind {
    /// A channel along a trajectory.
    Channel(ChannelSpec),
    /// A concretion or nodule.
    Ellipsoid(EllipsoidSpec),
    /// A surface through the domain, with a new unit above it.
    Horizon(HorizonSpec),
    /// Clinoforms that divide a horizon's unit.
    Clinoforms(ClinoformsSpec),
}

impl FeatureKind {
    /// The kinds' names, as the model file writes them.
    pub const NAMES: [&'static str; 4] = ["channel", "ellipsoid", "horizon", "clinoforms"];

    /// The kind's name, as the model file writes it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Channel(_) => "channel",
            Self::Ellipsoid(_) => "ellipsoid",
            Self::Horizon(_) => "horizon",
            Self::Clinoforms(_) => "clinoforms",
        }
    }
}

/// Which features a rule speaks of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selector {
    /// All of them.
    Everything,
    /// What any of the picks admits; none if the list is empty.
    Only(Vec<Pick>),
}

/// One entry of a [`Selector`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Pick {
    /// The feature with this id, or `background`.
    Id(String),
    /// Every feature of this kind.
    Kind(String),
    /// Every feature of this level.
    Level(u32),
    /// Everything of this facies.
    Facies(String),
}

/// A channel: a section carried along a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelSpec {
    /// Width of the top.
    pub width: Profile,
    /// Depth of the thalweg below the top.
    pub depth: Profile,
    /// Offset of the thalweg to the right of the centre, as a fraction of the width, in (−0.5, 0.5).
    pub asymmetry: Profile,
    /// Angle of the left bank (looking down the trajectory) below the horizontal, degrees; chosen by the section if absent.
    pub left_angle_deg: Option<Profile>,
    /// Angle of the right bank below the horizontal, degrees; chosen by the section if absent.
    pub right_angle_deg: Option<Profile>,
    /// Elevation of the top; uniform between the base + depth and the top of the domain if absent.
    pub top: Option<Profile>,
    /// Which point of the section follows the trajectory.
    pub origin: SectionOrigin,
    /// The way that the channel takes.
    pub trajectory: TrajectorySpec,
    /// A new section is set where the direction has turned by more than this, degrees.
    pub angle_limit_deg: f64,
    /// How far the thalweg and the rims may lie from where they belong, as a fraction of the width.
    pub tolerance_fraction: f64,
}

/// An ellipsoid: a concretion, a cemented nodule.
#[derive(Clone, Debug, PartialEq)]
pub struct EllipsoidSpec {
    /// Semi-axes: along azimuth and plunge, level across it, at right angles to both.
    pub semi_axes: [Quantity; 3],
    /// The centre; uniform over what the parent has of the domain, or over the domain, if absent.
    pub center: Option<[Quantity; 3]>,
    /// Direction of the first axis in plan, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// Angle of the first axis below the horizontal, degrees.
    pub plunge_deg: Quantity,
}

/// A horizon: it makes a new unit above it, up to the next horizon or the domain's top.
#[derive(Clone, Debug, PartialEq)]
pub struct HorizonSpec {
    /// Where it runs.
    pub surface: HorizonSurface,
    /// Whether its unit takes from the open unit and its children alone; otherwise it is erosive and takes from everything.
    pub onlapping: bool,
}

/// A surface z(x, y) over the whole domain.
#[derive(Clone, Debug, PartialEq)]
pub enum HorizonSurface {
    /// Level, at this elevation.
    Level(Quantity),
    /// A plane.
    Dipping {
        /// A point of it.
        through: [Quantity; 3],
        /// Its angle below the horizontal, degrees.
        dip_deg: Quantity,
        /// The direction of its dip, clockwise from north, degrees.
        azimuth_deg: Quantity,
    },
    /// Heights at the nodes of a regular grid, interpolated exactly.
    Grid {
        /// The first and the last column.
        x: [f64; 2],
        /// The first and the last row.
        y: [f64; 2],
        /// At least two rows from south to north, of at least two values each, from west to east.
        heights: Vec<Vec<f64>>,
    },
    /// Scattered points, approximated.
    Points {
        /// At least three, not on one line in plan.
        points: Vec<[f64; 3]>,
        /// How far from a point the surface may pass, vertically.
        tolerance: f64,
    },
    /// As high above another horizon as a thickness says.
    Above {
        /// Index of the feature that is the other horizon; an older one.
        horizon: usize,
        /// The thickness over the plan: level, a grid or points, none of them below 0.
        thickness: Box<HorizonSurface>,
    },
}

/// A set of clinoforms: sheets that divide a horizon's unit into clinothems, and the facies belts of each.
#[derive(Clone, Debug, PartialEq)]
pub struct ClinoformsSpec {
    /// What bounds the unit above.
    pub top: Bound,
    /// Direction of progradation, clockwise from north, degrees.
    pub azimuth_deg: Quantity,
    /// Semi-extents of the shoreline's ellipse, along dip and along strike.
    pub shoreline: [Quantity; 2],
    /// Plan distance from a clinoform's shoreline to its toe.
    pub length: Quantity,
    /// Distance from a clinoform to the next.
    pub spacing: Quantity,
    /// Distance from where the set begins to its first clinoform.
    pub first: Quantity,
    /// Exponent of the dip profile.
    pub exponent: Quantity,
    /// How straight the profile meets its base: 0 is tangent to it, 1 is straight; chosen by the bounds if absent.
    pub toe: Option<Quantity>,
    /// How many clinoforms; as many as have their shoreline in the domain if absent.
    pub sheets: Option<usize>,
    /// Facies belts from landward to basinward; without any, a clinothem is one volume.
    pub belts: Vec<Belt>,
    /// The shape of the boundaries between belts.
    pub interfingering: Interfingering,
    /// Least and greatest distance along strike from one turn of these boundaries to the next; by the domain if absent.
    pub turns: Option<[Quantity; 2]>,
}

/// What bounds a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The domain's own base or top.
    Domain,
    /// The horizon that is this feature.
    Horizon(usize),
}

/// A facies belt of a clinothem.
#[derive(Clone, Debug, PartialEq)]
pub struct Belt {
    /// Its name, unique in its set.
    pub name: String,
    /// Index of its facies.
    pub facies: usize,
    /// Width along dip; absent in the last belt only.
    pub width: Option<Quantity>,
    /// How far its basinward boundary swings, from peak to peak; absent in the last belt only.
    pub interfingering: Option<Quantity>,
}

/// The shape of the boundaries between facies belts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interfingering {
    /// Smooth along strike.
    Smooth,
    /// Straight legs with kinks.
    Zigzag,
}

/// Which point of a section follows the trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionOrigin {
    /// The deepest point.
    Thalweg,
    /// The middle of the top.
    TopCentre,
}

/// The way that a feature takes, in plan.
#[derive(Clone, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a model has one for each feature, not for each instance"
)]
pub enum TrajectorySpec {
    /// A straight line between two points.
    Line {
        /// Start.
        from: [Quantity; 2],
        /// End.
        to: [Quantity; 2],
    },
    /// A straight line in a direction.
    Heading {
        /// Direction, clockwise from north, degrees.
        azimuth_deg: Quantity,
        /// A point of the line, its middle if a length is given; uniform over the domain if absent.
        center: Option<[Quantity; 2]>,
        /// Length; right across the domain if absent.
        length: Option<Quantity>,
    },
    /// A curve through points.
    Points {
        /// The points, in order, no two neighbours alike.
        points: Vec<[f64; 2]>,
        /// How the curve's parameter is spread over the points.
        parametrization: Parametrization,
        /// Degree of the curve, below the number of points.
        degree: usize,
    },
    /// A sine-generated (meandering) curve.
    SineGenerated {
        /// Half of peak to peak across the mean direction.
        amplitude: Quantity,
        /// Length of one meander along the mean direction.
        wavelength: Quantity,
        /// Mean direction, clockwise from north, degrees.
        azimuth_deg: Quantity,
        /// Middle of the curve; uniform over the domain if absent.
        center: Option<[Quantity; 2]>,
        /// Where the curve is in its meander at the centre, as a fraction of a wavelength.
        phase: Option<Quantity>,
        /// Length along the mean direction; right across the domain if absent.
        length: Option<Quantity>,
    },
    /// Two formulas in `t`.
    Parametric {
        /// x of t.
        x: Expression,
        /// y of t.
        y: Expression,
        /// From which t to which.
        range: [f64; 2],
    },
}

/// Where something stands in a text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file, or the argument.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// Something worth saying about a file that is right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// What.
    pub message: String,
    /// Where.
    pub place: Place,
}
