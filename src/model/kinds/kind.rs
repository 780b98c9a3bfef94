//! What every kind of feature is.

use schemars::{Schema, SchemaGenerator};

use super::keys::Keys;
use super::made::{Base, Bound, Made, Outcome, Site, VolumeName};
use crate::model::draws::{Draws, Reason};
use crate::model::nature::{Gives, Nature};
use crate::model::references::Reference;

/// A kind of feature: how its table is read, and what one instance of it is.
pub(crate) trait Kind: Sized {
    /// What is known of it before its table is read.
    const NATURE: Nature;

    /// What features that refer to it find in what was made of it.
    const GIVES: Gives = Gives::Nothing;

    /// Whether it is bodies that may conform to a surface.
    const CONFORMS: bool = false;

    /// Its table, for editors.
    fn schema(generator: &mut SchemaGenerator) -> Schema;

    /// Reads and checks its table; `None`, with a defect, if something is wrong.
    fn read(keys: &mut Keys<'_, '_>) -> Option<Self>;

    /// Draws and builds one instance.
    fn make(&self, site: &Site<'_>, draws: &mut Draws<'_>) -> Result<Made, Reason>;

    /// The facies that its table names besides `facies`.
    fn more_facies(&self) -> Vec<usize> {
        Vec::new()
    }

    /// The surface through the whole domain that it brings: it is drawn before anything is made.
    fn base(&self) -> Option<Base<'_>> {
        None
    }

    /// What bounds the unit above that it wants; its site has the unit then.
    fn top(&self) -> Option<Bound> {
        None
    }

    /// What it refers to; its site has what was made of that.
    fn refers(&self) -> Vec<&Reference> {
        Vec::new()
    }

    /// Whether it is placed by what its parent holds; its site has that then.
    fn wants_interior(&self) -> bool {
        false
    }

    /// What this is of the kind's volumes, of which there are several: what follows the feature's id and a dash.
    fn volume_name(&self, rest: &str) -> Option<VolumeName> {
        let _ = rest;
        None
    }

    /// What is to be said of instances of the kind when they are meshed.
    fn meshing(made: &[Outcome<'_>]) -> Option<String> {
        let _ = made;
        None
    }
}
