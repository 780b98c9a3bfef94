//! Models to start from: the committed ones, as `clinothem new` copies them.

use super::suggest;

/// A model that can be copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Template {
    /// What it is called: its folder in `models`, and its own name where that is another one.
    pub name: &'static str,
    /// What it shows, in a few words.
    pub about: &'static str,
    /// The model file.
    pub text: &'static str,
    /// Files that stand beside it and that it reads: their names, and what they hold.
    pub data: &'static [(&'static str, &'static str)],
}

/// Templates of one folder each, or of several files in one, with the files that they read and what they show.
macro_rules! templates {
    ($($folder:literal $(/ $file:literal)? $(with [$($data:literal),+])?: $about:literal,)+) => {
        &[$(Template {
            data: &[$($(($data, include_str!(concat!("../../models/", $folder, "/", $data)))),+)?],
            ..templates!(@one $folder $($file)?, $about)
        }),+]
    };
    (@one $name:literal, $about:literal) => {
        Template {
            name: $name,
            about: $about,
            text: include_str!(concat!("../../models/", $name, "/", $name, ".toml")),
            data: &[],
        }
    };
    (@one $folder:literal $file:literal, $about:literal) => {
        Template {
            name: concat!($folder, "/", $file),
            about: $about,
            text: include_str!(concat!("../../models/", $folder, "/", $file, ".toml")),
            data: &[],
        }
    };
}

/// The models to start from, the simplest first, those of one concern together.
#[rustfmt::skip]
pub const TEMPLATES: &[Template] = templates! {
    "quickstart": "two channels in mud, the younger one meandering",
    "channel-belt": "20 sinuous channel sandbodies drawn from distributions",
    "isochores": "beds given by their thickness above an older horizon, two of which end",
    "parasequence": "two shoreface parasequences: clinoforms, and facies belts between them",
    "coastal": "both of these parasequences above the channels of a coastal plain",
    "case-study": "channels with lags and point bars below two parasequences of one definition, for ensembles",

    "wandering": "trajectories and sections of every kind",
    "fig06a-channel": "a channel through points, its width and depth changing on the way",
    "sections": "sections of one's own: straight pieces, arcs, terraces, a closed pipe",
    "lags": "gravel on the floor of channels",
    "fig08a-point-bars": "a lag, and accretion surfaces at each inner bend",
    "plugs": "mud in abandoned channels and bends",
    "levees": "a meandering channel with levees, crevasse splays and a lag",
    "meander-belt": "a channel that migrates and leaves its scrolls",
    "channel-complex": "three rivers with tributaries, levees, splays, lags, point bars and plugs",
    "trends": "a channel that fines upwards and a bed that coarsens, in layers",

    "nodules": "cemented nodules in and beside channel sands",
    "lobes": "turbidite lobes that fill each other's hollows",
    "lobes" / "lobe": "one lobe on a level floor, and a mouth bar cut into it",
    "mouth-bars": "two distributaries, each with a mouth bar where it ends",
    "fig06b-scour": "two scours with pits and wings, one along a bend",
    "fig06b-scour" / "scour-field": "twelve scours of random sizes, places and directions",
    "fig09-warp": "a scour down a clinoform, and concretions at a depth below one",

    "parallel-fold": "five beds of constant thickness in a recumbent fold",

    "clinoforms": "six clinoforms of one set, with facies belts",
    "fig06c-clinoforms": "clinoforms of one template along a winding crest",
    "fig08b-facies": "belts that end on the clinoforms below and above them",
    "strata" / "bounds": "a curved top and a dipping base of the domain, erosion and onlap",
    "strata" / "points": "a horizon from scattered points, as picks in wells",
    "strata" / "undulating": "clinoform sets between surfaces that undulate",
    "from-files" with [
        "base.asc", "coal.xyz", "lower.irap", "middle.cps3", "sand-base.zmap", "sand-top.zmap", "top.csv", "upper.ts"
    ]: "every surface from a file: seven formats, depths, feet, noise, a hole",
    "salt" with ["salt.step", "cavern.brep"]: "a salt dome from a CAD program that pierces beds, with a cavern in it",
    "field" with [
        "base.asc", "coal-measures.zmap", "f-1.csv", "f-2.las", "lower-sand.irap", "marine-shale.irap", "p-1.dev", "p-2.dev", "p-3.dev",
        "top.csv", "tops.csv", "unconformity.ts", "upper-sand.cps3"
    ]: "a tilted block below an unconformity: horizons, wells and tops from files, horizons brought to the tops",
    "fig03-degrees": "a surface from a control net of degree 1, 2 or 3, with weights",
    "fig07-join": "a surface from three control nets of different degrees that join",

    "fig10a-recumbent-fold": "beds in a recumbent fold, cut by a younger thrust",
    "fig10b-conjugate-faults": "two normal faults that cross, through beds and a channel, and what seals them",
    "fig10c-listric-growth": "a listric fault that slips three times, with rollover and growth strata",
    "fault-zone": "a core of gouge in damaged rock along a fault",

    "fig02-wells" with ["a-3.dev", "a-4.csv"]: "five wells and a lateral from one site, through the coastal model",

    "fig01-grid-or-surface": "sparse channels, of whose connectivity grids are wrong",

    "rock": "properties drawn for each volume, permeabilities along its layers",

    "rules" / "removes": "`removes` as a list: by id, kind, level and facies",
    "rules" / "protected": "`removed_by` and `preserve`: who keeps what it has",
    "rules" / "nested": "children of children, levels, and what is switched off",
    "rules" / "distributions": "every distribution, each in a quantity of its own",

    "flush-tops": "tops that lie exactly on each other and on the domain's",
    "contacts" / "end-caps": "channels that end inside the domain",
    "contacts" / "overhang": "banks that overhang",
    "contacts" / "level-tops": "three tops on one level",
    "contacts" / "inside": "a body in a body in a body",
    "contacts" / "apart": "bodies that touch nothing",
    "contacts" / "pieces": "a body in pieces",
    "contacts" / "removed": "bodies of which nothing is left",
    "far" / "channels": "channels and nodules in world coordinates",
    "far" / "strata": "a basin of 300 km by 200 km in world coordinates",
};

impl Template {
    /// The template of that name; else what to write in its place.
    pub fn find(name: &str) -> Result<&'static Self, String> {
        let found = TEMPLATES.iter().find(|template| template.name == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = TEMPLATES.iter().map(|template| template.name).collect();
            match suggest::nearest(name, &names) {
                Some(known) => format!("did you mean `{known}`?"),
                None => "`clinothem new` without a name lists them".to_owned(),
            }
        })
    }

    /// The name of its file, without its folder.
    pub fn file_name(&self) -> String {
        let name = self.name.rsplit('/').next().unwrap_or(self.name);
        format!("{name}.toml")
    }
}
