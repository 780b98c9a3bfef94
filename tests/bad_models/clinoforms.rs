//! Clinoforms of one's own.

use clinothem::model::Format;

use super::{Edit, check_edits};

const CLINOFORM: &str = include_str!("clinoform.toml");

/// The same for clinoforms along a crest.
#[rustfmt::skip]
const CLINOFORM_EDITS: &[Edit] = &[
    ("kind = \"clinoform\"", "kind = ▸\"clinofrom\"", &["no kind of feature \"clinofrom\"", "did you mean \"clinoform\"?"]),
    ("parent = \"base\"", "parent = ▸\"bass\"", &["has the parent \"bass\", which is not a feature", "did you mean \"base\"?"]),
    ("parent = \"base\"", "parent = \"base\"\ncount = ▸2", &["the count of feature \"delta\" is 2"]),
    ("parent = \"base\"", "parent = \"base\"\nremoves = ▸\"older\"", &["feature \"delta\" has `removes`, but clinoforms divide their parent", "leave it out"]),
    ("parent = \"base\"", "parent = \"base\"\ntop = ▸\"bade\"", &["has the top \"bade\", which is not a feature", "did you mean \"base\"?"]),
    ("parent = \"base\"", "parent = \"base\"\ntop = ▸\"base\"", &["has the top \"base\", which is its base, too"]),
    ("height = 15", "height = ▸0", &["the height of feature \"delta\" is 0; it must be above 0"]),
    ("crest = -5", "crest = ▸\"high\"", &["for the crest of feature \"delta\""]),
    ("length = 200\n", "", &["feature \"delta\" has no `length`", "length = 400"]),
    ("length = 200", "length = ▸{ normal = [200, 50] }", &["the distribution of the length of feature \"delta\" has no limit on one side", "truncate it with min"]),
    ("dip_deg = 8", "dip_deg = ▸85", &["the dip_deg of feature \"delta\" is 85", "at most at 80 degrees"]),
    ("dip_deg = 8", "▸dip = 8", &["unknown key `dip` in feature \"delta\"", "did you mean `dip_deg`?"]),
    ("toe = 0.3", "toe = ▸0.01", &["the toe of feature \"delta\" can be 0.01", "between 0.02", "or 0 where"]),
    ("toe = 0.3", "toe = ▸{ uniform = [0, 0.3] }", &["the toe of feature \"delta\" can be 0:", "at least 0.02"]),
    ("toe = 0.3", "toe = ▸-0.1", &["the toe of feature \"delta\" is -0.1", "between 0.02"]),
    ("trajectory = { kind = \"line\", from = [200, -50], to = [200, 850] }\n", "", &["feature \"delta\" has no `trajectory`", "kind = \"line\""]),
    ("basinward = \"right\"", "basinward = ▸\"east\"", &["\"east\" is not a side of the crest", "\"right\" or \"left\""]),
    ("sheets = 3", "sheets = ▸0", &["the number of sheets of feature \"delta\" is 0", "leave it out for one"]),
    ("spacing = 100\n", "", &["feature \"delta\" has no `spacing`", "spacing = 150"]),
    ("spacing = 100", "spacing = ▸-5", &["the spacing of feature \"delta\" is -5; it must be above 0"]),
    ("azimuth_deg = 90", "azimuth_deg = ▸400", &["the azimuth_deg of feature \"delta\" is 400"]),
    ("climb_deg = 0.5", "climb_deg = ▸60", &["the climb_deg of feature \"delta\" is 60", "between -45"]),
    ("[\"sand\", \"mud\"]", "▸\"sand\"", &["expected a list of facies for the clinothem_facies of feature \"delta\""]),
    ("[\"sand\", \"mud\"]", "[\"sand\", ▸\"mus\"]", &["no facies \"mus\"", "did you mean \"mud\"?"]),
    ("[\"sand\", \"mud\"]", "▸[]", &["expected a list of facies"]),
];

#[test]
fn broken_clinoforms_along_a_crest_are_refused() {
    check_edits(CLINOFORM_EDITS, CLINOFORM, "clinoform.toml", Format::Toml);
}
