//! What a file names: the paths in its code, its imports and what it defines, its tests aside.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A path, segment by segment.
pub(crate) type Path = Vec<String>;

/// What a file names.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// Names that it imports, or hands on (`pub use`), and what they stand for.
    pub(crate) imports: BTreeMap<String, Path>,
    /// Modules of which all is imported.
    pub(crate) globs: Vec<Path>,
    /// What it takes: paths in the code, and imports. What it only hands on is not taken.
    pub(crate) taken: Vec<Path>,
    /// Everything that is named, also by tests, and what is only handed on.
    pub(crate) named: Vec<Path>,
    /// Its own items.
    pub(crate) items: BTreeSet<String>,
    /// Modules that are there for tests alone: their names, and their files where these have names of their own.
    pub(crate) tests: Vec<(String, Option<String>)>,
    handed_on: Vec<(String, Path)>,
    idents: BTreeSet<String>,
}

impl Names {
    /// Reads a file.
    pub(crate) fn of(text: &str) -> Self {
        let tokens: TokenStream = text.parse().expect("a source file has balanced brackets");
        Self::of_tokens(&tokens.into_iter().collect::<Vec<_>>())
    }

    fn of_tokens(tokens: &[TokenTree]) -> Self {
        let mut names = Self::default();
        names.read(tokens, true);
        for (name, path) in std::mem::take(&mut names.handed_on) {
            if names.idents.contains(&name) {
                names.taken.push(path.clone());
            }
            names.named.push(path);
        }
        names.named.extend(names.taken.iter().cloned());
        names
    }

    fn read(&mut self, tokens: &[TokenTree], is_file: bool) {
        let mut at = 0;
        while at < tokens.len() {
            if let Some(end) = self.test_item(tokens, at) {
                at = end;
                continue;
            }
            match &tokens[at] {
                TokenTree::Group(group) => {
                    let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                    self.read(&inner, false);
                    at += 1;
                }
                TokenTree::Ident(ident) if ident == "use" => {
                    let end = end_of_item(tokens, at);
                    let is_public = at > 0 && is_visibility(tokens, at - 1);
                    self.import(&tokens[at + 1..end], &[], is_public);
                    at = end;
                }
                TokenTree::Ident(ident) => {
                    if is_file && DEFINES.contains(&ident.to_string().as_str()) {
                        self.items.extend(text(tokens.get(at + 1)));
                    }
                    at = self.path(tokens, at);
                }
                _ => at += 1,
            }
        }
    }

    /// The end of an item that is there for tests alone, if one begins here.
    fn test_item(&mut self, tokens: &[TokenTree], at: usize) -> Option<usize> {
        if !is_punct(tokens.get(at), '#') || attribute(tokens, at + 1)? != "cfg(test)" {
            return None;
        }
        let end = end_of_item(tokens, at);
        let item = &tokens[at + 2..end];
        let named = Self::of_tokens(item).named;
        let module = item
            .iter()
            .position(|token| text(Some(token)).as_deref() == Some("mod"));
        let Some(place) = module else {
            self.named.extend(named);
            return Some(end);
        };
        // It is one below this file, and what it says of itself and of this file leads nowhere else.
        let upward = named.into_iter().filter(|path| path[0] != "self");
        self.named.extend(upward.filter_map(
            |path| match path.strip_prefix(&["super".to_owned()]) {
                Some(rest) => (rest.first()? == "super").then(|| rest.to_vec()),
                None => Some(path),
            },
        ));
        let file = (0..place).find_map(|at| {
            let said = attribute(item, at)?;
            let path = said.strip_prefix("path=\"")?.strip_suffix('"')?;
            Some(path.to_owned())
        });
        self.tests
            .push((text(item.get(place + 1)).unwrap_or_default(), file));
        Some(end)
    }

    /// Takes in a path that begins here, and says where it ends.
    fn path(&mut self, tokens: &[TokenTree], at: usize) -> usize {
        let mut path: Path = text(tokens.get(at)).into_iter().collect();
        let mut end = at + 1;
        while is_punct(tokens.get(end), ':') && is_punct(tokens.get(end + 1), ':') {
            let Some(next) = text(tokens.get(end + 2)) else {
                break;
            };
            path.push(next);
            end += 3;
        }
        // What follows a dot is a field or a method, and what follows colons is a part of something else.
        let is_before = |back: usize, c| at >= back && is_punct(tokens.get(at - back), c);
        if !is_before(1, '.') {
            self.idents.insert(path[0].clone());
            if path.len() > 1 && !(is_before(1, ':') && is_before(2, ':')) {
                self.taken.push(path);
            }
        }
        end
    }

    /// Takes in a tree of imports below a path.
    fn import(&mut self, tree: &[TokenTree], below: &[String], is_public: bool) {
        let mut path = below.to_vec();
        let mut name = None;
        let mut at = 0;
        while let Some(token) = tree.get(at) {
            match token {
                TokenTree::Group(group) => {
                    let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                    for one in inner.split(|token| is_punct(Some(token), ',')) {
                        self.import(one, &path, is_public);
                    }
                    return;
                }
                TokenTree::Ident(ident) if ident == "as" => {
                    name = text(tree.get(at + 1));
                    at += 1;
                }
                TokenTree::Ident(ident) if ident == "self" && !path.is_empty() => {}
                TokenTree::Ident(ident) => path.push(ident.to_string()),
                TokenTree::Punct(punct) if punct.as_char() == '*' => {
                    self.globs.push(path);
                    return;
                }
                _ => {}
            }
            at += 1;
        }
        let Some(name) = name.or_else(|| path.last().cloned()) else {
            return;
        };
        self.imports.insert(name.clone(), path.clone());
        if is_public {
            self.handed_on.push((name, path));
        } else {
            self.taken.push(path);
        }
    }
}

/// What begins an item with a name.
const DEFINES: [&str; 9] = [
    "fn", "struct", "enum", "union", "trait", "type", "const", "static", "mod",
];

fn text(token: Option<&TokenTree>) -> Option<String> {
    match token {
        Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
        _ => None,
    }
}

fn is_punct(token: Option<&TokenTree>, c: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == c)
}

/// What an attribute's brackets hold, without spaces.
fn attribute(tokens: &[TokenTree], at: usize) -> Option<String> {
    match tokens.get(at) {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Bracket => {
            let said = group.stream().to_string();
            Some(said.chars().filter(|c| !c.is_whitespace()).collect())
        }
        _ => None,
    }
}

/// Whether `pub` or `pub(…)` ends here.
fn is_visibility(tokens: &[TokenTree], at: usize) -> bool {
    match &tokens[at] {
        TokenTree::Ident(ident) => ident == "pub",
        TokenTree::Group(group) => {
            group.delimiter() == Delimiter::Parenthesis
                && at > 0
                && text(tokens.get(at - 1)).as_deref() == Some("pub")
        }
        _ => false,
    }
}

/// One behind the semicolon or the braces that end an item.
fn end_of_item(tokens: &[TokenTree], from: usize) -> usize {
    let is_import = text(tokens.get(from)).as_deref() == Some("use");
    let ends = |token: &TokenTree| match token {
        TokenTree::Punct(punct) => punct.as_char() == ';',
        TokenTree::Group(group) => !is_import && group.delimiter() == Delimiter::Brace,
        _ => false,
    };
    let length = tokens[from..].iter().position(ends);
    length.map_or(tokens.len(), |length| from + length + 1)
}

#[test]
fn imports_and_paths_are_found_however_they_are_written() {
    let names = Names::of(
        "use crate::{a::{B, self}, c as d};\npub(super) use self::e::F;\npub use g::H; struct S(H);\n\
         //! [i](crate::i)\n fn j() { k :: l(m!(n::o)); x.p::<q>(); \"crate::r\" }",
    );
    let said: Vec<String> = names.taken.iter().map(|path| path.join("::")).collect();
    assert_eq!(
        said,
        [
            "crate::a::B",
            "crate::a",
            "crate::c",
            "k::l",
            "n::o",
            "g::H"
        ]
    );
    assert_eq!(names.imports["d"], ["crate", "c"]);
    assert_eq!(names.items, ["S", "j"].map(str::to_owned).into());
    assert!(
        names
            .named
            .contains(&["self", "e", "F"].map(str::to_owned).to_vec())
    );
}

#[test]
fn what_is_there_for_tests_alone_is_left_out() {
    let names = Names::of(
        "#[cfg(test)] use a::b; #[cfg(test)] #[allow(x)] mod tests { use super::{c, super::d}; }\n\
         #[cfg(test)] #[path = \"d_tests.rs\"] mod tests;\nuse e::f;",
    );
    assert_eq!(names.taken, [["e", "f"].map(str::to_owned)]);
    assert_eq!(
        names.tests[1],
        ("tests".to_owned(), Some("d_tests.rs".to_owned()))
    );
}
