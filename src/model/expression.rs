//! Formulas of one variable, as `20 + 10 * sin(2 * pi * s)`.
//!
//! Parsed by `exmex`; a formula knows one variable (`s`, the fraction of the way along a trajectory, or `t`, the parameter
//! of a parametric trajectory) and the constant `pi`. Whether its values are finite is known only where it is evaluated.

use exmex::{Express, FlatEx};
use thiserror::Error;

/// Longer formulas are refused: nobody writes them by hand, and parsing is not linear in their length.
const MAX_LENGTH: usize = 1000;
/// Deeper parentheses are refused.
const MAX_NESTING: usize = 32;

/// The functions that a formula may call, for messages and docs.
pub const FUNCTIONS: [&str; 25] = [
    "abs", "acos", "asin", "atan", "atan2", "cbrt", "ceil", "cos", "cosh", "exp", "floor", "fract",
    "ln", "log10", "log2", "max", "min", "round", "signum", "sin", "sinh", "sqrt", "tan", "tanh",
    "trunc",
];

/// A formula of one variable.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    variable: &'static str,
    parsed: FlatEx<f64>,
}

impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text && self.variable == other.variable
    }
}

/// Why a text is not a formula.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ExpressionError {
    /// Nothing is written.
    #[error("the formula is empty")]
    Empty,
    /// Too long to be meant.
    #[error("the formula is {length} characters long, more than {MAX_LENGTH}")]
    TooLong {
        /// Its length.
        length: usize,
    },
    /// Too deep to be meant.
    #[error("the formula nests parentheses more than {MAX_NESTING} deep")]
    TooDeep,
    /// A character that no formula has.
    #[error("the formula contains {character:?}, which has no meaning there")]
    Character {
        /// The offending character.
        character: char,
    },
    /// A name that is neither the variable nor a function.
    #[error(
        "the formula uses `{name}`, which is neither its variable `{variable}`, nor `pi`, nor a function"
    )]
    Unknown {
        /// The unknown name.
        name: String,
        /// The variable that the formula may use.
        variable: &'static str,
    },
    /// The text is not a formula.
    #[error("the formula cannot be read: {reason}")]
    Syntax {
        /// The parser's words.
        reason: String,
    },
}

/// Why a formula has no value.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EvaluationError {
    /// The value is NaN or infinite.
    #[error("the formula `{formula}` is {value} at {variable} = {at}")]
    NotFinite {
        /// The formula.
        formula: String,
        /// Its variable.
        variable: &'static str,
        /// The value of the variable.
        at: f64,
        /// What the formula gives there.
        value: f64,
    },
    /// The evaluator failed.
    #[error("the formula `{formula}` cannot be evaluated: {reason}")]
    Failed {
        /// The formula.
        formula: String,
        /// The evaluator's words.
        reason: String,
    },
}

impl Expression {
    /// Reads a formula of `variable`.
    pub fn new(text: &str, variable: &'static str) -> Result<Self, ExpressionError> {
        let length = text.chars().count();
        if text.trim().is_empty() {
            return Err(ExpressionError::Empty);
        }
        if length > MAX_LENGTH {
            return Err(ExpressionError::TooLong { length });
        }
        let meaningless = |c: &char| !(c.is_ascii_alphanumeric() || " \t_.,+-*/^()".contains(*c));
        if let Some(character) = text.chars().find(meaningless) {
            return Err(ExpressionError::Character { character });
        }
        if nesting(text) > MAX_NESTING {
            return Err(ExpressionError::TooDeep);
        }
        let parsed = exmex::parse::<f64>(text).map_err(|error| ExpressionError::Syntax {
            reason: error.to_string(),
        })?;
        if let Some(name) = parsed
            .var_names()
            .iter()
            .find(|name| *name != variable && *name != "pi")
        {
            return Err(ExpressionError::Unknown {
                name: name.clone(),
                variable,
            });
        }
        Ok(Self {
            text: text.to_owned(),
            variable,
            parsed,
        })
    }

    /// The formula as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The name of its variable.
    pub fn variable(&self) -> &'static str {
        self.variable
    }

    /// Its value where the variable is `at`; finite, or an error.
    pub fn eval(&self, at: f64) -> Result<f64, EvaluationError> {
        let values: Vec<f64> = self
            .parsed
            .var_names()
            .iter()
            .map(|name| {
                if name == "pi" {
                    std::f64::consts::PI
                } else {
                    at
                }
            })
            .collect();
        let value = self
            .parsed
            .eval(&values)
            .map_err(|error| EvaluationError::Failed {
                formula: self.text.clone(),
                reason: error.to_string(),
            })?;
        if value.is_finite() {
            Ok(value)
        } else {
            Err(EvaluationError::NotFinite {
                formula: self.text.clone(),
                variable: self.variable,
                at,
                value,
            })
        }
    }
}

fn nesting(text: &str) -> usize {
    let (mut depth, mut deepest) = (0_usize, 0);
    for c in text.chars() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        deepest = deepest.max(depth);
    }
    deepest
}
