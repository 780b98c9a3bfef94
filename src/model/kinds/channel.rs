//! Channels.

use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;

use super::keys::Keys;
use super::kind::Kind;
use super::made::{Frame, Made, Outcome, Site};
use crate::features::body::Body;
use crate::features::channel::{ChannelDesign, ChannelError, Origin};
use crate::features::conduit;
use crate::features::own_section::{Close, OwnSection};
use crate::features::profile::Profile as Along;
use crate::features::reach::Reach;
use crate::model::checker::Reported;
use crate::model::domain::Domain;
use crate::model::draft::Draft;
use crate::model::draws::{Draws, Reason, diagonal};
use crate::model::interior::Interior;
use crate::model::nature::{Children, Copies, Gives, Nature, Taking, Volumes, Within};
use crate::model::read::{Any, Field};
use crate::model::references::Reference;
use crate::model::tree::{NodeId, quoted};
use crate::model::values::bent::BentProfile;
use crate::model::values::junction::{Joining, Joins, JoinsFile};
use crate::model::values::limits::{ANY, ASYMMETRY, BANK_ANGLE, POSITIVE};
use crate::model::values::profile::Profile;
use crate::model::values::section::SectionFile;
use crate::model::values::trajectory::{self, TrajectorySpec};

/// How far a trajectory without a length runs past the domain, as a fraction of the domain's diagonal;
/// two widths are added. Ends well outside leave the domain's walls to be crossed cleanly.
const OVERSHOOT: f64 = 0.05;
/// How far the rims of a channel that conforms to a surface stand above it, as a fraction of the depth: its top does not run along
/// the surface.
const PROUD: f64 = 0.02;
const DEFAULT_ANGLE_LIMIT_DEG: f64 = 15.0;
const DEFAULT_TOLERANCE_FRACTION: f64 = 0.01;
/// Below these sections are so dense that nothing is gained, and surfaces take gigabytes.
const LEAST_ANGLE_LIMIT_DEG: f64 = 0.1;
const LEAST_TOLERANCE_FRACTION: f64 = 1e-5;

/// A channel: a section carried along a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelSpec {
    /// Width of the top.
    pub width: Profile,
    /// Depth of the thalweg below the top.
    pub depth: Profile,
    /// Offset of the thalweg to the right of the centre, as a fraction of the width, in (−0.5, 0.5).
    pub asymmetry: BentProfile,
    /// The section's shape, if it is one's own.
    pub section: Option<Arc<OwnSection>>,
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
    /// Where it joins the channel that it goes along.
    pub joins: Option<Joins>,
    /// A new section is set where the direction has turned by more than this, degrees.
    pub angle_limit_deg: f64,
    /// How far the thalweg and the rims may lie from where they belong, as a fraction of the width.
    pub tolerance_fraction: f64,
}

/// Which point of a section follows the trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionOrigin {
    /// The deepest point.
    Thalweg,
    /// The middle of the top.
    TopCentre,
}

/// A channel: a section carried along a trajectory.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChannelFile {
    /// Width of the top in metres, above 0.
    #[schemars(with = "Profile")]
    pub(crate) width: Field<Any>,
    /// Depth of the deepest point (the thalweg) below the top, in metres, above 0.
    #[schemars(with = "Profile")]
    pub(crate) depth: Field<Any>,
    /// How far right of the centre the deepest point lies, as a fraction of the width, between -0.5 and 0.5; `{ by_curvature = 0.2 }` moves it towards the outer banks of bends; 0 if left out.
    #[schemars(with = "Option<BentProfile>")]
    pub(crate) asymmetry: Option<Field<Any>>,
    /// Angle of the left bank (looking along the trajectory) below the horizontal at the rim, in degrees, between 0 and 180; chosen by the section if left out.
    #[schemars(with = "Option<Profile>")]
    pub(crate) left_angle_deg: Option<Field<Any>>,
    /// Angle of the right bank below the horizontal at the rim, in degrees, between 0 and 180; chosen by the section if left out.
    #[schemars(with = "Option<Profile>")]
    pub(crate) right_angle_deg: Option<Field<Any>>,
    /// Elevation of the top in metres; if left out, uniform between the base of the domain + depth and its top.
    #[schemars(with = "Option<Profile>")]
    pub(crate) top: Option<Field<Any>>,
    /// Which point of the section follows the trajectory: "thalweg" (the default) or "top-centre".
    #[schemars(schema_with = "section_origin")]
    #[serde(default)]
    pub(crate) origin: Option<Field<String>>,
    /// A section of one's own, in place of the usual one with its asymmetry and bank angles: `{ points, degree, weights, knots, close, depth_is }`.
    #[schemars(with = "Option<SectionFile>")]
    pub(crate) section: Option<Field<Any>>,
    /// The way that the channel takes, in plan.
    #[schemars(schema_with = "trajectory::schema")]
    pub(crate) trajectory: Field<Any>,
    /// Where and how it joins the channel that it goes `along`: a tributary, whose trajectory leads on to that place; `{ at, angle_deg, side }`.
    #[schemars(with = "Option<JoinsFile>")]
    pub(crate) joins: Option<Field<Any>>,
    /// A new section is set where the direction has turned by more than this, in degrees; 15 if left out.
    #[schemars(range(min = 0.1, max = 90))]
    pub(crate) angle_limit_deg: Option<Field<f64>>,
    /// How far thalweg and rims may lie from where they belong, as a fraction of the width; 0.01 if left out.
    #[schemars(range(min = 0.00001, max = 0.5))]
    pub(crate) tolerance_fraction: Option<Field<f64>>,
}

fn section_origin(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": ["thalweg", "top-centre"] })
}

impl Kind for ChannelSpec {
    const NATURE: Nature = Nature {
        name: "channel",
        copies: Copies::Any,
        within: Within::AnythingOrAlong {
            kind: "channel",
            remedy: "name the feature of kind = \"channel\" that the tributary joins",
        },
        children: Children::Any,
        taking: Taking::ByRules,
        volumes: Volumes::One,
        is_base: false,
        placed_by: "what a channel leaves out is drawn over the whole domain, so set its `top` and a trajectory (`center`, or \
                    `from` and `to`)",
        apart: "change `top`, `depth` or `width` of {name} by {by} or more, or its trajectory",
    };

    const GIVES: Gives = Gives::Way;

    const CONFORMS: bool = true;

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        ChannelFile::json_schema(generator)
    }

    fn read(keys: &mut Keys<'_, '_>) -> Option<Self> {
        let file: ChannelFile = keys.table()?;
        let width = keys.profile(file.width, "width", "width = 50", POSITIVE);
        let depth = keys.profile(file.depth, "depth", "depth = 5", POSITIVE);
        if let (Some((node, depth)), Some(domain)) = (&depth, keys.domain) {
            keys.check_depth(*node, depth, domain);
        }
        let asymmetry = keys.optional_bent_profile(file.asymmetry, "asymmetry", ASYMMETRY);
        let left = keys.optional_profile(file.left_angle_deg, "left_angle_deg", BANK_ANGLE);
        let right = keys.optional_profile(file.right_angle_deg, "right_angle_deg", BANK_ANGLE);
        let section = keys.section(
            file.section,
            [
                ("asymmetry", matches!(asymmetry, Ok(Some(_)))),
                ("left_angle_deg", matches!(left, Ok(Some(_)))),
                ("right_angle_deg", matches!(right, Ok(Some(_)))),
            ],
        );
        let top = keys.optional_profile(file.top, "top", ANY);
        if let (Ok(Some((node, top))), Some(domain)) = (&top, keys.domain) {
            keys.note_top(*node, top, domain);
        }
        let origin = match file.origin {
            None => Some(SectionOrigin::Thalweg),
            Some(field) => field
                .good()
                .and_then(|(node, word)| keys.section_origin(node, &word)),
        };
        let example = "trajectory = { kind = \"line\", azimuth_deg = 45 }";
        let trajectory = keys
            .need(file.trajectory, "trajectory", example)
            .and_then(|(node, Any)| Some((node, keys.checker.trajectory(node, keys.family)?)));
        if let (Some((node, trajectory)), Some(domain)) = (&trajectory, keys.domain) {
            let name = &keys.draft.name;
            keys.checker
                .note_far_trajectory(*node, trajectory, name, domain);
        }
        let joins = keys.junction(file.joins);
        let angle = keys.number_in(
            file.angle_limit_deg,
            DEFAULT_ANGLE_LIMIT_DEG,
            [LEAST_ANGLE_LIMIT_DEG, 90.0],
            "angle limit",
        );
        let tolerance = keys.number_in(
            file.tolerance_fraction,
            DEFAULT_TOLERANCE_FRACTION,
            [LEAST_TOLERANCE_FRACTION, 0.5],
            "tolerance",
        );
        let plain = |found: Option<(NodeId, Profile)>| found.map(|(_, profile)| profile);
        Some(Self {
            width: plain(width)?,
            depth: plain(depth)?,
            asymmetry: asymmetry.ok()?.unwrap_or(BentProfile::from(0.0)),
            section: section.ok()?,
            left_angle_deg: plain(left.ok()?),
            right_angle_deg: plain(right.ok()?),
            top: plain(top.ok()?),
            origin: origin?,
            trajectory: trajectory?.1,
            joins: joins.ok()?,
            angle_limit_deg: angle?,
            tolerance_fraction: tolerance?,
        })
    }

    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason> {
        let domain = site.domain;
        let width = draws.profile(&self.width, "width")?;
        let depth = draws.profile(&self.depth, "depth")?;
        let asymmetry = self.asymmetry.draw(draws, "asymmetry")?;
        let left_angle = draws.angle(self.left_angle_deg.as_ref(), "left_angle_deg")?;
        let right_angle = draws.angle(self.right_angle_deg.as_ref(), "right_angle_deg")?;
        let joining = match &self.joins {
            Some(joins) => Some(Joining::draw(joins, site.reach()?, draws)?),
            None => None,
        };
        let deepest = depth.range().1;
        let top = match (&self.top, &joining) {
            (Some(top), _) => draws.profile(top, "top")?,
            (None, Some(joining)) => Along::Constant(joining.top(depth.at(1.0))),
            // What conforms to a surface is built anywhere.
            (None, None) if site.warp.is_some() => Along::Constant(domain.z[0]),
            (None, None) => any_top(deepest, domain, draws)?,
        };
        let rims = top.range().1;
        let overshoot = 2.0 * width.range().1 + OVERSHOOT * diagonal(domain) + site.beyond();
        let mut trajectory = trajectory::trajectory(&self.trajectory, site, overshoot, draws)?;
        if let Some(joining) = &joining {
            trajectory = joining.way(&trajectory, width.at(1.0))?;
        }
        let trajectory = Arc::new(trajectory);
        let design = ChannelDesign {
            width,
            depth,
            own: self.section.clone(),
            asymmetry: asymmetry.along(&trajectory),
            left_angle,
            right_angle,
            top,
            origin: match self.origin {
                SectionOrigin::Thalweg => Origin::Thalweg,
                SectionOrigin::TopCentre => Origin::TopCentre,
            },
            angle_limit: self.angle_limit_deg.to_radians(),
            tolerance: self.tolerance_fraction,
        };
        let refused = |error: ChannelError| (error.reason(), error.to_string());
        let mut made = match &self.section {
            Some(own) if own.close() == Close::Closed => {
                let conduit = conduit::build(&design, own, &trajectory);
                let conduit = conduit.map_err(|error| refused(error.into()))?;
                // What lies in a channel lies on its floor or under its top: a tube has neither.
                Made::body(Body::Shell(conduit), draws.taken())
            }
            _ => {
                let trough = design.build(&trajectory).map_err(refused)?;
                let mut mouth = 1.0;
                if let (Some(joining), Some((name, trunk))) = (&joining, site.host)
                    && let Some(trunk) = trunk.parts.first()
                {
                    let inside = Interior::of(&trunk.body)
                        .map_err(|error| ("no trunk", format!("it cannot join {name}: {error}")))?;
                    mouth = joining.mouth(&trough, &trajectory, &inside, name)?;
                }
                let reach = Reach::new(design, trajectory, &trough).with_mouth(mouth);
                Made {
                    frame: Frame::Along(Arc::new(reach)),
                    ..Made::body(Body::Trough(trough), draws.taken())
                }
            }
        };
        if let Some(own) = &self.section {
            made.decisions.push(format!(
                "has a section of {:.6} of width times depth, at its deepest {:.6} of the depth below y = 0",
                own.area(),
                -own.deepest().y
            ));
        }
        Ok(made.at_level(rims - PROUD * deepest))
    }

    fn refers(&self) -> Vec<&Reference> {
        self.trajectory.refers()
    }

    /// Channels thin out to nothing at their banks, and leave strips of what they cut: facets on both sides cut each other
    /// unless they are small.
    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        let width = |one: &Outcome<'_>| {
            let Body::Trough(trough) = one.body else {
                return None;
            };
            let [left, right] = trough.rims();
            let across = |v: &f64| left.point(*v).distance(right.point(*v));
            trough.sections().iter().map(across).min_by(f64::total_cmp)
        };
        let (width, name) = made
            .iter()
            .filter_map(|one| Some((width(one)?, one.name)))
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let size = 0.5 * width;
        Some(format!(
            "channels thin out to nothing at their banks and cut narrow strips off each other; Gmsh fails there (“overlapping facets”, \
             “a segment and a facet intersect”) while its elements are too large. Set `Mesh.Algorithm = 1`, begin with \
             `Mesh.MeshSizeMax = {size:.1}` (half the width of the narrowest one, {name}), and halve it while Gmsh fails; no size is \
             sure to do"
        ))
    }
}

/// A top somewhere in the domain, as far below the channel's lowest place allows.
fn any_top(deepest: f64, domain: &Domain, draws: &mut Draws<'_>) -> Result<Along, Reason> {
    let lowest = domain.z[0] + deepest;
    if !(lowest <= domain.z[1]) {
        let height = domain.z[1] - domain.z[0];
        let message = format!(
            "the channel is {deepest:.2} m deep and the domain {height:.2} m high: \
             make it shallower or give it a `top`"
        );
        return Err(("deeper than the domain", message));
    }
    Ok(Along::Constant(draws.uniform(
        lowest,
        domain.z[1],
        "top",
    )?))
}

impl Keys<'_, '_> {
    /// What goes along a channel joins it, and nothing else does.
    fn junction(&self, field: Option<Field<Any>>) -> Result<Option<Joins>, Reported> {
        let Draft {
            name, node, along, ..
        } = self.draft;
        match (field, along) {
            (None, None) => Ok(None),
            (None, Some((at, trunk))) => {
                let message = format!("{name} goes along {}, but does not join it", quoted(trunk));
                let remedy = "add where: joins = { at = 0.6, angle_deg = 60, side = \"left\" }; or leave `along` out";
                self.checker.reader.wrong(*at, message, remedy);
                Err(Reported)
            }
            (Some(field), along) => {
                let (at, Any) = field.good().ok_or(Reported)?;
                if along.is_none() && !self.draft.wrong_along() {
                    self.checker.reader.missing(
                        *node,
                        name,
                        "along",
                        "along = \"the-trunk\", the channel that it joins",
                    );
                }
                self.checker.joins(at, name).map(Some).ok_or(Reported)
            }
        }
    }

    fn section_origin(&self, node: NodeId, word: &str) -> Option<SectionOrigin> {
        match word {
            "thalweg" => Some(SectionOrigin::Thalweg),
            "top-centre" => Some(SectionOrigin::TopCentre),
            _ => {
                self.checker.reader.wrong(
                    node,
                    format!("{} is not a point of a channel's section", quoted(word)),
                    "write \"thalweg\" or \"top-centre\"",
                );
                None
            }
        }
    }

    /// A section of one's own. It has no other shape besides.
    fn section(
        &mut self,
        field: Option<Field<Any>>,
        others: [(&str, bool); 3],
    ) -> Result<Option<Arc<OwnSection>>, Reported> {
        let Some(field) = field else {
            return Ok(None);
        };
        let (node, Any) = field.good().ok_or(Reported)?;
        if let Some((key, _)) = others.into_iter().find(|other| other.1) {
            self.checker.reader.wrong(
                node,
                format!(
                    "{} has both a section of its own and `{key}`",
                    self.draft.name
                ),
                format!("the section's points say its shape: leave out `{key}`, or `section`"),
            );
            return Err(Reported);
        }
        let what = self.what("section");
        let section = self.checker.section(node, &what);
        section.map(Some).ok_or(Reported)
    }

    fn check_depth(&self, node: NodeId, depth: &Profile, domain: &Domain) {
        let [_, _, height] = domain.size();
        if let Some(depth) = depth.constant()
            && depth > height
        {
            self.checker.reader.wrong(
                node,
                format!(
                    "the depth of {} is {depth}, more than the domain's height of {height}",
                    self.draft.name
                ),
                "make the channel shallower, or the domain's z range larger",
            );
        }
    }

    fn note_top(&mut self, node: NodeId, top: &Profile, domain: &Domain) {
        let [base, roof] = domain.z;
        if let Some(top) = top.constant()
            && top <= base
        {
            self.checker.note(
                node,
                format!(
                    "{} lies below the domain, whose base is at {base}, so it has no volume",
                    self.draft.name
                ),
            );
        } else if let Some(top) = top.constant()
            && top > roof
        {
            self.checker.note(
                node,
                format!(
                    "the top of {} at {top} is above the domain's at {roof}, which cuts it off",
                    self.draft.name
                ),
            );
        }
    }
}
