//! Channels.

use super::feature::Draft;
use super::quantity::{ANY, ASYMMETRY, BANK_ANGLE, Limits, POSITIVE, profile};
use super::{Checker, Reported};
use crate::model::file::ChannelFile;
use crate::model::profile::Profile;
use crate::model::read::{Any, Field};
use crate::model::spec::{ChannelSpec, Domain, SectionOrigin};
use crate::model::tree::{NodeId, quoted};

const DEFAULT_ANGLE_LIMIT_DEG: f64 = 15.0;
const DEFAULT_TOLERANCE_FRACTION: f64 = 0.01;
/// Below these sections are so dense that nothing is gained, and surfaces take gigabytes.
const LEAST_ANGLE_LIMIT_DEG: f64 = 0.1;
const LEAST_TOLERANCE_FRACTION: f64 = 1e-5;

impl Checker<'_> {
    pub(super) fn channel(
        &mut self,
        draft: &Draft,
        domain: Option<&Domain>,
    ) -> Option<ChannelSpec> {
        let file: ChannelFile = self.reader.table(draft.node)?;
        let width = self.required(file.width, draft, "width", "width = 50", POSITIVE);
        let depth = self.required(file.depth, draft, "depth", "depth = 5", POSITIVE);
        if let (Some((node, depth)), Some(domain)) = (&depth, domain) {
            self.check_depth(*node, depth, draft, domain);
        }
        let asymmetry = self.optional(file.asymmetry, draft, "asymmetry", ASYMMETRY);
        let left = self.optional(file.left_angle_deg, draft, "left_angle_deg", BANK_ANGLE);
        let right = self.optional(file.right_angle_deg, draft, "right_angle_deg", BANK_ANGLE);
        let top = self.optional(file.top, draft, "top", ANY);
        if let (Ok(Some((node, top))), Some(domain)) = (&top, domain) {
            self.note_top(*node, top, draft, domain);
        }
        let origin = match file.origin {
            None => Some(SectionOrigin::Thalweg),
            Some(field) => field
                .good()
                .and_then(|(node, word)| self.section_origin(node, &word)),
        };
        let example = "trajectory = { kind = \"line\", azimuth_deg = 45 }";
        let trajectory = self
            .reader
            .need(
                file.trajectory,
                draft.node,
                &draft.name,
                "trajectory",
                example,
            )
            .and_then(|(node, Any)| Some((node, self.trajectory(node, draft)?)));
        if let (Some((node, trajectory)), Some(domain)) = (&trajectory, domain) {
            self.note_far_trajectory(*node, trajectory, &draft.name, domain);
        }
        let angle = self.number_in(
            file.angle_limit_deg,
            DEFAULT_ANGLE_LIMIT_DEG,
            [LEAST_ANGLE_LIMIT_DEG, 90.0],
            "angle limit",
        );
        let tolerance = self.number_in(
            file.tolerance_fraction,
            DEFAULT_TOLERANCE_FRACTION,
            [LEAST_TOLERANCE_FRACTION, 0.5],
            "tolerance",
        );
        let plain = |found: Option<(NodeId, Profile)>| found.map(|(_, profile)| profile);
        Some(ChannelSpec {
            width: plain(width)?,
            depth: plain(depth)?,
            asymmetry: plain(asymmetry.ok()?).unwrap_or(Profile::from(0.0)),
            left_angle_deg: plain(left.ok()?),
            right_angle_deg: plain(right.ok()?),
            top: plain(top.ok()?),
            origin: origin?,
            trajectory: trajectory?.1,
            angle_limit_deg: angle?,
            tolerance_fraction: tolerance?,
        })
    }

    fn required(
        &self,
        field: Field<Any>,
        draft: &Draft,
        key: &str,
        example: &str,
        limits: Limits,
    ) -> Option<(NodeId, Profile)> {
        let (node, Any) = self
            .reader
            .need(field, draft.node, &draft.name, key, example)?;
        let what = format!("the {key} of {}", draft.name);
        profile(&self.reader, node, &what, limits).map(|profile| (node, profile))
    }

    /// `None` where it is left out.
    fn optional(
        &self,
        field: Option<Field<Any>>,
        draft: &Draft,
        key: &str,
        limits: Limits,
    ) -> Result<Option<(NodeId, Profile)>, Reported> {
        match field {
            None => Ok(None),
            Some(field) => self
                .required(field, draft, key, "", limits)
                .map(Some)
                .ok_or(Reported),
        }
    }

    fn number_in(
        &self,
        field: Option<Field<f64>>,
        default: f64,
        [least, largest]: [f64; 2],
        what: &str,
    ) -> Option<f64> {
        let Some(field) = field else {
            return Some(default);
        };
        let (node, value) = field.good()?;
        if value >= least && value <= largest {
            return Some(value);
        }
        self.reader.wrong(
            node,
            format!("the {what} is {value}; it must lie between {least} and {largest}"),
            format!("leave it out for the usual {default}"),
        );
        None
    }

    fn section_origin(&self, node: NodeId, word: &str) -> Option<SectionOrigin> {
        match word {
            "thalweg" => Some(SectionOrigin::Thalweg),
            "top-centre" => Some(SectionOrigin::TopCentre),
            _ => {
                self.reader.wrong(
                    node,
                    format!("{} is not a point of a channel's section", quoted(word)),
                    "write \"thalweg\" or \"top-centre\"",
                );
                None
            }
        }
    }

    fn check_depth(&self, node: NodeId, depth: &Profile, draft: &Draft, domain: &Domain) {
        let [_, _, height] = domain.size();
        if let Some(depth) = depth.constant()
            && depth > height
        {
            self.reader.wrong(
                node,
                format!(
                    "the depth of {} is {depth}, more than the domain's height of {height}",
                    draft.name
                ),
                "make the channel shallower, or the domain's z range larger",
            );
        }
    }

    fn note_top(&mut self, node: NodeId, top: &Profile, draft: &Draft, domain: &Domain) {
        let [base, roof] = domain.z;
        if let Some(top) = top.constant()
            && top <= base
        {
            self.note(
                node,
                format!(
                    "{} lies below the domain, whose base is at {base}, so it has no volume",
                    draft.name
                ),
            );
        } else if let Some(top) = top.constant()
            && top > roof
        {
            self.note(
                node,
                format!(
                    "the top of {} at {top} is above the domain's at {roof}, which cuts it off",
                    draft.name
                ),
            );
        }
    }
}
