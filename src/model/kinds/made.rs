//! Where one instance is made, and what it is.

use std::sync::Arc;

use crate::features::body::Body;
use crate::features::horizon::Horizon;
use crate::features::reach::Reach;
use crate::model::domain::Domain;
use crate::model::draws::Reason;
use crate::model::interior::Interior;
use crate::model::values::surface::HorizonSurface;

/// Where one instance is made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site<'a> {
    /// The block that is modelled.
    pub(crate) domain: &'a Domain,
    /// What the parent holds, for kinds that ask for it.
    pub(crate) interior: Option<&'a Interior>,
    /// Of a base: its surface, as decided among all of them, and what was drawn for it.
    pub(crate) surface: Option<(&'a Horizon, &'a [(String, f64)])>,
    /// What it is placed by: the parent's frame, or that of the domain.
    pub(crate) frame: &'a Frame,
    /// What bounds its unit above, for kinds that ask for it.
    pub(crate) top: Option<&'a Horizon>,
    /// How far it moves so that contacts which coincide are decided by age (m): less than nothing, and less for younger
    /// ones of the kind; 0 if they are not.
    pub(crate) nudge: f64,
}

impl Site<'_> {
    /// The channel that it lies in.
    pub(crate) fn reach(&self) -> Result<&Reach, Reason> {
        match self.frame {
            Frame::Along(reach) => Ok(reach),
            Frame::None | Frame::Unit(_) => {
                let message = "its parent is no channel with a floor and a top between rims";
                Err(("no channel", message.to_owned()))
            }
        }
    }
}

/// One instance: the volumes that it makes, in order of evaluation, and what its children are placed by.
#[derive(Clone, Debug)]
pub(crate) struct Made {
    pub(crate) parts: Vec<Part>,
    pub(crate) frame: Frame,
    /// What was decided about it, to go on after its name.
    pub(crate) decisions: Vec<String>,
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
    /// An instance that is one body, and takes what the feature's rules admit.
    pub(crate) fn body(body: Body, drawn: Vec<(String, f64)>) -> Self {
        Self {
            parts: vec![Part {
                drawn,
                ..Part::of(body)
            }],
            frame: Frame::None,
            decisions: Vec::new(),
        }
    }
}

impl Part {
    /// The only volume of an instance, which takes what the feature's rules admit.
    pub(crate) fn of(body: Body) -> Self {
        Self {
            name: String::new(),
            body,
            from: TakesFrom::Anything,
            facies: None,
            drawn: Vec::new(),
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

/// What became of an instance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome<'a> {
    /// The feature's id.
    pub(crate) feature: &'a str,
    /// The volume's name.
    pub(crate) name: &'a str,
    pub(crate) body: &'a Body,
}
