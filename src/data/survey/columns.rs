//! Columns of surveys by what they mean, and the tables that they make.

/// What a column of a survey means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Column {
    /// Measured depth.
    Md,
    /// Inclination from the vertical, degrees.
    Inclination,
    /// Azimuth, degrees from grid north.
    Azimuth,
    /// Dip below the horizontal, degrees.
    Dip,
    /// Length of a step.
    Distance,
    /// Easting.
    X,
    /// Northing.
    Y,
    /// Elevation.
    Z,
    /// Depth below the datum.
    Tvd,
    /// Depth below mean sea level.
    Tvdss,
}

impl Column {
    /// All columns.
    pub const ALL: [Self; 10] = [
        Self::Md,
        Self::Inclination,
        Self::Azimuth,
        Self::Dip,
        Self::Distance,
        Self::X,
        Self::Y,
        Self::Z,
        Self::Tvd,
        Self::Tvdss,
    ];

    /// The word for it in model files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Md => "md",
            Self::Inclination => "inc_deg",
            Self::Azimuth => "azi_deg",
            Self::Dip => "dip_deg",
            Self::Distance => "distance",
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Tvd => "tvd",
            Self::Tvdss => "tvdss",
        }
    }

    /// The column that a word means.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|column| column.word() == word)
    }

    /// What programs call it, in small letters, the likeliest first. Grid azimuths come before true ones.
    fn names(self) -> &'static [&'static str] {
        match self {
            Self::Md => &[
                "md",
                "measured_depth",
                "measured depth",
                "dept",
                "depth",
                "mdepth",
                "md_m",
                "md_ft",
            ],
            Self::Inclination => &[
                "inc_deg",
                "incl",
                "inc",
                "inclination",
                "devi",
                "deviation",
                "incl_deg",
                "hole_deviation",
            ],
            Self::Azimuth => &[
                "azi_deg",
                "azim_gn",
                "azi",
                "azim",
                "azimuth",
                "hazi",
                "azimuth_grid",
                "azim_deg",
                "azim_tn",
            ],
            Self::Dip => &["dip_deg", "dip"],
            Self::Distance => &["distance", "dist", "length", "step"],
            Self::X => &["x", "easting", "east", "x_utm", "utm_x"],
            Self::Y => &["y", "northing", "north", "y_utm", "utm_y"],
            Self::Z => &["z", "elevation"],
            Self::Tvd => &["tvd", "true_vertical_depth", "tvd_kb", "tvdkb"],
            Self::Tvdss => &["tvdss", "tvd_ss", "subsea"],
        }
    }

    /// Its place among the names of a header.
    pub(super) fn place(self, header: &[String]) -> Option<usize> {
        let find = |name: &str| header.iter().position(|own| own.eq_ignore_ascii_case(name));
        self.names().iter().find_map(|name| find(name))
    }
}

/// A format of surveys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurveyFormat {
    /// Petrel's well trace.
    Dev,
    /// Log ASCII Standard, 2.0 or 1.2.
    Las,
    /// A table with a header.
    Csv,
}

impl SurveyFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Dev, Self::Las, Self::Csv];

    /// The word for it in model files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Dev => "dev",
            Self::Las => "las",
            Self::Csv => "csv",
        }
    }

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dev => "Petrel well trace",
            Self::Las => "LAS",
            Self::Csv => "table",
        }
    }

    /// The format that a word means.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.word() == word)
    }
}

/// What is known of a file besides what it says itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurveyReading {
    /// Its format; found from what it holds if not given.
    pub format: Option<SurveyFormat>,
    /// What some columns are called: a name of the header, or a number from 1.
    pub columns: Vec<(Column, String)>,
}

/// A row, with its line from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The line.
    pub line: usize,
    /// The value of each column of [`SurveyTable::columns`].
    pub values: Vec<f64>,
}

/// What a file of a survey holds.
#[derive(Clone, Debug, PartialEq)]
pub struct SurveyTable {
    /// Its format.
    pub format: SurveyFormat,
    /// The wellhead's easting and northing, if the file says them.
    pub head: Option<[f64; 2]>,
    /// The elevation of the depth reference, if the file says it.
    pub datum: Option<f64>,
    /// The unit of its depths as it is written, if the file says it.
    pub unit: Option<String>,
    /// Whether its azimuths are from true north, as far as its header says.
    pub is_true_north: bool,
    /// What its columns mean.
    pub columns: Vec<Column>,
    /// Its rows.
    pub rows: Vec<Row>,
    /// How many rows had a value missing, and are left out.
    pub dropped: usize,
}

impl SurveyTable {
    /// Whether it has all of these columns.
    pub fn has(&self, columns: &[Column]) -> bool {
        columns.iter().all(|column| self.columns.contains(column))
    }

    /// The value of a column in a row.
    pub fn value(&self, row: &Row, column: Column) -> Option<f64> {
        let at = self.columns.iter().position(|own| *own == column)?;
        row.values.get(at).copied()
    }
}
