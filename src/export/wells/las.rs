//! LAS 2.0 (Canadian Well Logging Society, 1992): what a well passes through at even steps of measured depth.
//!
//! Names are no values of LAS: volumes and facies are numbers there, and a table in `~Parameter` says whose. The first curve is the measured
//! depth in the well's unit; the path itself is not in the file, as LAS has no place for it.

use std::fmt::Write as _;

use crate::model::Model;
use crate::model::properties::Property;
use crate::model::realisation::Realisation;
use crate::model::wells::log::WellLog;
use crate::model::wells::spec::WellSpec;

/// Stands for no value.
const NULL: f64 = -999.25;
/// More lines than this are no log.
pub const MOST_LINES: usize = 5_000_000;

/// Why there is no log.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LasError {
    /// The step is not a length.
    #[error("the step is {0}; it must be above 0")]
    Step(f64),
    /// There would be too many lines.
    #[error(
        "a step of {step} makes {lines} lines, more than the {MOST_LINES} that may be; take a longer one"
    )]
    Lines {
        /// The step, in the unit of depth.
        step: f64,
        /// How many there would be.
        lines: f64,
    },
}

/// A curve of rock: its mnemonic and unit, what it is, the property and which of its numbers.
struct RockCurve {
    mnemonic: String,
    unit: &'static str,
    about: String,
    property: String,
    number: usize,
}

/// A log of a well.
pub struct Las<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its realisation.
    pub realisation: &'a Realisation,
    /// The well.
    pub spec: &'a WellSpec,
    /// What it passes through.
    pub log: &'a WellLog,
    /// From line to line, in the unit of the well's depths.
    pub step: f64,
}

impl Las<'_> {
    /// The file.
    pub fn text(&self) -> Result<String, LasError> {
        if !(self.step > 0.0 && self.step.is_finite()) {
            return Err(LasError::Step(self.step));
        }
        let unit = self.spec.unit;
        let (first, last) = self.spec.well.range();
        let (first, last) = (first / unit.metres, last / unit.metres);
        // A step that goes in evenly does so in spite of rounding.
        let lines = ((last - first) / self.step * (1.0 + 1e-12)).floor();
        if lines >= MOST_LINES as f64 {
            let step = self.step;
            return Err(LasError::Lines { step, lines });
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "checked above"
        )]
        let lines = lines as usize;
        let depth = |k: usize| first + self.step * k as f64;
        let curves = self.curves();
        let mut out = self.header([first, depth(lines)], &curves);
        for k in 0..=lines {
            let md = depth(k);
            let place = (md * unit.metres).min(self.spec.well.range().1);
            let volume = self.log.at(place);
            let _ = write!(out, "{md:14.4}");
            let tvdss = self.spec.tvdss(self.spec.well.point(place)) / unit.metres;
            let _ = write!(out, " {tvdss:12.4}");
            let number = |value: Option<f64>| value.unwrap_or(NULL);
            let _ = write!(out, " {:10}", number(volume.map(|volume| volume as f64)));
            let facies = volume.and_then(|volume| self.facies(volume));
            let _ = write!(out, " {:10}", number(facies.map(|at| (at + 1) as f64)));
            let _ = write!(
                out,
                " {:10}",
                number(volume.map(|_| f64::from(u8::from(self.is_open(place)))))
            );
            for curve in &curves {
                let value = volume.and_then(|volume| self.value(volume, curve));
                let _ = write!(out, " {:12}", number(value));
            }
            out.push('\n');
        }
        Ok(out)
    }

    fn is_open(&self, md: f64) -> bool {
        self.spec
            .completions
            .iter()
            .any(|[from, to]| *from <= md && md <= *to)
    }

    fn facies(&self, volume: usize) -> Option<usize> {
        let own = &self.realisation.volumes[volume].facies;
        self.model
            .facies
            .iter()
            .position(|facies| facies.name == *own)
    }

    fn value(&self, volume: usize, curve: &RockCurve) -> Option<f64> {
        let property = self.realisation.properties[volume].get(&curve.property)?;
        let numbers = property.numbers();
        match property {
            // One number holds along all axes, and for nothing beside them.
            Property::Scalar(value) => (curve.number < 3).then_some(value),
            _ => numbers.get(curve.number).copied(),
        }
    }

    /// Volumes that the well meets, in their order.
    fn volumes(&self) -> Vec<usize> {
        let mut volumes: Vec<usize> = self
            .log
            .intervals
            .iter()
            .filter_map(|one| one.volume)
            .collect();
        volumes.sort_unstable();
        volumes.dedup();
        volumes
    }

    /// The curves of the rock that it meets: those of all its properties.
    fn curves(&self) -> Vec<RockCurve> {
        let mut found: Vec<(String, usize)> = Vec::new();
        for volume in self.volumes() {
            for (name, value) in &self.realisation.properties[volume].values {
                let count = value.numbers().len();
                match found.iter_mut().find(|(own, _)| own == name) {
                    Some((_, own)) => *own = count.max(*own),
                    None => found.push((name.clone(), count)),
                }
            }
        }
        let axes = ["X", "Y", "Z", "XY", "YZ", "XZ"];
        let mut curves = Vec::new();
        for (property, count) in found {
            let (mnemonic, unit) = mnemonic(&property);
            for (number, axis) in axes.iter().enumerate().take(count) {
                let (mnemonic, about) = if count == 1 {
                    (mnemonic.clone(), property.clone())
                } else {
                    (
                        format!("{mnemonic}{axis}"),
                        format!("{property} along {}", axis.to_lowercase()),
                    )
                };
                curves.push(RockCurve {
                    mnemonic,
                    unit,
                    about,
                    property: property.clone(),
                    number,
                });
            }
        }
        curves
    }

    fn header(&self, [start, stop]: [f64; 2], curves: &[RockCurve]) -> String {
        let unit = self.spec.unit.name;
        let unit = if unit == "us-ft" {
            "FTUS".to_owned()
        } else {
            unit.to_uppercase()
        };
        let one_line = |text: &str| plain(text);
        let mut out = String::new();
        let mut line = |text: String| {
            out.push_str(&text);
            out.push('\n');
        };
        line("~Version".to_owned());
        line(" VERS.   2.0 : CWLS LOG ASCII STANDARD - VERSION 2.0".to_owned());
        line(" WRAP.   NO  : ONE LINE PER DEPTH STEP".to_owned());
        line("~Well".to_owned());
        line(format!(" STRT.{unit} {start:.4} : START DEPTH"));
        line(format!(" STOP.{unit} {stop:.4} : STOP DEPTH"));
        line(format!(" STEP.{unit} {} : STEP", self.step));
        line(format!(" NULL. {NULL} : NULL VALUE"));
        line(" COMP.  : COMPANY".to_owned());
        line(format!(" WELL. {} : WELL", one_line(&self.spec.name)));
        line(format!(" FLD. {} : FIELD", one_line(&self.model.name)));
        line(" LOC.  : LOCATION".to_owned());
        line(" PROV.  : PROVINCE".to_owned());
        line(format!(
            " SRVC. clinothem {} : SERVICE COMPANY",
            env!("CARGO_PKG_VERSION")
        ));
        line(" DATE.  : LOG DATE".to_owned());
        line(" UWI.  : UNIQUE WELL ID".to_owned());
        line("~Curve".to_owned());
        line(format!(" DEPT.{unit} : MEASURED DEPTH"));
        line(format!(" TVDSS.{unit} : DEPTH BELOW MEAN SEA LEVEL"));
        line(" VOLUME. : NUMBER OF THE VOLUME, SEE PARAMETERS".to_owned());
        line(" FACIES. : NUMBER OF THE FACIES, SEE PARAMETERS".to_owned());
        line(" PERF. : 1 WHERE THE WELL IS OPEN".to_owned());
        for curve in curves {
            line(format!(
                " {}.{} : {}",
                curve.mnemonic,
                curve.unit,
                one_line(&curve.about).to_uppercase()
            ));
        }
        line("~Parameter".to_owned());
        line(format!(
            " EREF.{unit} {} : ELEVATION OF THE DEPTH REFERENCE",
            self.spec.datum / self.spec.unit.metres
        ));
        line(format!(" SEED. {} : SEED OF THE MODEL", self.model.seed));
        for volume in self.volumes() {
            let name = one_line(&self.realisation.volumes[volume].name);
            line(format!(" V{volume}. {name} : VOLUME {volume}"));
        }
        let mut facies: Vec<usize> = self
            .volumes()
            .into_iter()
            .filter_map(|volume| self.facies(volume))
            .collect();
        facies.sort_unstable();
        facies.dedup();
        for at in facies {
            let name = one_line(&self.model.facies[at].name);
            line(format!(" F{}. {name} : FACIES {}", at + 1, at + 1));
        }
        line("~ASCII".to_owned());
        out
    }
}

/// The usual mnemonic and unit of a property; of one's own its name in capitals.
fn mnemonic(property: &str) -> (String, &'static str) {
    let (mnemonic, unit) = match property {
        "porosity" => ("PHI", "V/V"),
        "permeability" => ("K", "MD"),
        "net" => ("NET", "V/V"),
        "vsh" => ("VSH", "V/V"),
        "sw" => ("SW", "V/V"),
        _ => {
            let own: String = property
                .chars()
                .map(|c| {
                    if c.is_ascii_alphanumeric() {
                        c.to_ascii_uppercase()
                    } else {
                        '_'
                    }
                })
                .collect();
            return (own, "");
        }
    };
    (mnemonic.to_owned(), unit)
}

/// Text that is no delimiter of LAS: printable ASCII without a colon.
fn plain(text: &str) -> String {
    let plain = deunicode::deunicode(text);
    plain
        .chars()
        .map(|c| match c {
            ':' => '-',
            ' '..='~' => c,
            _ => ' ',
        })
        .collect()
}
