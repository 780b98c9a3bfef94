//! Overrides given as arguments (`feature.channel.width=30`), put into the tree before it is checked.

use super::alike;
use super::defects::{Defect, Span};
use super::suggest;
use super::toml_text;
use super::tree::{Entry, NodeId, Tree, Value};

/// Puts the assignment `source`, which is the text number `text`, into the tree below `root`.
pub(crate) fn apply(
    tree: &mut Tree,
    root: NodeId,
    text: usize,
    source: &str,
) -> Result<(), Vec<Defect>> {
    let whole = Span::new(text, 0, source.len());
    let Some(equals) = assignment_sign(source) else {
        return Err(vec![Defect::new(
            whole,
            "this override has no value",
            "write PATH=VALUE, as feature.channel.width=30 or seed=9",
        )]);
    };
    let path = path_of(tree, text, &source[..equals])?;
    let value = value_of(tree, text, source, equals, path.len())?;
    put_at(tree, root, &path, value, whole)
}

/// Puts a value at a key that stands elsewhere, at `span`: what is wrong with the key is told there.
pub(crate) fn apply_key(
    tree: &mut Tree,
    root: NodeId,
    key: &str,
    span: Span,
    value: NodeId,
) -> Result<(), Vec<Defect>> {
    let at_the_key = |mut defects: Vec<Defect>| {
        for defect in &mut defects {
            defect.move_to(span);
        }
        defects
    };
    let mut path = path_of(tree, span.text, key).map_err(at_the_key)?;
    for step in &mut path {
        step.key_span = span;
    }
    put_at(tree, root, &path, value, span)
}

/// Puts a value at the end of a path; `whole` is where it was said.
fn put_at(
    tree: &mut Tree,
    root: NodeId,
    path: &[Entry],
    value: NodeId,
    whole: Span,
) -> Result<(), Vec<Defect>> {
    let mut table = root;
    let mut features = None;
    for (depth, step) in path.iter().enumerate() {
        let last = depth + 1 == path.len();
        match tree.value(table) {
            Value::Table(_) => {
                let existing = tree.entry(table, &step.key).map(|entry| entry.node);
                table = match (existing, last) {
                    (Some(node), false) => node,
                    (None, false) => {
                        // A feature that is like another one gets a table of its own, so that the other keeps its own.
                        let taken = features.filter(|_| depth == 2);
                        let taken =
                            taken.and_then(|list| alike::inherited(tree, list, table, &step.key));
                        let node = taken
                            .unwrap_or_else(|| tree.add(step.key_span, Value::Table(Vec::new())));
                        put(tree, table, step, node);
                        node
                    }
                    (_, true) => {
                        put(tree, table, step, value);
                        value
                    }
                };
            }
            Value::List(_) if depth == 1 && path[0].key == "feature" => {
                features = Some(table);
                table = feature(tree, table, step)?;
                if last {
                    return Err(vec![Defect::new(
                        whole,
                        format!(
                            "the feature {} cannot be replaced as a whole",
                            suggest::code(&step.key)
                        ),
                        "name one of its keys, as feature.channel.width=30",
                    )]);
                }
            }
            Value::List(elements) => {
                let at = element(tree, elements, step)?;
                let list = table;
                table = if last { value } else { elements[at] };
                if last && let Value::List(elements) = tree.value_mut(list) {
                    elements[at] = value;
                }
            }
            _ => {
                let parent = &path[depth - 1];
                return Err(vec![Defect::new(
                    step.key_span,
                    format!(
                        "{} holds {}, which has no key {}",
                        suggest::code(&parent.key),
                        tree.describe(table),
                        suggest::code(&step.key)
                    ),
                    format!("set {} as a whole", suggest::code(&parent.key)),
                )]);
            }
        }
    }
    Ok(())
}

/// The first `=` that is not inside quotes.
fn assignment_sign(source: &str) -> Option<usize> {
    let mut quote = None;
    for (at, c) in source.char_indices() {
        match (quote, c) {
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            (None, '=') => return Some(at),
            _ => {}
        }
    }
    None
}

/// The path as the chain of tables that TOML makes of a dotted key.
fn path_of(tree: &mut Tree, text: usize, path: &str) -> Result<Vec<Entry>, Vec<Defect>> {
    let parsed = toml_text::parse(tree, text, &format!("{path} = 0"));
    if !parsed.defects.is_empty() || path.contains('\n') {
        return Err(vec![Defect::new(
            Span::new(text, 0, path.len()),
            format!("{} is not a path of keys", suggest::code(path)),
            "write keys with dots between them, as feature.channel.width=30",
        )]);
    }
    let mut steps = Vec::new();
    let mut table = parsed.root;
    while let [entry] = tree.entries(table) {
        table = entry.node;
        steps.push(entry.clone());
    }
    Ok(steps)
}

fn value_of(
    tree: &mut Tree,
    text: usize,
    source: &str,
    equals: usize,
    steps: usize,
) -> Result<NodeId, Vec<Defect>> {
    let parsed = toml_text::parse(tree, text, source);
    if parsed.defects.is_empty() {
        let mut node = parsed.root;
        for _ in 0..steps {
            match tree.entries(node) {
                [entry] => node = entry.node,
                _ => {
                    return Err(vec![Defect::new(
                        Span::new(text, 0, source.len()),
                        "this override sets more than one key",
                        "give one PATH=VALUE at a time",
                    )]);
                }
            }
        }
        return Ok(node);
    }
    // A shell has eaten the quotes of a word, or nobody wrote them.
    let value = source[equals + 1..].trim();
    let start = source.len() - source[equals + 1..].trim_start().len();
    let word = value
        .chars()
        .all(|c| c.is_alphanumeric() || "#_- ".contains(c));
    let starts_as_text = value.starts_with(|c: char| c.is_alphabetic() || c == '#');
    if word && starts_as_text {
        let span = Span::new(text, start, start + value.len());
        Ok(tree.add(span, Value::Text(value.to_owned())))
    } else {
        Err(parsed.defects)
    }
}

fn put(tree: &mut Tree, table: NodeId, step: &Entry, node: NodeId) {
    if let Value::Table(entries) = tree.value_mut(table) {
        let entry = Entry {
            key: step.key.clone(),
            key_span: step.key_span,
            node,
        };
        match entries.iter_mut().find(|entry| entry.key == step.key) {
            Some(existing) => *existing = entry,
            None => entries.push(entry),
        }
    }
}

/// The place in a list of what a step names: by its number from 1, as messages count, or by its `name`.
fn element(tree: &Tree, elements: &[NodeId], step: &Entry) -> Result<usize, Vec<Defect>> {
    let named = |node: &NodeId| {
        let name = tree.entry(*node, "name");
        name.and_then(|entry| tree.text(entry.node)) == Some(&step.key)
    };
    let number = step.key.parse::<usize>().ok();
    let by_number = number.and_then(|number| number.checked_sub(1));
    let found = elements
        .iter()
        .position(named)
        .or(by_number.filter(|at| *at < elements.len()));
    found.ok_or_else(|| {
        vec![Defect::new(
            step.key_span,
            format!(
                "{} is no place in a list of {}",
                suggest::code(&step.key),
                elements.len()
            ),
            "name an entry by its number, from 1, or by its `name`, as feature.fold.nets.points.2.3.3=-20",
        )]
    })
}

fn feature(tree: &Tree, list: NodeId, step: &Entry) -> Result<NodeId, Vec<Defect>> {
    let id_of = |node: NodeId| {
        tree.entry(node, "id")
            .and_then(|entry| tree.text(entry.node))
    };
    let features = tree.elements(list);
    let found = features
        .iter()
        .find(|&&node| id_of(node) == Some(&step.key));
    found.copied().ok_or_else(|| {
        let ids: Vec<&str> = features.iter().filter_map(|&node| id_of(node)).collect();
        vec![Defect::new(
            step.key_span,
            format!("the model has no feature {}", suggest::code(&step.key)),
            suggest::name(&step.key, &ids, "features"),
        )]
    })
}
