//! The domain: the block that is modelled.

use crate::model::checker::{Checker, Extent};
use crate::model::domain::Domain;
use crate::model::file::DomainFile;
use crate::model::read::{Any, Field};
use crate::model::tree::NodeId;
use crate::model::values::facies::FaciesList;

/// A domain thinner than this is a slip, not a model, in metres.
const THINNEST: f64 = 1e-3;

impl Checker<'_> {
    pub(super) fn domain(
        &mut self,
        field: Field<Any>,
        root: NodeId,
        facies: &FaciesList,
    ) -> Option<Domain> {
        let example =
            "a table [domain] with x = [0, 1000], y = [0, 1000], z = [-60, 0], facies = \"mud\"";
        let (table, Any) = self
            .reader
            .need(field, root, "the model", "domain", example)?;
        let file: DomainFile = self.reader.table(table)?;
        self.reader.close(table, "the domain");
        let x = self.range(file.x, table, "x", "x = [0, 1000]");
        let y = self.range(file.y, table, "y", "y = [0, 1000]");
        let z = self.range(file.z, table, "z", "z = [-60, 0]");
        let extent = Extent { x, y, z };
        let base = self.bounding_surface(file.base, "base", extent);
        let top = self.bounding_surface(file.top, "top", extent);
        if let (Ok(base), Ok(top)) = (&base, &top) {
            self.check_order(base.as_ref(), top.as_ref());
        }
        let least_thickness = self.least_thickness(file.least_thickness, extent);
        let example = "facies = \"mud\"";
        let named = self
            .reader
            .need(file.facies, table, "the domain", "facies", example);
        let facies = named.and_then(|(node, name)| self.known_facies(node, &name, facies));
        Some(Domain {
            x: x?,
            y: y?,
            z: z?,
            base: base.ok()?.map(|(_, surface)| surface),
            top: top.ok()?.map(|(_, surface)| surface),
            least_thickness: least_thickness?,
            facies: facies?,
        })
    }

    /// Below which thickness a bed is absent.
    fn least_thickness(&self, field: Option<Field<f64>>, extent: Extent) -> Option<f64> {
        let size = [extent.x, extent.y, extent.z].map(|range| range.map(|[low, high]| high - low));
        let Some(field) = field else {
            let squares = size.map(|length| length.map(|length| length * length));
            return Some(
                Domain::LEAST_THICKNESS * (squares[0]? + squares[1]? + squares[2]?).sqrt(),
            );
        };
        let (node, least) = field.good()?;
        let height = size[2].unwrap_or(f64::INFINITY);
        if (0.0..height).contains(&least) {
            return Some(least);
        }
        self.reader.wrong(
            node,
            format!("the `least_thickness` of the domain is {least} m; it must not be below 0, and be less than the domain's height"),
            "write the thickness in metres below which a bed is absent, such as 0.05; leave it out for next to nothing",
        );
        None
    }

    fn range(
        &self,
        field: Field<[f64; 2]>,
        table: NodeId,
        axis: &str,
        example: &str,
    ) -> Option<[f64; 2]> {
        let (node, [low, high]) = self
            .reader
            .need(field, table, "the domain", axis, example)?;
        if high - low >= THINNEST {
            return Some([low, high]);
        }
        let remedy = match axis {
            "z" => "write [base, top]; z points up, so depths are negative: z = [-60, 0]",
            _ => "write [smaller, larger]",
        };
        let what = format!("the domain's `{axis}`");
        self.no_range(node, &what, [low, high], remedy);
        None
    }
}
