//! Models to start from: the committed ones, as `clinothem new` copies them.

/// A model that can be copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Template {
    /// What it is called.
    pub name: &'static str,
    /// What it shows, in a few words.
    pub about: &'static str,
    /// The model file.
    pub text: &'static str,
}

/// The models to start from, the simplest first.
pub const TEMPLATES: [Template; 5] = [
    Template {
        name: "quickstart",
        about: "two channels in mud, the younger one meandering",
        text: include_str!("../../models/quickstart/quickstart.toml"),
    },
    Template {
        name: "channel-belt",
        about: "20 sinuous channel sandbodies drawn from distributions",
        text: include_str!("../../models/channel-belt/channel-belt.toml"),
    },
    Template {
        name: "isochores",
        about: "beds given by their thickness above an older horizon, two of which end",
        text: include_str!("../../models/isochores/isochores.toml"),
    },
    Template {
        name: "parasequence",
        about: "two shoreface parasequences: clinoforms, and facies belts between them",
        text: include_str!("../../models/parasequence/parasequence.toml"),
    },
    Template {
        name: "coastal",
        about: "both of these parasequences above the channels of a coastal plain",
        text: include_str!("../../models/coastal/coastal.toml"),
    },
];

impl Template {
    /// The template of that name.
    pub fn find(name: &str) -> Option<&'static Self> {
        TEMPLATES.iter().find(|template| template.name == name)
    }
}
