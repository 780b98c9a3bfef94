//! Wells: keys that say nothing, surveys that make no path, files that are broken, laterals off their mother.

use std::path::Path;

use clinothem::model::{Defects, Format, Model, Source};

use super::{Edit, check_edits, edited};

const WELL: &str = include_str!("well.toml");

/// The keys that go with files, and are broken beside such a file.
pub(crate) const KEYS_OF_FILES: &[&str] = &["tops", "tvd", "tvdss"];

const FIRST: &str = "{ md = 0, inc_deg = 0, azi_deg = 0 },\n";

/// Finds this in the good file, puts that in its place, expects these words.
#[rustfmt::skip]
const EDITS: &[Edit] = &[
    ("{ reach = 300 }", "{ reach = ▸0 }", &["reach", "above 0"]),
    ("{ reach = 300 }", "▸{}", &["has no `reach`"]),
    ("{ reach = 300 }", "▸300", &["honours_tops"]),
    ("id = \"A-1\"\n", "", &["has no `id`"]),
    ("id = \"A-1\"", "id = ▸\"A 1\"", &["\"A 1\" is not an id", "letters, digits"]),
    ("id = \"A-2\"", "id = ▸\"A-1\"", &["two wells \"A-1\"", "another id"]),
    ("id = \"north\"", "id = ▸\"\"", &["is not an id"]),
    ("head = [100, 200]\ndatum", "head = ▸[100]\ndatum", &["head"]),
    ("head = [100, 200]\ndatum = 25", "datum = 25", &["nothing says where the well begins", "head = ["]),
    ("unit = \"m\"\nplan", "unit = ▸\"feet\"\nplan", &["unit \"feet\"", "\"ft\""]),
    ("plan_unit = \"m\"", "plan_unit = ▸\"km\"", &["unit \"km\""]),
    ("world = false", "world = ▸\"no\"", &["expected true or false"]),
    ("path = \"spline\"\nparametrization = \"centripetal\"", "path = ▸\"splin\"", &["path of well \"A-1\" is \"splin\"", "spline"]),
    ("parametrization = \"centripetal\"", "parametrization = ▸\"chord\"", &["parametrization", "chord-length"]),
    ("path = \"spline\"\nparametrization = \"centripetal\"", "path = \"minimum-curvature\"\nparametrization = ▸\"centripetal\"", &["its path is no spline"]),
    ("diameter = 0.2159", "diameter = ▸0", &["diameter", "above 0", "0.2159"]),
    ("[[700, 750], [800, 850]]", "[▸[750, 700], [800, 850]]", &["completion of well \"A-1\" from 750 to 700 is the wrong way round"]),
    ("[[700, 750], [800, 850]]", "[[700, 750], ▸[800, 950]]", &["not on well \"A-1\"", "900.00"]),
    ("[[700, 750], [800, 850]]", "[▸700]", &["expected [from, to]"]),
    ("[[700, 750], [800, 850]]", "▸7", &["expected a list of ranges", "completions"]),
    ("[[700, 780]]", "[▸[300, 780]]", &["not on lateral \"north\""]),
    ("at_md = 500", "at_md = ▸950", &["cannot leave well \"A-1\"", "950", "from 0 to 900"]),
    ("at_md = 500, ", "", &["has no `at_md`"]),
    ("{ id = \"north\", ", "{ id = \"north\", laterals = ▸7, ", &["expected a list of laterals for lateral \"north\" of well \"A-1\""]),
    ("{ id = \"north\", ", "{ id = \"north\", laterals = [{ id = \"deep\", at_md = ▸450, survey = [{ md = 700, inc_deg = 20, azi_deg = 30 }] }], ", &["lateral \"deep\" of lateral \"north\" of well \"A-1\" cannot leave lateral \"north\"", "from 500 to 800"]),
    ("laterals = [{ id", "laterals = 7 #", &["laterals"]),
    (FIRST, "{ md = 0, inc_deg = 0, azi_deg = 0, ▸azm = 0 },\n", &["unknown key `azm`", "azi_deg"]),
    (FIRST, "▸{ md = 0, inc_deg = 0 },\n", &["has no `azi_deg`"]),
    (FIRST, "{ md = ▸nan, inc_deg = 0, azi_deg = 0 },\n", &["md", "finite"]),
    (FIRST, "{ md = 0, inc_deg = ▸190, azi_deg = 0 },\n", &["inc_deg", "between 0 and 180"]),
    (FIRST, "{ md = 0, inc_deg = 0, azi_deg = 0, x = ▸3 },\n", &["has a `x`", "of one kind"]),
    ("{ md = 400, inc_deg = 0, azi_deg = 45 }", "▸{ x = 1, y = 2, z = 3 }", &["another kind than the first"]),
    ("{ md = 400, inc_deg = 0, azi_deg = 45 },\n  {", "{ md = 600, inc_deg = 0, azi_deg = 45 },\n  ▸{", &["not below", "600"]),
    ("{ md = 600, inc_deg = 40, azi_deg = 45 }", "▸{ md = 600, inc_deg = 180, azi_deg = 45 }", &["turns by 180.0°", "inclination and azimuth"]),
    ("{ azi_deg = 90, dip_deg = 90, distance = 300 }", "▸{ azi_deg = 90, dip_deg = 90, distance = 0 }", &["distance", "above 0"]),
    ("dip_deg = 60", "dip_deg = ▸100", &["dip_deg", "between -90 and 90"]),
    ("{ x = 150, y = 210, z = -400 }", "▸{ x = 100, y = 200, z = 0 }", &["at one place"]),
    (", { x = 150, y = 210, z = -400 }, { x = 300, y = 230, z = -700 }", "", &["needs two", "two stations"]),
    ("survey = [{ x = 100, y = 200, z = 0 }, { x = 150, y = 210, z = -400 }, { x = 300, y = 230, z = -700 }]", "survey = ▸[]", &["no stations", "two at least"]),
    ("survey = [{ x = 100, y = 200, z = 0 }, { x = 150, y = 210, z = -400 }, { x = 300, y = 230, z = -700 }]", "survey = ▸3", &["survey", "a file"]),
    ("survey = [{ x = 100, y = 200, z = 0 }, { x = 150, y = 210, z = -400 }, { x = 300, y = 230, z = -700 }]", "", &["has no `survey`"]),
    ("survey = [{ x", "path = \"minimum-curvature\"\nsurvey = ▸[{ x", &["no direction", "path = \"spline\""]),
    ("survey = [{ md = 560, inc_deg = 20, azi_deg = 30 }, { md = 800, inc_deg = 60, azi_deg = 0 }]", "survey = ▸[{ md = 400, inc_deg = 20, azi_deg = 30 }]", &["no station below the junction", "go on from"]),
];

#[test]
fn broken_wells_are_refused_with_place_and_remedy() {
    check_edits(EDITS, WELL, "well.toml", Format::Toml);
}

#[test]
fn all_defects_of_all_wells_are_told_at_once() {
    let text = WELL
        .replace("unit = \"m\"\nplan", "unit = \"feet\"\nplan")
        .replace("distance = 300", "distance = 0")
        .replace("z = -400", "zz = -400")
        .replace("at_md = 500", "at_md = \"there\"");
    let defects = super::refused("well.toml", &text, Format::Toml);
    assert_eq!(defects.iter().count(), 5, "{defects}");
}

const OF_FILE: &str = r#"
name = "Survey"
origin = [456000, 6782000]
[domain]
x = [0, 1000]
y = [0, 1000]
z = [-1000, 0]
facies = "mud"
[facies.mud]
[[well]]
id = "A"
head = [100, 200]
survey = { file = "a.csv" }
"#;

const GOOD: &str = "MD,INC,AZI\n0,0,0\n300,0,10\n600,30,20\n900,60,20\n";

fn check(model: &str, file: &str) -> Result<Model, Defects> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.csv"), file).unwrap();
    let path: &Path = folder.path();
    Model::check(&Source::from_text("survey.toml", model, Format::Toml).in_folder(path))
}

fn said(model: &str, file: &str) -> (Defects, String) {
    let defects = check(model, file).expect_err(model);
    let words: Vec<&str> = defects
        .iter()
        .flat_map(|defect| [defect.message(), defect.remedy()])
        .collect();
    let words = words.join("\n");
    (defects, words)
}

#[test]
fn broken_keys_of_files_of_surveys_are_told_where_they_stand() {
    check(OF_FILE, GOOD).unwrap();
    let cases: [(&str, &str, &[&str]); 7] = [
        ("\"a.csv\"", "▸\"b.csv\"", &["there is no such file"]),
        ("\"a.csv\"", "▸7", &["expected text"]),
        (
            "{ file = \"a.csv\" }",
            "▸{ format = \"csv\" }",
            &["has no `file`"],
        ),
        (
            "\"a.csv\"",
            "\"a.csv\", format = ▸\"xls\"",
            &["no format \"xls\" of surveys"],
        ),
        (
            "\"a.csv\"",
            "\"a.csv\", columns = { tvd = ▸1.5, tvdss = \"SS\" }",
            &["column's name or number"],
        ),
        (
            "\"a.csv\"",
            "\"a.csv\", columns = { ▸depth = \"MD\" }",
            &["unknown key `depth`"],
        ),
        (
            "\"a.csv\"",
            "▸\"a.csv\", columns = { md = \"DEPTH\" }",
            &["no column is \"DEPTH\"", "MD, INC, AZI"],
        ),
    ];
    for (find, replace, words) in cases {
        let (text, place) = edited(OF_FILE, find, replace);
        let (defects, all) = said(&text, GOOD);
        for word in words {
            assert!(all.contains(word), "{replace}: {all}");
        }
        let own = defects.iter().next().unwrap().place();
        assert_eq!(place, Some((own.line, own.column)), "{all}");
    }
}

#[test]
fn broken_files_of_surveys_are_refused_by_line_and_cuts_anywhere_are_refused_or_read() {
    for (file, words) in [
        ("", "the file is empty"),
        ("MD,INC,AZI\n", "no row"),
        (
            "MD,INC,AZI\n0,0,0\n300,x,10\n",
            "line 3: \"x\" is no number",
        ),
        ("MD,INC,AZI\n0,0,0\n300,0\n", "line 3 has 2 of 3 columns"),
        ("MD,INC,AZI\n0,0,0\n300,0,0\n200,0,0\n", "line 4"),
        ("MD,INC,AZI\n0,0,0\n300,181,0\n", "line 3"),
        ("MD,INC\n0,0\n", "makes no survey"),
        ("a,b,c\n0,0,0\n", "none of its columns"),
        ("MD,INC,AZI\n0,0,0\n", "needs two"),
        ("~V\n~C\nDEPT.M:\n", "~ASCII"),
        ("# WELL\n", "names"),
        ("\0\0", "no text"),
    ] {
        let (_, all) = said(OF_FILE, file);
        assert!(all.contains(words), "{file:?}: {all}");
    }
    for end in 0..GOOD.len() {
        drop(check(OF_FILE, &GOOD[..end]));
    }
}

#[test]
fn what_is_right_and_probably_not_meant_is_noted() {
    for (model, file, words) in [
        (
            OF_FILE.to_owned(),
            GOOD.replace("\n0,0,0", ""),
            "begins at a measured depth of 300.00 m",
        ),
        (
            OF_FILE.to_owned(),
            GOOD.replace("600,30,20", "330,30,20"),
            "turns by 30.0° for each 30 m",
        ),
        (
            OF_FILE.replace("[100, 200]", "[456100, 6782200]"),
            GOOD.to_owned(),
            "write world = true",
        ),
        (
            OF_FILE.replace("[100, 200]", "[100, 9000]"),
            GOOD.to_owned(),
            "beside the domain",
        ),
        (
            OF_FILE.to_owned(),
            GOOD.replace("600,30,20", "600,,20"),
            "1 of its rows have values missing",
        ),
        (
            OF_FILE.to_owned(),
            GOOD.replace("AZI", "AZIM_TN"),
            "true north",
        ),
        (
            OF_FILE.replace("head = [100, 200]\n", "world = false\n"),
            "X,Y,Z,TVD\n10,10,0,0\n10,20,-300,310\n".to_owned(),
            "differ from its datum",
        ),
    ] {
        let checked = check(&model, &file).unwrap();
        let notes: Vec<&str> = checked
            .notes
            .iter()
            .map(|note| note.message.as_str())
            .collect();
        assert!(
            notes.iter().any(|note| note.contains(words)),
            "{words}: {notes:?}"
        );
    }
}

#[test]
fn tops_of_unknown_wells_and_horizons_or_off_their_well_are_told_all_at_once_by_line() {
    let model = format!("tops = \"tops.csv\"\n{WELL}");
    let folder = tempfile::tempdir().unwrap();
    let read = |tops: &str| {
        std::fs::write(folder.path().join("tops.csv"), tops).unwrap();
        Model::check(
            &Source::from_text("tops.toml", model.as_str(), Format::Toml).in_folder(folder.path()),
        )
    };
    let good = read("well,horizon,md\nA-1,top,540\nA-1/north,top,560\n").unwrap();
    assert_eq!(good.tops.len(), 2);
    let defects = read("well,horizon,md\nB-1,top,540\nA-1,topp,540\nA-1,top,5400\n")
        .unwrap_err()
        .to_string();
    for words in [
        "line 2: there is no well \"B-1\"",
        "line 3: there is no horizon \"topp\"",
        "did you mean \"top\"?",
        "line 4: a measured depth of 5400 m",
    ] {
        assert!(defects.contains(words), "{words}: {defects}");
    }
    assert!(
        read("well,md\n")
            .unwrap_err()
            .to_string()
            .contains("no column of the horizon")
    );
}
