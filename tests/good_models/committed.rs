//! The committed models and the templates.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use clinothem::model::{
    FeatureKind, Format, Model, Profile, Quantity, Selector, Source, TEMPLATES, Template,
    TrajectorySpec,
};

fn read(path: &str) -> Model {
    let source = Source::read(path).unwrap();
    Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"))
}

#[test]
fn the_channel_belt_has_twenty_channels_drawn_from_table_1() {
    let model = read("models/channel-belt/channel-belt.toml");
    assert_eq!(model.seed, 7);
    assert_eq!(model.domain.size(), [1000.0, 1000.0, 60.0]);
    assert_eq!(
        model
            .facies
            .iter()
            .map(|f| f.name.as_str())
            .collect::<Vec<_>>(),
        ["floodplain", "channel-sand"]
    );
    let [feature] = model.features.as_slice() else {
        panic!("one feature")
    };
    assert_eq!((feature.count, feature.level, feature.facies), (20, 1, 1));
    assert_eq!(feature.removes, Selector::Everything);
    let FeatureKind::Channel(channel) = &feature.kind else {
        panic!("{:?}", feature.kind)
    };
    let Profile::Quantity(Quantity::Random(width)) = &channel.width else {
        panic!("{:?}", channel.width)
    };
    assert_eq!(width.support(), (15.0, 100.0));
    assert!((width.mean() - 55.0).abs() < 1e-12);
    let TrajectorySpec::SineGenerated {
        wavelength, center, ..
    } = &channel.trajectory
    else {
        panic!("{:?}", channel.trajectory)
    };
    assert_eq!(wavelength.support(), (50.0, 3000.0));
    assert_eq!(*center, None);
    assert!(model.notes.is_empty());
}

#[test]
fn the_quickstart_has_two_channels() {
    let model = read("models/quickstart/quickstart.toml");
    assert_eq!(
        model
            .features
            .iter()
            .map(|f| f.id.as_str())
            .collect::<Vec<_>>(),
        ["old-channel", "young-channel"]
    );
    assert_eq!(model.features[1].place.line, 33);
}

#[test]
fn json_of_the_same_content_is_the_same_model() {
    let toml = include_str!("../../models/channel-belt/channel-belt.toml");
    let value: toml::Value = toml::from_str(toml).unwrap();
    let json = serde_json::to_string_pretty(&value).unwrap();
    let from_json = Model::check(&Source::from_text("belt.json", json, Format::Json))
        .unwrap_or_else(|defects| panic!("{defects}"));
    let from_toml = read("models/channel-belt/channel-belt.toml");
    assert_eq!(from_json.domain.size(), from_toml.domain.size());
    assert_eq!(from_json.features[0].kind, from_toml.features[0].kind);
}

/// The files below `models`, by the names of their templates, with their text.
fn files() -> BTreeMap<String, String> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut files = BTreeMap::new();
    for folder in fs::read_dir(models).unwrap() {
        let folder = folder.unwrap();
        let name = folder.file_name().into_string().unwrap();
        let mut found = 0;
        for file in fs::read_dir(folder.path()).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|ending| ending != "toml") {
                continue;
            }
            found += 1;
            let stem = path.file_stem().unwrap().to_str().unwrap();
            let name = if stem == name {
                name.clone()
            } else {
                format!("{name}/{stem}")
            };
            files.insert(name, fs::read_to_string(path).unwrap());
        }
        assert!(found > 0, "models/{name} holds no model");
    }
    files
}

#[test]
fn every_committed_model_is_a_template_and_every_template_is_one() {
    let templates: BTreeMap<String, String> = TEMPLATES
        .iter()
        .map(|template| (template.name.to_owned(), template.text.to_owned()))
        .collect();
    let files = files();
    let names = |of: &BTreeMap<String, String>| of.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&templates), names(&files));
    assert_eq!(templates.len(), TEMPLATES.len(), "no name twice");
    assert!(templates == files, "a template has another file's text");
}

#[test]
fn every_template_has_a_recipe_and_no_recipe_starts_from_nothing() {
    let recipes = include_str!("../../docs/recipes.md");
    let starts: BTreeSet<&str> = recipes
        .split("| `clinothem new ")
        .skip(1)
        .map(|rest| rest.split('`').next().unwrap())
        .collect();
    let names: BTreeSet<&str> = TEMPLATES.iter().map(|template| template.name).collect();
    assert_eq!(starts, names);
    // What is looked at is the file that `new` writes.
    for line in recipes.lines().filter(|line| line.starts_with("| ")) {
        let Some((_, start)) = line.split_once("`clinothem new ") else {
            continue;
        };
        let template = Template::find(start.split('`').next().unwrap()).unwrap();
        let looked = line.rsplit("`clinothem ").next().unwrap();
        let file = format!(" {}", template.file_name());
        assert!(looked.contains(&file), "{line}");
    }
}

#[test]
fn a_template_that_is_misspelt_is_guessed() {
    assert_eq!(
        Template::find("chanel-belt").unwrap_err(),
        "did you mean `channel-belt`?"
    );
    assert_eq!(
        Template::find("contact/piece").unwrap_err(),
        "did you mean `contacts/pieces`?"
    );
    let unknown = Template::find("xyzzy").unwrap_err();
    assert!(unknown.contains("lists them"), "{unknown}");
}

#[test]
fn every_template_is_a_good_model() {
    for template in TEMPLATES {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in template.data {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        // Solids of other programs the kernel reads.
        if !cfg!(feature = "occt") && template.text.contains("\"solid\"") {
            continue;
        }
        let source = Source::from_text("model.toml", template.text, Format::Toml);
        let source = source.in_folder(folder.path());
        #[cfg(feature = "occt")]
        let source = source.with_solids(clinothem::assembly::read_solid);
        Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
    }
}
