//! Surveys as they are written, in a model file or beside it: rows of one kind, each with its place.

use serde::Deserialize;

use super::file::{StationFile, SurveyOfFile};
use super::spec::SurveySource;
use crate::data::survey::{self, Column, SurveyFormat, SurveyReading, SurveyTable};
use crate::model::checker::Checker;
use crate::model::checker::files::sha256;
use crate::model::read::{Any, Field};
use crate::model::suggest;
use crate::model::tree::{NodeId, Value, quoted};

/// What the rows of a survey are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Measured depth, inclination and azimuth.
    Angles,
    /// Azimuth, dip and distance.
    Steps,
    /// Points.
    Points,
}

impl Form {
    /// The columns that it needs.
    fn needs(self) -> [Column; 3] {
        match self {
            Self::Angles => [Column::Md, Column::Inclination, Column::Azimuth],
            Self::Steps => [Column::Azimuth, Column::Dip, Column::Distance],
            Self::Points => [Column::X, Column::Y, Column::Z],
        }
    }

    fn example(self) -> &'static str {
        match self {
            Self::Angles => "{ md = 500, inc_deg = 12, azi_deg = 45 }",
            Self::Steps => "{ azi_deg = 45, dip_deg = 80, distance = 30 }",
            Self::Points => "{ x = 120, y = 340, z = -850 }",
        }
    }
}

/// Where a row stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whence {
    /// In the model file.
    Node(NodeId),
    /// On a line of another file.
    Line(usize),
}

/// A row of a survey, in the units of the file.
#[derive(Clone, Debug)]
pub(super) struct SurveyRow {
    pub(super) whence: Whence,
    values: Vec<(Column, f64)>,
}

impl SurveyRow {
    pub(super) fn get(&self, column: Column) -> Option<f64> {
        let found = self.values.iter().find(|(own, _)| *own == column);
        found.map(|(_, value)| *value)
    }

    /// The value of a column that all rows of its kind have.
    pub(super) fn need(&self, column: Column) -> f64 {
        self.get(column).unwrap_or(f64::NAN)
    }
}

/// A survey as it is written.
#[derive(Clone, Debug)]
pub(super) struct Written {
    pub(super) node: NodeId,
    pub(super) rows: Vec<SurveyRow>,
    /// The kinds that its rows can be taken as, the one that says most first.
    pub(super) forms: Vec<Form>,
    /// The wellhead that a file says.
    pub(super) head: Option<[f64; 2]>,
    /// The depth reference that a file says.
    pub(super) datum: Option<f64>,
    pub(super) source: Option<SurveySource>,
}

#[derive(Deserialize)]
struct ColumnsFile {
    md: Option<Field<Any>>,
    inc_deg: Option<Field<Any>>,
    azi_deg: Option<Field<Any>>,
    dip_deg: Option<Field<Any>>,
    distance: Option<Field<Any>>,
    x: Option<Field<Any>>,
    y: Option<Field<Any>>,
    z: Option<Field<Any>>,
    tvd: Option<Field<Any>>,
    tvdss: Option<Field<Any>>,
}

impl Checker<'_> {
    /// The survey of a well; `what` names it, as `the survey of well "A-1"`.
    pub(super) fn written_survey(&mut self, node: NodeId, what: &str) -> Option<Written> {
        match self.reader.tree.value(node) {
            Value::List(rows) => {
                let rows = rows.clone();
                self.inline_survey(node, &rows, what)
            }
            Value::Table(_) => self.survey_of_file(node, what),
            _ => {
                let found = self.reader.tree.describe(node);
                self.reader.wrong(
                    node,
                    format!("expected a list of stations, or a file, for {what}, found {found}"),
                    "write [{ md = 0, inc_deg = 0, azi_deg = 0 }, …], or { file = \"A-1.dev\" }",
                );
                None
            }
        }
    }

    fn inline_survey(&mut self, node: NodeId, nodes: &[NodeId], what: &str) -> Option<Written> {
        let before = self.reader.found();
        let mut rows = Vec::with_capacity(nodes.len());
        let mut first = None;
        for (at, row) in nodes.iter().enumerate() {
            let name = format!("station {} of {what}", at + 1);
            rows.extend(self.station(*row, &name, &mut first));
        }
        if nodes.is_empty() {
            self.reader.wrong(
                node,
                format!("{what} has no stations"),
                "write two at least: [{ md = 0, inc_deg = 0, azi_deg = 0 }, { md = 900, inc_deg = 0, azi_deg = 0 }]",
            );
        }
        let form = first?;
        (self.reader.found() == before).then_some(Written {
            node,
            rows,
            forms: vec![form],
            head: None,
            datum: None,
            source: None,
        })
    }

    /// One station; all are of the kind of the first one.
    fn station(&self, node: NodeId, name: &str, first: &mut Option<Form>) -> Option<SurveyRow> {
        let file: StationFile = self.reader.table(node)?;
        self.reader.close(node, name);
        let fields = [
            (Column::Md, file.md),
            (Column::Inclination, file.inc_deg),
            (Column::Azimuth, file.azi_deg),
            (Column::Dip, file.dip_deg),
            (Column::Distance, file.distance),
            (Column::X, file.x),
            (Column::Y, file.y),
            (Column::Z, file.z),
        ];
        let has = |column: &Column| {
            let mut given = fields.iter().filter(|(_, field)| field.is_some());
            given.any(|(own, _)| own == column)
        };
        // What it is most of.
        let count = |form: &Form| form.needs().iter().filter(|column| has(column)).count();
        let forms = [Form::Angles, Form::Steps, Form::Points];
        let most = forms.iter().map(count).max().unwrap_or(0);
        let own = forms
            .into_iter()
            .find(|form| count(form) == most)
            .unwrap_or(Form::Angles);
        let form = *first.get_or_insert(own);
        if own != form && count(&form) < most {
            self.reader.wrong(
                node,
                format!("{name} is of another kind than the first one"),
                format!(
                    "all stations of a survey are of one kind; write it as {}",
                    form.example()
                ),
            );
            return None;
        }
        let mut values = Vec::with_capacity(4);
        let mut is_whole = true;
        for (column, field) in fields {
            let is_needed = form.needs().contains(&column);
            let is_allowed = is_needed || (form == Form::Points && column == Column::Md);
            match field {
                Some(Field::Good(at, value)) if is_allowed => {
                    is_whole &= self.is_angle(at, column, value, name);
                    values.push((column, value));
                }
                Some(Field::Good(at, _)) => {
                    is_whole = false;
                    let message = format!(
                        "{name} has a `{}`, which does not go with the first station's keys",
                        column.word()
                    );
                    let remedy = format!(
                        "all stations of a survey are of one kind; write it as {}",
                        form.example()
                    );
                    self.reader.wrong(at, message, remedy);
                }
                Some(_) => is_whole = false,
                None if is_needed => {
                    is_whole = false;
                    self.reader
                        .missing(node, name, column.word(), form.example());
                }
                None => {}
            }
        }
        is_whole.then_some(SurveyRow {
            whence: Whence::Node(node),
            values,
        })
    }

    fn is_angle(&self, node: NodeId, column: Column, value: f64, name: &str) -> bool {
        let (limits, remedy) = match column {
            Column::Inclination => (0.0..=180.0, "0 is downwards, 90 level, more rises"),
            Column::Dip => (-90.0..=90.0, "90 is downwards, 0 level, less than 0 rises"),
            _ => return true,
        };
        let holds = limits.contains(&value);
        if !holds {
            let (low, high) = (limits.start(), limits.end());
            let message = format!(
                "the {} of {name} is {value}; it must lie between {low} and {high}",
                column.word()
            );
            self.reader.wrong(node, message, remedy);
        }
        holds
    }

    fn survey_of_file(&mut self, node: NodeId, what: &str) -> Option<Written> {
        let keys: SurveyOfFile = self.reader.table(node)?;
        self.reader.close(node, what);
        let before = self.reader.found();
        let format = keys.format.and_then(Field::good);
        let format = format.and_then(|(at, word)| {
            let format = SurveyFormat::of_word(&word);
            if format.is_none() {
                let words = SurveyFormat::ALL.map(SurveyFormat::word);
                let remedy = suggest::name(&word, &words, "formats of surveys");
                self.reader.wrong(
                    at,
                    format!("there is no format {} of surveys", quoted(&word)),
                    remedy,
                );
            }
            format
        });
        let columns = keys.columns.and_then(Field::good);
        let columns = columns.map_or_else(Vec::new, |(at, Any)| self.survey_columns(at, what));
        let (at, file) = self
            .reader
            .need(keys.file, node, what, "file", "file = \"A-1.dev\"")?;
        if self.reader.found() > before {
            return None;
        }
        let bytes = self.bytes_of(at, what, &file)?;
        let table = match survey::read(&bytes, &SurveyReading { format, columns }) {
            Ok(table) => table,
            Err(error) => {
                self.reader.wrong(
                    at,
                    format!("{what}: {}: {error}", quoted(&file)),
                    error.remedy(),
                );
                return None;
            }
        };
        let forms = forms_of(&table);
        if forms.is_empty() {
            let found: Vec<&str> = table.columns.iter().map(|column| column.word()).collect();
            self.reader.wrong(
                at,
                format!(
                    "{what}: {}: of its columns only {} are known, which makes no survey",
                    quoted(&file),
                    found.join(", ")
                ),
                "a survey has md, inc_deg and azi_deg; or azi_deg, dip_deg and distance; or x, y and z (or tvd, tvdss): name its columns, \
                 for example: columns = { md = \"MD\", inc_deg = \"INCL\", azi_deg = \"AZIM_GN\" }",
            );
            return None;
        }
        if table.is_true_north && forms.contains(&Form::Angles) {
            self.note(
                at,
                format!("{what}: its azimuths are from true north (AZIM_TN) and are taken as from grid north; export AZIM_GN, or turn them by the convergence"),
            );
        }
        if table.dropped > 0 {
            self.note(
                at,
                format!(
                    "{what}: {} of its rows have values missing and are left out",
                    table.dropped
                ),
            );
        }
        Some(Written {
            node: at,
            rows: rows_of(&table),
            forms,
            head: table.head,
            datum: table.datum,
            source: Some(SurveySource {
                file,
                sha256: sha256(&bytes),
                format: table.format.name(),
                rows: table.rows.len(),
                dropped: table.dropped,
            }),
        })
    }

    /// What columns are called.
    fn survey_columns(&self, node: NodeId, what: &str) -> Vec<(Column, String)> {
        let Some(file) = self.reader.table::<ColumnsFile>(node) else {
            return Vec::new();
        };
        self.reader.close(node, &format!("the columns of {what}"));
        let fields = [
            (Column::Md, file.md),
            (Column::Inclination, file.inc_deg),
            (Column::Azimuth, file.azi_deg),
            (Column::Dip, file.dip_deg),
            (Column::Distance, file.distance),
            (Column::X, file.x),
            (Column::Y, file.y),
            (Column::Z, file.z),
            (Column::Tvd, file.tvd),
            (Column::Tvdss, file.tvdss),
        ];
        let mut columns = Vec::new();
        for (column, field) in fields {
            let Some((at, Any)) = field.and_then(Field::good) else {
                continue;
            };
            match self.reader.tree.value(at) {
                Value::Text(text) => columns.push((column, text.clone())),
                Value::Integer(number) if *number > 0 => columns.push((column, number.to_string())),
                _ => {
                    let found = self.reader.tree.describe(at);
                    let message =
                        format!("expected a column's name or number for {what}, found {found}");
                    self.reader.wrong(
                        at,
                        message,
                        "write its name in quotes, or its number from 1",
                    );
                }
            }
        }
        columns
    }

    /// Reports a defect of one row of a survey.
    pub(super) fn wrong_row(&self, survey: &Written, row: usize, message: &str, remedy: &str) {
        let whence = survey.rows.get(row).map(|row| row.whence);
        match (whence, &survey.source) {
            (Some(Whence::Node(node)), _) => self.reader.wrong(node, message, remedy),
            (Some(Whence::Line(line)), Some(source)) => {
                let file = quoted(&source.file);
                self.reader.wrong(
                    survey.node,
                    format!("{file}, line {line}: {message}"),
                    remedy,
                );
            }
            _ => self.reader.wrong(survey.node, message, remedy),
        }
    }
}

/// What the rows of a table can be taken as.
fn forms_of(table: &SurveyTable) -> Vec<Form> {
    let has_height = [Column::Z, Column::Tvd, Column::Tvdss]
        .iter()
        .any(|column| table.has(&[*column]));
    let mut forms = Vec::new();
    if table.has(&[Column::X, Column::Y]) && has_height {
        forms.push(Form::Points);
    }
    if table.has(&Form::Angles.needs()) {
        forms.push(Form::Angles);
    }
    if table.has(&Form::Steps.needs()) {
        forms.push(Form::Steps);
    }
    forms
}

fn rows_of(table: &SurveyTable) -> Vec<SurveyRow> {
    let row = |row: &survey::Row| SurveyRow {
        whence: Whence::Line(row.line),
        values: table
            .columns
            .iter()
            .copied()
            .zip(row.values.iter().copied())
            .collect(),
    };
    table.rows.iter().map(row).collect()
}
