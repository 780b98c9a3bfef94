//! Features that are like another one: `like = "lower"` gives a feature the keys of an older one that it has not itself.
//!
//! It is done to the tree, before anything is checked, so no kind knows of it. What is copied is the definition, and nothing that
//! was drawn: draws have the feature's own id as their identity, so two parasequences of one definition are independent
//! realisations of it. Values are shared, not copied: a defect in them is one, where it is written.

use super::defects::Defect;
use super::suggest;
use super::tree::{Entry, NodeId, Tree, quoted};

/// The key that names the other feature.
const LIKE: &str = "like";

/// What a feature has by itself, or not at all.
const OWN: [&str; 4] = ["id", "name", "enabled", LIKE];

/// Keys that say the same thing in two ways: with one of its own, a feature takes neither from the other.
const EITHER: [[&str; 2]; 2] = [["parent", "along"], ["removes", "preserve"]];

/// Gives every feature below `root` what it has like another one.
pub(crate) fn expand(tree: &mut Tree, root: NodeId) -> Vec<Defect> {
    let mut defects = Vec::new();
    let Some(list) = tree.entry(root, "feature").map(|entry| entry.node) else {
        return defects;
    };
    let features = tree.elements(list).to_vec();
    for (at, &feature) in features.iter().enumerate() {
        let Some(named) = tree.entry(feature, LIKE).map(|entry| entry.node) else {
            continue;
        };
        // What is no text is told of where the table is read.
        let Some(name) = tree.text(named) else {
            continue;
        };
        match model_of(tree, &features, at, name) {
            Ok(other) => match take(tree, feature, other) {
                Ok(entries) => tree.extend(feature, entries),
                Err(defect) => defects.push(*defect),
            },
            Err((message, remedy)) => {
                defects.push(Defect::new(tree.span(named), message, remedy));
            }
        }
    }
    defects
}

/// What a feature of the list `list` has of a key by being like another one, as a copy of its own.
pub(crate) fn inherited(
    tree: &mut Tree,
    list: NodeId,
    feature: NodeId,
    key: &str,
) -> Option<NodeId> {
    if OWN.contains(&key) {
        return None;
    }
    let features = tree.elements(list).to_vec();
    let mut at = features.iter().position(|node| *node == feature)?;
    // Each is like one before it, so this ends.
    loop {
        let name = tree.entry(features[at], LIKE)?.node;
        let name = tree.text(name)?;
        at = features[..at]
            .iter()
            .position(|node| id_of(tree, *node) == Some(name))?;
        if let Some(entry) = tree.entry(features[at], key) {
            let node = entry.node;
            return Some(tree.copy(node));
        }
    }
}

fn id_of(tree: &Tree, feature: NodeId) -> Option<&str> {
    tree.entry(feature, "id")
        .and_then(|entry| tree.text(entry.node))
}

/// The feature of that name among those before number `at`; else what is wrong, and what to do.
fn model_of(
    tree: &Tree,
    features: &[NodeId],
    at: usize,
    name: &str,
) -> Result<NodeId, (String, String)> {
    let place = features
        .iter()
        .position(|node| id_of(tree, *node) == Some(name));
    match place {
        Some(place) if place < at => Ok(features[place]),
        Some(place) if place == at => Err((
            "this feature is like itself".to_owned(),
            "name another feature, one before it in the list".to_owned(),
        )),
        Some(_) => Err((
            format!("the feature {} comes later in the list", quoted(name)),
            "write the keys where the older one is, and `like` in the younger one".to_owned(),
        )),
        None => {
            let before = features[..at].iter();
            let ids: Vec<&str> = before.filter_map(|node| id_of(tree, *node)).collect();
            Err((
                format!("it is like {}, which is not a feature", quoted(name)),
                suggest::name(name, &ids, "features"),
            ))
        }
    }
}

/// The entries that a feature takes from another one.
fn take(tree: &Tree, feature: NodeId, other: NodeId) -> Result<Vec<Entry>, Box<Defect>> {
    if let Some(own) = tree.entry(feature, "kind") {
        let message = "it is like another feature, whose kind it has, and has a `kind` of its own";
        let remedy = "leave `kind` out, or leave `like` out and write all keys";
        return Err(Box::new(Defect::new(tree.span(own.node), message, remedy)));
    }
    let has = |key: &str| tree.entry(feature, key).is_some();
    let excluded = |key: &str| {
        let either = EITHER.iter().find(|pair| pair.contains(&key));
        either.is_some_and(|pair| pair.iter().any(|key| has(key)))
    };
    let entries = tree.entries(other).iter();
    Ok(entries
        .filter(|entry| {
            let key = entry.key.as_str();
            !OWN.contains(&key) && !has(key) && !excluded(key)
        })
        .cloned()
        .collect())
}
