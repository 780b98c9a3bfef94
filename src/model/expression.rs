//! Formulas of one variable, as `20 + 10 * sin(2 * pi * s)`.
//!
//! A formula knows one variable (`s`, the fraction of the way along a trajectory, or `t`, the parameter of a parametric
//! trajectory), the constant `pi`, and some [`FUNCTIONS`](super::FUNCTIONS). It is parsed once; whether its values are finite
//! is known only where it is evaluated.

use std::sync::Arc;

use thiserror::Error;

use super::formula::{self, MAX_NESTING, Step};

/// Longer formulas are refused: nobody writes them by hand.
const MAX_LENGTH: usize = 1000;
/// A formula of one variable.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    variable: &'static str,
    /// Shared, since a formula is copied into every instance.
    program: Arc<[Step]>,
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
    #[error("the formula nests more than {MAX_NESTING} deep")]
    TooDeep,
    /// A character that no formula has.
    #[error("the formula contains {character:?}, which has no meaning in a formula")]
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
    /// A number that cannot be read.
    #[error("the formula contains {text}, which is not a number")]
    Number {
        /// What stands there.
        text: String,
    },
    /// Something else was needed.
    #[error("the formula needs {expected} at character {position}, but has {found}")]
    Syntax {
        /// What was needed.
        expected: String,
        /// What stands there.
        found: String,
        /// Where, in characters from 1.
        position: usize,
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
        Ok(Self {
            text: text.to_owned(),
            variable,
            program: formula::parse(text, variable)?.into(),
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
        let value = formula::run(&self.program, at);
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use proptest::prelude::*;

    use super::{EvaluationError, Expression, ExpressionError};
    use crate::model::FUNCTIONS;

    fn at(text: &str, s: f64) -> f64 {
        Expression::new(text, "s").unwrap().eval(s).unwrap()
    }

    #[test]
    fn formulas_have_the_values_of_their_closed_forms() {
        assert_eq!(at("30 - 10 * s", 0.25), 27.5);
        assert_eq!(at("2 + 3 * 4 ^ 2 / 8", 0.0), 8.0);
        assert_eq!(at("-s ^ 2", 3.0), -9.0);
        assert_eq!(at("2 ^ 3 ^ 2", 0.0), 512.0);
        assert_eq!(at("s ^ -1", 4.0), 0.25);
        assert_eq!(at("8 / 4 / 2 - 1 - 1", 0.0), -1.0);
        assert_eq!(at("2 * -s + (1 - -s)", 3.0), -2.0);
        assert_eq!(at("max(0, min(1, s))", 3.0), 1.0);
        assert_eq!(at("atan2(1, 0)", 0.0), std::f64::consts::FRAC_PI_2);
        assert_eq!(at("1e1 + 1.5E-1", 0.0), 10.15);
        assert!((at("20 + 10 * sin(2 * pi * s)", 0.25) - 30.0).abs() < 1e-12);
        assert_eq!(at("max(s, 0.5) - min(s, 0.5)", 0.75), 0.25);
        assert!((at("sqrt(2) * cos(pi / 4)", 0.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn every_listed_function_can_be_called() {
        for name in FUNCTIONS {
            let call = match name {
                "atan2" | "max" | "min" => format!("{name}(s, 0.5)"),
                _ => format!("{name}(s)"),
            };
            assert!(at(&call, 0.5).is_finite(), "{call}");
        }
    }

    #[test]
    fn a_formula_knows_its_variable_and_nothing_else() {
        for (text, name) in [
            ("t", "t"),
            ("2 * x", "x"),
            ("PI", "PI"),
            ("e + 1", "e"),
            ("sin2(s)", "sin2"),
        ] {
            let refused = Expression::new(text, "s").unwrap_err();
            let expected = ExpressionError::Unknown {
                name: name.to_owned(),
                variable: "s",
            };
            assert_eq!(refused, expected);
        }
    }

    #[test]
    fn the_list_of_functions_is_the_table_of_functions() {
        assert_eq!(
            crate::model::formula::TABLE.map(|(name, _)| name),
            FUNCTIONS
        );
    }

    #[test]
    fn a_broken_formula_is_refused_where_it_breaks() {
        for (text, words) in [
            (
                "20 + * 3",
                "a number, a name or `(` at character 6, but has `*`",
            ),
            ("2 s", "an operator or the end at character 3, but has `s`"),
            ("sin s", "`(` at character 5, but has `s`"),
            ("min(s)", "`,` at character 6, but has `)`"),
            ("(s + 1", "`)` at character 7, but has the end"),
            (
                "s +",
                "a number, a name or `(` at character 4, but has the end",
            ),
            ("1.2.3", "1.2.3, which is not a number"),
            ("2 % s", "'%'"),
        ] {
            let said = Expression::new(text, "s").unwrap_err().to_string();
            assert!(said.contains(words), "{text}: {said}");
        }
    }

    #[test]
    fn values_that_are_not_finite_are_errors() {
        let formula = Expression::new("1 / s", "s").unwrap();
        assert!(matches!(
            formula.eval(0.0),
            Err(EvaluationError::NotFinite { at: 0.0, .. })
        ));
        assert_eq!(formula.eval(0.5), Ok(2.0));
    }

    proptest! {
        #[test]
        fn no_text_makes_the_parser_panic(text in "[st0-9pi.e+*/^(), -]{0,40}|.{0,40}|((sin|max|atan2|s|pi|1|2\\.5|\\(|\\)|,|\\+|-|\\*|/|\\^) ?){0,24}") {
            if let Ok(formula) = Expression::new(&text, "s") {
                let _ = formula.eval(0.5);
            }
        }
    }
}
