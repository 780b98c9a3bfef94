//! Files: what cannot be read, what is no model, JSON, bombs, and any change of a few characters.

use clinothem::model::{Format, LARGEST_FILE, Model, ReadError, Source};

use super::{Edit, JSON, TOML, check_edits, refused};

/// The same for JSON.
#[rustfmt::skip]
const JSON_EDITS: &[Edit] = &[
    ("\"name\": \"Test\",", "\"name\": \"Test\"", &["not valid JSON"]),
    ("\"count\": 3,", "// three\n \"count\": 3,", &["not valid JSON", "Comments are not allowed"]),
    ("\"azimuth_deg\": 45 }", "\"azimuth_deg\": 45, }", &["not valid JSON"]),
    ("\"count\": 3,", "\"count\": 3, ▸\"count\": 4,", &["the key `count` is given twice"]),
    ("\"count\": 3,", "\"count\": ▸null,", &["`feature.channel.count`", "found null", "leave the key out"]),
    ("\"mud\": {", "\"mud\": { \"permeability\": ▸null,", &["`facies.mud.permeability`: expected a value, found null", "leave the key out"]),
    ("\"width\": 50,", "\"width\": ▸null,", &["found null", "leave the key out"]),
    ("\"width\": 50,", "\"width\": ▸1e999,", &["inf is not a finite number"]),
    ("18446744073709551615", "▸18446744073709551616", &["is not between 0 and 18446744073709551615"]),
    ("\"width\": 50,", "▸\"widht\": 50,", &["unknown key `widht`", "did you mean `width`?"]),
    ("[2, 5]", "▸[5, 2]", &["minimum 5 of a uniform distribution is not below its maximum 2"]),
    ("\"facies\": \"mud\"", "\"facies\": ▸[\"mud\"]", &["`domain.facies`: expected text, found a list of 1"]),
    ("\"kind\": \"line\"", "\"kind\": ▸\"circle\"", &["no kind of trajectory \"circle\""]),
];

#[test]
fn every_broken_json_file_is_refused_with_place_value_and_remedy() {
    check_edits(JSON_EDITS, JSON, "model.json", Format::Json);
}

#[test]
fn files_without_a_model_are_refused() {
    for (text, format, words) in [
        ("", Format::Toml, "the file is empty"),
        (" \n\t\n", Format::Json, "the file is empty"),
        (
            "# only a comment\n",
            Format::Toml,
            "the model has no `name`",
        ),
        ("[]", Format::Json, "expected a table, found an empty list"),
        ("7", Format::Json, "expected a table, found the number 7"),
        ("null", Format::Json, "expected a table, found null"),
        ("{} {}", Format::Json, "more than one JSON value"),
        ("{", Format::Json, "not valid JSON"),
        ("\u{0007}\u{001b}[31m = 1", Format::Toml, "not valid TOML"),
    ] {
        let defects = refused("none", text, format);
        assert!(defects.to_string().contains(words), "{text:?}: {defects}");
    }
}

#[test]
fn tables_of_the_wrong_shape_are_explained() {
    let single = TOML.replace("[[feature]]\nid = \"second\"", "[feature]\nid = \"second\"");
    let single = single.replace("[[feature]]\nid = \"channel\"", "[other]\nid = \"channel\"");
    let defects = refused("single.toml", &single, Format::Toml);
    assert!(
        defects
            .to_string()
            .contains("[[feature]], with double brackets"),
        "{defects}"
    );

    let no_facies = "name = \"x\"\nfacies = 3\nfeature = [1]\n[domain]\nx = [0, 1]\ny = [0, 1]\nz = [0, 1]\nfacies = \"a\"";
    let shown = refused("x.toml", no_facies, Format::Toml).to_string();
    assert!(
        shown.contains("expected a table of facies, found the number 3"),
        "{shown}"
    );
    assert!(
        shown.contains("`feature.1`: expected a table, found the number 1"),
        "{shown}"
    );
}

#[test]
fn nesting_bombs_are_refused_quickly() {
    let deep = 1_000_000;
    for (text, format) in [
        (format!("x = {}", "[".repeat(deep)), Format::Toml),
        (
            format!("x = {}{}", "[".repeat(60), "]".repeat(60)),
            Format::Toml,
        ),
        (
            format!("x = {}1{}", "{a=".repeat(deep), "}".repeat(deep)),
            Format::Toml,
        ),
        (format!("{}a = 1", "a.".repeat(deep)), Format::Toml),
        (format!("[{}a]", "a.".repeat(deep)), Format::Toml),
        (
            format!("{}{}", "[".repeat(deep), "]".repeat(deep)),
            Format::Json,
        ),
        (
            format!("{}1{}", "{\"a\":".repeat(deep), "}".repeat(deep)),
            Format::Json,
        ),
        (
            format!("{}{}", "[".repeat(300), "]".repeat(300)),
            Format::Json,
        ),
        (
            TOML.replace(
                "width = 50",
                &format!("width = {{ expression = \"{}s\" }}", "(".repeat(deep)),
            ),
            Format::Toml,
        ),
        (
            TOML.replace(
                "width = 50",
                &format!("width = {{ expression = \"{}s\" }}", "-".repeat(900)),
            ),
            Format::Toml,
        ),
    ] {
        let defects = refused("bomb", &text, format);
        assert!(defects.render(false).len() < 100_000);
    }
}

#[test]
fn very_many_defects_are_counted_and_the_first_are_listed() {
    let broken = |i: usize| {
        format!(
            "[[feature]]\nid = \"f{i}\"\nkind = \"chanel\"\nparent = \"nobody{i}\"\nremoves = [\"x{i}\"]\n"
        )
    };
    let features: Vec<String> = (0..9_000).map(broken).collect();
    let text = format!("{TOML}{}", features.concat());
    let defects = refused("many.toml", &text, Format::Toml);
    assert!(defects.count() >= 27_000, "{}", defects.count());
    assert_eq!(defects.iter().count(), 200);

    let keys: Vec<String> = (0..200_000).map(|i| format!("k{i} = 1\n")).collect();
    let keys = keys.concat();
    let defects = refused("keys.toml", &(keys + TOML), Format::Toml);
    assert_eq!(defects.count(), 200_000);

    let one_line = format!("{{\"feature\": [{}1]}}", "{\"id\": 1},".repeat(9_000));
    assert!(refused("line.json", &one_line, Format::Json).count() > 9_000);
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(path(name), bytes).unwrap();
        Source::read(path(name)).unwrap_err().to_string()
    };
    let said = write("latin1.toml", b"# ok\nname = \"S\xe4nde\"\n");
    assert!(
        said.contains("latin1.toml:2:10: the byte 0xe4 is not UTF-8"),
        "{said}"
    );
    let said = write("binary.toml", b"name = 1\n\x7fELF\x00\x01");
    assert!(
        said.contains("binary.toml:2:5: the file is binary"),
        "{said}"
    );
    let said = Source::read(directory.path()).unwrap_err();
    assert!(matches!(said, ReadError::Directory { .. }), "{said}");
    let said = Source::read(path("none.toml")).unwrap_err();
    assert!(matches!(said, ReadError::Missing { .. }), "{said}");
    let file = std::fs::File::create(path("huge.toml")).unwrap();
    file.set_len(LARGEST_FILE + 1).unwrap();
    let said = Source::read(path("huge.toml")).unwrap_err().to_string();
    assert!(
        said.contains("67108865 bytes, more than the 67108864"),
        "{said}"
    );
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_are_fine() {
    let text = format!("\u{feff}{}", TOML.replace('\n', "\r\n"));
    Model::check(&Source::from_text("a.toml", text.clone(), Format::Toml)).unwrap();
    let broken = text.replace("width = 50", "width = -50");
    let defects = refused("a.toml", &broken, Format::Toml);
    let place = defects.iter().next().unwrap().place().clone();
    assert_eq!((place.line, place.column), (24, 9));
}

proptest::proptest! {
    #[test]
    fn no_change_of_a_few_characters_makes_the_program_panic(
        json in proptest::bool::ANY,
        cuts in proptest::collection::vec((0_usize..900, 0_usize..12, "[\\[\\]{}=\",.#0-9eE a-z\\n-]{0,6}|.{0,3}"), 1..4),
    ) {
        let (good, format) = if json { (JSON, Format::Json) } else { (TOML, Format::Toml) };
        let mut characters: Vec<char> = good.chars().collect();
        for (at, length, put) in cuts {
            let at = at % characters.len();
            let end = (at + length).min(characters.len());
            characters.splice(at..end, put.chars());
        }
        let text: String = characters.into_iter().collect();
        if let Err(defects) = Model::check(&Source::from_text("changed", text, format)) {
            proptest::prop_assert!(defects.count() > 0);
            proptest::prop_assert!(!defects.render(false).is_empty());
            proptest::prop_assert_eq!(&defects.to_json()["count"], &serde_json::json!(defects.count()));
        }
    }
}
