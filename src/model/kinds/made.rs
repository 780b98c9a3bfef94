//! Where one instance is made, and what it is.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::features::body::Body;
use crate::features::fabric::Fabric;
use crate::features::fault_surface::FaultSurface;
use crate::features::horizon::Horizon;
use crate::features::motion::Motion;
use crate::features::reach::Reach;
use crate::features::side::Side;
use crate::model::domain::Domain;
use crate::model::draws::Reason;
use crate::model::interior::Interior;
use crate::model::references::Reference;
use crate::model::values::surface::HorizonSurface;
use crate::model::warp::Warp;

/// Where one instance is made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site<'a> {
    /// The block that is modelled.
    pub(crate) domain: &'a Domain,
    /// The same with whatever comes to lie in it because younger events move it: so far its surfaces must reach.
    pub(crate) room: &'a Domain,
    /// What the parent holds, for kinds that ask for it.
    pub(crate) interior: Option<&'a Interior>,
    /// Of a base: its surface, as decided among all of them, and what was drawn for it.
    pub(crate) surface: Option<(&'a Horizon, &'a [(String, f64)])>,
    /// Whether it has a parent.
    pub(crate) is_child: bool,
    /// What it is placed by: the frame of its parent, or of what it goes along, or that of the domain.
    pub(crate) frame: &'a Frame,
    /// What it lies in or goes along, with its name.
    pub(crate) host: Option<(&'a str, &'a Made)>,
    /// What was made of all that it refers to.
    pub(crate) others: &'a [(&'a Reference, &'a Made)],
    /// What bounds its unit above, for kinds that ask for it.
    pub(crate) top: Option<&'a Horizon>,
    /// How far it moves so that contacts which coincide are decided by age (m): less than nothing, and less for younger
    /// ones of the kind; 0 if they are not.
    pub(crate) nudge: f64,
    /// What it conforms to by itself, not with its parent.
    pub(crate) warp: Option<&'a Warp>,
}

impl<'a> Site<'a> {
    /// The channel that it lies in or goes along.
    pub(crate) fn reach(&self) -> Result<&'a Reach, Reason> {
        self.frame.reach().ok_or_else(|| {
            (
                "no channel",
                "its parent is no channel with a floor and a top between rims".to_owned(),
            )
        })
    }

    /// How far surfaces must reach beyond the domain in plan because events bring what is there into it (m).
    pub(crate) fn beyond(&self) -> f64 {
        let beyond =
            |domain: [f64; 2], room: [f64; 2]| (domain[0] - room[0]).max(room[1] - domain[1]);
        beyond(self.domain.x, self.room.x).max(beyond(self.domain.y, self.room.y))
    }

    /// Whether anything between two corners can lie in the domain.
    pub(crate) fn meets(&self, (low, high): (DVec3, DVec3)) -> bool {
        let axes = [self.domain.x, self.domain.y, self.domain.z];
        axes.into_iter()
            .enumerate()
            .all(|(axis, [from, to])| low[axis] < to && high[axis] > from)
    }

    /// What was made of something that its kind refers to.
    pub(crate) fn other(&self, reference: &Reference) -> Result<Other<'a>, Reason> {
        let found = self.others.iter().find(|other| other.0 == reference);
        let Some((_, made)) = found else {
            let message = "what it refers to takes no part".to_owned();
            return Err(("no referent", message));
        };
        let part = if reference.part.is_empty() {
            None
        } else {
            let is_it = |part: &&Part| part.name == reference.part;
            Some(made.parts.iter().find(is_it).ok_or_else(|| {
                let last = made.parts.last().map_or("", |part| part.name.as_str());
                let message = format!(
                    "it refers to number `{}` of something of which the last one is `{last}` with this seed",
                    reference.part
                );
                ("no such referent", message)
            })?)
        };
        Ok(Other { made, part })
    }

    /// The open sheet that something refers to.
    pub(crate) fn sheet(&self, reference: &Reference) -> Result<&'a Arc<Side>, Reason> {
        let found = self.others.iter().find(|other| other.0 == reference);
        // A clinothem with belts is the sheet of the first of them.
        let is_it = |part: &&Part| {
            let rest = part.name.strip_prefix(reference.part.as_str());
            reference.part.is_empty()
                || rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        let part = found.and_then(|(_, made)| made.parts.iter().find(is_it));
        if let Some(Body::Side(side)) = part.map(|part| &part.body) {
            Ok(side)
        } else {
            let message = format!(
                "there is no sheet number `{}` with this seed",
                reference.part.trim_start_matches('-')
            );
            Err(("no such referent", message))
        }
    }

    /// The channel that something refers to.
    pub(crate) fn other_reach(&self, reference: &Reference) -> Result<&'a Arc<Reach>, Reason> {
        let Other { made, part } = self.other(reference)?;
        match (part, &made.frame) {
            (None, Frame::Along(reach)) => Ok(reach),
            _ => Err(("no channel", "it refers to what is no channel".to_owned())),
        }
    }
}

impl Frame {
    /// The channel that it is.
    fn reach(&self) -> Option<&Reach> {
        match self {
            Self::Along(reach) => Some(reach),
            Self::None | Self::Unit(_) => None,
        }
    }
}

/// What was made of something that is referred to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Other<'a> {
    /// All of the instance.
    pub(crate) made: &'a Made,
    /// The part of it that is named, if one is.
    pub(crate) part: Option<&'a Part>,
}

/// One instance: the volumes that it makes, in order of evaluation, and what its children are placed by.
#[derive(Clone, Debug)]
pub(crate) struct Made {
    pub(crate) parts: Vec<Part>,
    pub(crate) frame: Frame,
    /// What was decided about it, to go on after its name.
    pub(crate) decisions: Vec<String>,
    /// What it does to all that is older, if it is an event and no rock.
    pub(crate) event: Option<Event>,
}

/// What moves all that is older.
#[derive(Clone, Debug)]
pub(crate) struct Event {
    /// Where what was at a place is afterwards: on one side of the instance's part, or everywhere if it has none.
    pub(crate) motion: Motion,
    /// The same of what lies on the other side, if that moves, too.
    pub(crate) rest: Option<Motion>,
    /// Whether the part is one side of a plane.
    pub(crate) is_plane: bool,
    /// The fault's surface, on which it may slip again.
    pub(crate) surface: Option<Arc<FaultSurface>>,
    /// Whether it is another slip on the surface of an older fault, the first that it refers to.
    pub(crate) is_again: bool,
    /// Of a fault that ends on another one, the first that it refers to: on which side of that it lies.
    pub(crate) ends_on: Option<Wall>,
    /// How far what it moves may be off (m); by the domain's size if absent.
    pub(crate) tolerance: Option<f64>,
}

/// A side of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wall {
    /// What lies above it.
    Hanging,
    /// What lies below it.
    Foot,
}

impl Wall {
    /// Its word in names of blocks.
    pub fn word(self) -> &'static str {
        match self {
            Self::Hanging => "hw",
            Self::Foot => "fw",
        }
    }
}

/// By what children are placed in an instance.
#[derive(Clone, Debug)]
pub(crate) enum Frame {
    /// By coordinates alone.
    None,
    /// A unit, by its base.
    Unit(Horizon),
    /// Along a channel.
    Along(Arc<Reach>),
}

/// A volume that is to be.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// What follows the instance's name in that of the volume.
    pub(crate) name: String,
    /// What it holds.
    pub(crate) body: Body,
    /// What it takes from.
    pub(crate) from: TakesFrom,
    /// Its facies, if that is not the feature's.
    pub(crate) facies: Option<usize>,
    /// What was drawn, by parameter.
    pub(crate) drawn: Vec<(String, f64)>,
    /// Of what may conform to a surface: the elevation in it that comes to lie on that (m); its top if absent.
    pub(crate) level: Option<f64>,
    /// How its layers lie, if its body, its channel and its unit do not tell.
    pub(crate) fabric: Option<Fabric>,
    /// Of what conforms to a surface: the surface's mean slope there, by which its layers are sheared (m/m along x and y).
    pub(crate) slope: DVec2,
    /// Of a layer: the fraction of the way from the base to the top of what is divided at which it has its properties. All layers of
    /// an instance share the draws of these.
    pub(crate) fraction: Option<f64>,
}

/// What a volume takes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TakesFrom {
    /// Whatever the feature's rules admit.
    Anything,
    /// The parent and what lies in it, or the background.
    Parent,
    /// The parent alone, without what lies in it.
    ParentItself,
    /// The unit that is open below it, and what lies in it.
    OpenUnit,
    /// Another part of the same instance, an older one; if that takes no part, what that one would take from.
    Part(usize),
}

impl Made {
    /// Whether anything was drawn for it.
    pub(crate) fn is_drawn(&self) -> bool {
        self.parts.iter().any(|part| !part.drawn.is_empty())
    }

    /// An instance that is one body, and takes what the feature's rules admit.
    pub(crate) fn body(body: Body, drawn: Vec<(String, f64)>) -> Self {
        Self::of(vec![Part {
            drawn,
            ..Part::of(body)
        }])
    }

    /// An instance by whose parts no children are placed.
    pub(crate) fn of(parts: Vec<Part>) -> Self {
        Self {
            parts,
            frame: Frame::None,
            decisions: Vec::new(),
            event: None,
        }
    }
}

impl Made {
    /// The same, with the elevation in it that comes to lie on what it conforms to (m).
    pub(crate) fn at_level(mut self, level: f64) -> Self {
        for part in &mut self.parts {
            part.level = Some(level);
        }
        self
    }
}

impl Part {
    /// The elevation in it that comes to lie on what it conforms to (m).
    pub(crate) fn level(&self) -> f64 {
        self.level.unwrap_or_else(|| self.body.bounds().1.z)
    }

    /// The only volume of an instance, which takes what the feature's rules admit.
    pub(crate) fn of(body: Body) -> Self {
        Self {
            name: String::new(),
            body,
            from: TakesFrom::Anything,
            facies: None,
            drawn: Vec::new(),
            level: None,
            fabric: None,
            slope: DVec2::ZERO,
            fraction: None,
        }
    }
}

/// A surface through the whole domain, with a unit above it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Base<'a> {
    /// Where it runs.
    pub(crate) surface: &'a HorizonSurface,
    /// Whether its unit takes from the open unit and what lies in it alone; otherwise from everything.
    pub(crate) is_onlapping: bool,
    /// In which reach about its tops it is changed (m), if it passes through them.
    pub(crate) honours: Option<f64>,
}

/// What bounds a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The domain's own base or top.
    Domain,
    /// The horizon that is this feature.
    Horizon(usize),
}

/// What a name is of a kind's volumes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VolumeName {
    /// A volume, or some of them, that can be left out.
    Volume,
    /// What the others of the same whole are divided from.
    First,
}

impl VolumeName {
    /// What a number is of volumes that are counted from 1.
    pub(crate) fn numbered(rest: &str, last: usize) -> Option<Self> {
        let number = rest.parse::<usize>().ok()?;
        let is_one = (1..=last).contains(&number) && number.to_string() == rest;
        is_one.then_some(Self::Volume)
    }
}

/// What became of an instance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome<'a> {
    /// The feature's id.
    pub(crate) feature: &'a str,
    /// The volume's name.
    pub(crate) name: &'a str,
    pub(crate) body: &'a Body,
}
