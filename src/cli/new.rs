//! `clinothem new`: a model file to start from.

use std::path::PathBuf;

use super::failure::Failure;
use super::{files, print};
use crate::model::{TEMPLATES, Template};

/// Write a model file to start from.
///
/// Without a template, lists them.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  clinothem new                          the templates
  clinothem new quickstart               write quickstart.toml
  clinothem new channel-belt belt.toml   write belt.toml
  clinothem new strata/points            write points.toml")]
pub(super) struct Args {
    /// The template's name.
    template: Option<String>,
    /// Where to write it; TEMPLATE.toml if not given.
    file: Option<PathBuf>,
    /// Replace the file if it exists.
    #[arg(long)]
    force: bool,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let Some(name) = &args.template else {
        let widths = TEMPLATES.iter().map(|one| one.name.len());
        let width = widths.max().unwrap_or(0);
        let line = |one: &Template| format!("{:width$}  {}", one.name, one.about);
        let lines: Vec<String> = TEMPLATES.iter().map(line).collect();
        return print::out(&lines.join("\n"));
    };
    let template = Template::find(name)
        .map_err(|remedy| Failure::Wrong(format!("there is no template `{name}`; {remedy}")))?;
    let path = args
        .file
        .clone()
        .unwrap_or_else(|| PathBuf::from(template.file_name()));
    let beside = template.data.iter();
    let data = beside.map(|(name, text)| (path.with_file_name(name), *text));
    let mut all: Vec<(PathBuf, &str)> = data.collect();
    all.push((path.clone(), template.text));
    if let Some((there, _)) = all.iter().find(|(path, _)| path.exists())
        && !args.force
    {
        return Err(Failure::Wrong(format!(
            "{} exists already; name another file, or add --force to replace it",
            there.display()
        )));
    }
    for (path, text) in &all {
        files::write(path, text.as_bytes())?;
    }
    let shown = path.display();
    let more = match template.data.len() {
        0 => String::new(),
        count => format!(" and {count} files that it reads"),
    };
    print::out(&format!(
        "wrote {shown}{more}; next: clinothem build {shown}"
    ))
}
