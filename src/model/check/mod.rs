//! From text to a checked [`Model`], with every defect found on the way.

mod conform;
mod domain;
mod facies;
mod family;
mod feature;
mod references;

use std::cell::RefCell;
use std::sync::Arc;

use super::checker::Checker;
use super::defects::{Collector, Defect, Defects, Span, Text};
use super::file::ModelFile;
use super::parameters::Parameters;
use super::place::Note;
use super::read::{Any, Field, Reader};
use super::source::{Format, Source};
use super::spec::Model;
use super::tree::{NodeId, Tree, Value};
use super::{alike, json_text, overrides, toml_text};

/// What a model without a seed is drawn with.
const DEFAULT_SEED: u64 = 1;

impl Model {
    /// Reads and checks a model with its overrides; all its defects at once if there are any.
    ///
    /// Only where the text is no valid TOML or JSON are its syntax errors reported alone, since what they leave cannot be
    /// judged.
    pub fn check(source: &Source) -> Result<Self, Defects> {
        let mut tree = Tree::default();
        let mut defects = Collector::default();
        let texts = texts_of(source);
        if source.text.trim().is_empty() {
            defects.add(Defect::new(
                Span::new(0, 0, 0),
                "the file is empty",
                "start from a template: `clinothem new quickstart`",
            ));
            return defects.finish(texts, None);
        }
        let parsed = match source.format {
            Format::Toml => toml_text::parse(&mut tree, 0, &source.text),
            Format::Json => json_text::parse(&mut tree, 0, &source.text),
        };
        if !parsed.defects.is_empty() {
            for defect in parsed.defects {
                defects.add(defect);
            }
            return defects.finish(texts, None);
        }
        if let Some(parameters) = &source.parameters {
            let text = source.assignments.len() + 1;
            for defect in parameters.apply(&mut tree, parsed.root, text) {
                defects.add(defect);
            }
        }
        for (number, assignment) in source.assignments.iter().enumerate() {
            if let Err(list) = overrides::apply(&mut tree, parsed.root, number + 1, assignment) {
                for defect in list {
                    defects.add(defect);
                }
            }
        }
        for defect in alike::expand(&mut tree, parsed.root) {
            defects.add(defect);
        }
        let checker = Checker {
            reader: Reader::new(&tree, defects),
            texts: &texts,
            notes: Vec::new(),
            referring: RefCell::default(),
            origin: [0.0; 3],
            folder: source.folder.clone(),
            solids: source.solids,
        };
        let (model, defects) = checker.model(parsed.root);
        defects.finish(Arc::clone(&texts), model)
    }
}

fn texts_of(source: &Source) -> Arc<Vec<Text>> {
    let file = Text::new(source.name.clone(), source.text.clone());
    let arguments = source
        .assignments
        .iter()
        .map(|assignment| Text::new("--set".to_owned(), assignment.clone()));
    let parameters = source.parameters.iter();
    let parameters = parameters
        .flat_map(Parameters::texts)
        .map(|(name, text)| Text::new(name.to_owned(), text.to_owned()));
    Arc::new(
        std::iter::once(file)
            .chain(arguments)
            .chain(parameters)
            .collect(),
    )
}

impl Checker<'_> {
    fn model(mut self, root: NodeId) -> (Option<Model>, Collector) {
        let model = self.root(root);
        (model, self.reader.into_defects())
    }

    fn root(&mut self, root: NodeId) -> Option<Model> {
        let file: ModelFile = self.reader.table(root)?;
        self.reader.close(root, "the model");
        let name = self.name(file.name, root);
        let description = file.description.and_then(Field::good).map(|(_, text)| text);
        let seed = match file.seed {
            None => Some(DEFAULT_SEED),
            Some(field) => field.good().map(|(_, seed)| seed),
        };
        let origin = match file.origin {
            None => Some([0.0; 3]),
            Some(field) => field.good().and_then(|(node, Any)| self.origin(node)),
        };
        self.origin = origin.unwrap_or_default();
        let facies = self.all_facies(file.facies, root);
        let domain = self.domain(file.domain, root, &facies);
        let features = self.features(file.feature, domain.as_ref(), &facies);
        let wells = self.wells(file.well, domain.as_ref());
        let tops = match (&wells, &features) {
            (Some(wells), Some(features)) => self.tops(file.tops, wells, features),
            _ => None,
        };
        if let (Some(domain), Some(features)) = (&domain, &features) {
            self.note_unused_facies(&facies, domain, features);
        }
        Some(Model {
            name: name?,
            description,
            seed: seed?,
            stratum: None,
            origin: origin?,
            domain: domain?,
            facies: facies.finished()?,
            features: features?,
            wells: wells?,
            tops: tops?,
            notes: self.sorted_notes(),
        })
    }

    /// The notes in the order of the file.
    fn sorted_notes(&mut self) -> Vec<Note> {
        let mut notes = std::mem::take(&mut self.notes);
        notes.sort_by_key(|note| (note.place.line, note.place.column));
        notes
    }

    fn name(&self, field: Field<String>, root: NodeId) -> Option<String> {
        let (node, name) =
            self.reader
                .need(field, root, "the model", "name", "name = \"Channel belt\"")?;
        if name.trim().is_empty() {
            self.reader.wrong(
                node,
                "the name of the model is empty",
                "write what the model is called, for example: name = \"Channel belt\"",
            );
            return None;
        }
        Some(name)
    }

    fn origin(&self, node: NodeId) -> Option<[f64; 3]> {
        let elements = self.reader.tree.elements(node);
        match (self.reader.tree.value(node), elements) {
            (Value::List(_), [x, y]) => {
                let (x, y) = (self.reader.number(*x), self.reader.number(*y));
                Some([x?, y?, 0.0])
            }
            (Value::List(_), [_, _, _]) => self.reader.read(node),
            _ => {
                self.reader.wrong(
                    node,
                    format!(
                        "expected [easting, northing] or [easting, northing, elevation] for the origin, found {}",
                        self.reader.tree.describe(node)
                    ),
                    "write two or three numbers in [ ]",
                );
                None
            }
        }
    }
}
