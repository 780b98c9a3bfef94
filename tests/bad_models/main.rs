//! Broken model files: each is refused with the right words at the right place, and none panics.
//!
//! A case is one edit of a good file (or a whole file). `▸` marks where the defect stands; it is taken out before the
//! text is checked, so places are counted here independently of the program.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod bodies;
mod channels;
mod clinoforms;
mod companions;
mod data;
mod ellipsoids;
mod faults;
mod files;
mod folded_beds;
mod keys;
mod lags;
mod likes;
mod meander_belts;
mod nets;
mod overrides;
mod plugs;
mod point_bars;
mod references;
mod sections;
mod shorefaces;
mod solids;
mod trends;
mod wells;

use clinothem::model::{Defects, Format, Model, Source};

const TOML: &str = include_str!("good.toml");
const BODY: &str = include_str!("body.toml");
const NODULE: &str = include_str!("nodule.toml");
const SHOREFACE: &str = include_str!("shoreface.toml");
const JSON: &str = include_str!("good.json");

/// Finds this, puts that in its place, expects these words in the message or the remedy.
type Edit = (&'static str, &'static str, &'static [&'static str]);

/// Applies an edit; gives the text without the mark and where the mark was.
fn edited(good: &str, find: &str, replace: &str) -> (String, Option<(usize, usize)>) {
    assert!(good.contains(find), "the good file has no {find:?}");
    let marked = good.replacen(find, replace, 1);
    let place = marked.find('▸').map(|at| {
        let before = &marked[..at];
        let line = before.rsplit('\n').next().unwrap();
        (before.matches('\n').count() + 1, line.chars().count() + 1)
    });
    (marked.replace('▸', ""), place)
}

fn refused(name: &str, text: &str, format: Format) -> Defects {
    let result = Model::check(&Source::from_text(name, text, format));
    match result {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(defects) => {
            // Every way of showing them must work.
            assert!(!defects.render(true).is_empty());
            assert_eq!(defects.to_json()["count"], defects.count());
            defects
        }
    }
}

fn check_edits(edits: &[Edit], good: &str, name: &str, format: Format) {
    let mut wrong = Vec::new();
    for (find, replace, words) in edits {
        let (text, place) = edited(good, find, replace);
        let defects = refused(name, &text, format);
        let all: Vec<_> = defects.iter().collect();
        let defect = all[0];
        let said = format!("{}\n{}", defect.message(), defect.remedy());
        let found = (defect.place().line, defect.place().column);
        let right = all.len() == 1
            && place.is_none_or(|place| place == found)
            && words.iter().all(|word| said.contains(word));
        if !right {
            wrong.push(format!(
                "== {replace}\nexpected {place:?} {words:?}\n{defects}"
            ));
        }
        let shown = defects.to_string();
        assert!(
            shown.contains(&format!("{name}:{}:{}", found.0, found.1)),
            "{shown}"
        );
    }
    assert!(
        wrong.is_empty(),
        "{} wrong:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

#[test]
fn the_good_files_are_good() {
    for (name, text, format) in [
        ("a.toml", TOML, Format::Toml),
        ("a.json", JSON, Format::Json),
        ("b.toml", NODULE, Format::Toml),
        ("c.toml", SHOREFACE, Format::Toml),
        ("d.toml", BODY, Format::Toml),
        ("e.toml", include_str!("kinds.toml"), Format::Toml),
        ("f.toml", include_str!("well.toml"), Format::Toml),
    ] {
        let source = Source::from_text(name, text, format);
        Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
    }
}
