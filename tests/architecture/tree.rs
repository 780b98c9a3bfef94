//! The modules of a package, and who takes what from whom.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path as File;

use super::names::{Names, Path};

/// The modules of a package, each a file.
pub(crate) struct Tree {
    pub(crate) modules: BTreeMap<Path, Module>,
    /// Those that are there for tests alone.
    pub(crate) tests: BTreeMap<Path, Module>,
}

pub(crate) struct Module {
    /// Its file, from the folder of sources.
    pub(crate) file: String,
    pub(crate) names: Names,
}

impl Tree {
    /// Reads a folder of sources.
    pub(crate) fn read(root: &File) -> Self {
        let mut texts = Vec::new();
        sources(root, root, &mut texts);
        Self::new(&texts)
    }

    /// A tree of files with their texts.
    pub(crate) fn new(files: &[(String, String)]) -> Self {
        let mut modules: BTreeMap<Path, Module> = BTreeMap::new();
        for (file, text) in files {
            let module = Module {
                file: file.clone(),
                names: Names::of(text),
            };
            modules.insert(module_of(file), module);
        }
        let tests: Vec<Path> = modules
            .iter()
            .flat_map(|(path, module)| {
                module
                    .names
                    .tests
                    .iter()
                    .map(move |(name, file)| match file {
                        Some(file) => {
                            let folder = module
                                .file
                                .rsplit_once('/')
                                .map_or("", |(folder, _)| folder);
                            module_of(&format!("{folder}/{file}"))
                        }
                        None => [path.as_slice(), std::slice::from_ref(name)].concat(),
                    })
            })
            .collect();
        let (tests, modules) = modules
            .into_iter()
            .partition(|(path, _)| tests.iter().any(|test| path.starts_with(test)));
        Self { modules, tests }
    }

    /// The modules that a module takes something from.
    pub(crate) fn taken_by(&self, path: &Path) -> BTreeSet<&Path> {
        let mut from = BTreeSet::new();
        for taken in &self.modules[path].names.taken {
            self.sources_of(path, taken, &mut from);
        }
        from.remove(path);
        from
    }

    /// Where a name comes from that a module says: the module that defines it, and the sibling or cousin that hands it on. A module
    /// that hands on what is below it is a façade to those outside, and nothing to those inside.
    fn sources_of<'a>(&'a self, module: &Path, said: &Path, from: &mut BTreeSet<&'a Path>) {
        let Some((place, name)) = self.place(module, said) else {
            return;
        };
        let Some(name) = name else {
            // The module itself: what is taken of it is said elsewhere.
            return;
        };
        let (place, there) = self
            .modules
            .get_key_value(&place)
            .expect("a place is a module");
        if place == module {
            // Of one's own names only the imported ones lead on, and these were said where they are imported.
            return;
        }
        let handed_on = there.names.imports.get(&name).filter(|path| *path != said);
        let globs = there.names.globs.iter();
        let mut by_glob = globs.filter_map(|glob| {
            let whole = [glob.as_slice(), std::slice::from_ref(&name)].concat();
            let (place, _) = self.place(place, &whole)?;
            self.modules[&place]
                .names
                .items
                .contains(&name)
                .then_some(whole)
        });
        match handed_on.cloned().or_else(|| by_glob.next_back()) {
            Some(path) if !there.names.items.contains(&name) => {
                if !module.starts_with(place) {
                    from.insert(place);
                }
                self.sources_of(place, &path, from);
            }
            _ => {
                from.insert(place);
            }
        }
    }

    /// The module that a path leads to, and the name that follows.
    fn place(&self, module: &Path, said: &Path) -> Option<(Path, Option<String>)> {
        let climbs = said.iter().take_while(|name| *name == "super").count();
        let (mut place, mut at) = match said[0].as_str() {
            "crate" => (Path::new(), 1),
            "self" => (module.clone(), 1),
            "super" => (module[..module.len().checked_sub(climbs)?].to_vec(), climbs),
            first => {
                let child = [module.as_slice(), &[first.to_owned()]].concat();
                match self.modules[module].names.imports.get(first) {
                    _ if self.modules.contains_key(&child) => (module.clone(), 0),
                    // `use self::a` within a, or a name of another package.
                    Some(path) if path[0] != first => {
                        return self.place(module, &[path.as_slice(), &said[1..]].concat());
                    }
                    _ => return None,
                }
            }
        };
        while let Some(next) = said.get(at) {
            let child = [place.as_slice(), std::slice::from_ref(next)].concat();
            if !self.modules.contains_key(&child) {
                break;
            }
            place = child;
            at += 1;
        }
        self.modules
            .contains_key(&place)
            .then(|| (place, said.get(at).cloned()))
    }
}

/// `a/b.rs` and `a/b/mod.rs` are the module `a::b`.
fn module_of(file: &str) -> Path {
    let whole = file.trim_start_matches('/').trim_end_matches(".rs");
    let mut path: Path = whole.split('/').map(str::to_owned).collect();
    if matches!(path.last().map(String::as_str), Some("mod" | "lib")) {
        path.pop();
    }
    path
}

fn sources(root: &File, folder: &File, found: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(root, &path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let file = path.strip_prefix(root).unwrap().to_str().unwrap();
            found.push((file.to_owned(), std::fs::read_to_string(&path).unwrap()));
        }
    }
}
