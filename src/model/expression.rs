//! Formulas of one variable, as `20 + 10 * sin(2 * pi * s)`.
//!
//! A formula knows one variable (`s`, the fraction of the way along a trajectory, or `t`, the parameter of a parametric
//! trajectory), the constant `pi`, and the [`FUNCTIONS`]. Precedence is that of mathematics: `-s^2` is −(s²) and `2^3^2` is
//! 2^(3²). (The ready-made parser that was tried first has neither, nor 1e-3, nor max(0, min(1, s)).) A formula is parsed
//! once, into a program for a small stack machine; whether its values are finite is known only where it is evaluated.
//!
//! ```text
//! sum = product (("+" | "-") product)*        power = atom ("^" sign)?
//! product = sign (("*" | "/") sign)*          atom = number | variable | "pi" | "(" sum ")"
//! sign = ("-" | "+") sign | power                  | function "(" sum ("," sum)* ")"
//! ```

use std::sync::Arc;

use thiserror::Error;

/// Longer formulas are refused: nobody writes them by hand.
const MAX_LENGTH: usize = 1000;
/// Deeper nesting is refused; it bounds the recursion of the parser.
const MAX_NESTING: usize = 32;

#[derive(Clone, Copy, Debug)]
enum Function {
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
}

/// The functions, by name.
#[rustfmt::skip]
const TABLE: [(&str, Function); FUNCTIONS.len()] = [
    ("abs", Function::One(f64::abs)),
    ("acos", Function::One(f64::acos)),
    ("asin", Function::One(f64::asin)),
    ("atan", Function::One(f64::atan)),
    ("atan2", Function::Two(f64::atan2)),
    ("cbrt", Function::One(f64::cbrt)),
    ("ceil", Function::One(f64::ceil)),
    ("cos", Function::One(f64::cos)),
    ("cosh", Function::One(f64::cosh)),
    ("exp", Function::One(f64::exp)),
    ("floor", Function::One(f64::floor)),
    ("ln", Function::One(f64::ln)),
    ("log10", Function::One(f64::log10)),
    ("log2", Function::One(f64::log2)),
    ("max", Function::Two(f64::max)),
    ("min", Function::Two(f64::min)),
    ("round", Function::One(f64::round)),
    ("sin", Function::One(f64::sin)),
    ("sinh", Function::One(f64::sinh)),
    ("sqrt", Function::One(f64::sqrt)),
    ("tan", Function::One(f64::tan)),
    ("tanh", Function::One(f64::tanh)),
];

/// The functions that a formula may call; angles are in radians.
pub const FUNCTIONS: [&str; 22] = [
    "abs", "acos", "asin", "atan", "atan2", "cbrt", "ceil", "cos", "cosh", "exp", "floor", "ln",
    "log10", "log2", "max", "min", "round", "sin", "sinh", "sqrt", "tan", "tanh",
];

/// A formula of one variable.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    variable: &'static str,
    /// Shared, since a formula is copied into every instance.
    program: Arc<[Step]>,
}

/// A step of the stack machine: takes its operands from the stack and leaves its result there.
#[derive(Clone, Copy, Debug)]
enum Step {
    Number(f64),
    Variable,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Call(Function),
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
        let mut parser = Parser {
            tokens: tokens(text)?,
            next: 0,
            depth: 0,
            end: length + 1,
            variable,
            program: Vec::new(),
        };
        parser.sum()?;
        if parser.next < parser.tokens.len() {
            return Err(parser.needs("an operator or the end"));
        }
        Ok(Self {
            text: text.to_owned(),
            variable,
            program: parser.program.into(),
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
        let mut stack: Vec<f64> = Vec::with_capacity(8);
        for step in self.program.iter() {
            // The parser leaves no step without its operands; a NaN would show if it did.
            let mut pop = || stack.pop().unwrap_or(f64::NAN);
            let value = match *step {
                Step::Number(value) => value,
                Step::Variable => at,
                Step::Negate => -pop(),
                Step::Call(Function::One(f)) => f(pop()),
                Step::Add
                | Step::Subtract
                | Step::Multiply
                | Step::Divide
                | Step::Power
                | Step::Call(Function::Two(_)) => {
                    let (b, a) = (pop(), pop());
                    binary(step, a, b)
                }
            };
            stack.push(value);
        }
        let value = stack.pop().unwrap_or(f64::NAN);
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

fn binary(step: &Step, a: f64, b: f64) -> f64 {
    match *step {
        Step::Add => a + b,
        Step::Subtract => a - b,
        Step::Multiply => a * b,
        Step::Divide => a / b,
        Step::Power => a.powf(b),
        Step::Call(Function::Two(f)) => f(a, b),
        Step::Number(_) | Step::Variable | Step::Negate | Step::Call(Function::One(_)) => f64::NAN,
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64),
    Name(String),
    /// One of `+ - * / ^ ( ) ,`.
    Sign(char),
}

/// The tokens of a formula, each with its place in characters from 1.
fn tokens(text: &str) -> Result<Vec<(usize, Token)>, ExpressionError> {
    let characters: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(&first) = characters.get(at) {
        let start = at;
        let run = |from: usize, belongs: fn(char) -> bool| {
            let rest = characters[from..].iter();
            from + rest.take_while(|c| belongs(**c)).count()
        };
        let token = if first.is_ascii_whitespace() {
            at += 1;
            continue;
        } else if first.is_ascii_digit() || first == '.' {
            at = run(at, |c| c.is_ascii_digit() || c == '.');
            if characters.get(at).is_some_and(|c| "eE".contains(*c)) {
                let sign = usize::from(characters.get(at + 1).is_some_and(|c| "+-".contains(*c)));
                at = run(at + 1 + sign, |c| c.is_ascii_digit());
            }
            let text: String = characters[start..at].iter().collect();
            match text.parse() {
                Ok(value) => Token::Number(value),
                Err(_) => return Err(ExpressionError::Number { text }),
            }
        } else if first.is_ascii_alphabetic() || first == '_' {
            at = run(at, |c| c.is_ascii_alphanumeric() || c == '_');
            Token::Name(characters[start..at].iter().collect())
        } else if "+-*/^(),".contains(first) {
            at += 1;
            Token::Sign(first)
        } else {
            return Err(ExpressionError::Character { character: first });
        };
        tokens.push((start + 1, token));
    }
    Ok(tokens)
}

struct Parser {
    tokens: Vec<(usize, Token)>,
    next: usize,
    depth: usize,
    /// The place after the last character.
    end: usize,
    variable: &'static str,
    program: Vec<Step>,
}

impl Parser {
    fn sum(&mut self) -> Result<(), ExpressionError> {
        self.product()?;
        while let Some(sign) = self.take(&['+', '-']) {
            self.product()?;
            let step = if sign == '+' {
                Step::Add
            } else {
                Step::Subtract
            };
            self.program.push(step);
        }
        Ok(())
    }

    fn product(&mut self) -> Result<(), ExpressionError> {
        self.sign()?;
        while let Some(sign) = self.take(&['*', '/']) {
            self.sign()?;
            let step = if sign == '*' {
                Step::Multiply
            } else {
                Step::Divide
            };
            self.program.push(step);
        }
        Ok(())
    }

    /// Every way down leads through here, so the depth is counted here.
    fn sign(&mut self) -> Result<(), ExpressionError> {
        self.depth += 1;
        if self.depth > MAX_NESTING {
            return Err(ExpressionError::TooDeep);
        }
        match self.take(&['-', '+']) {
            Some(sign) => {
                self.sign()?;
                if sign == '-' {
                    self.program.push(Step::Negate);
                }
            }
            None => self.power()?,
        }
        self.depth -= 1;
        Ok(())
    }

    fn power(&mut self) -> Result<(), ExpressionError> {
        self.atom()?;
        if self.take(&['^']).is_some() {
            self.sign()?;
            self.program.push(Step::Power);
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), ExpressionError> {
        match self.tokens.get(self.next).map(|(_, token)| token.clone()) {
            Some(Token::Number(value)) => {
                self.next += 1;
                self.program.push(Step::Number(value));
                Ok(())
            }
            Some(Token::Name(name)) => {
                self.next += 1;
                self.name(&name)
            }
            Some(Token::Sign('(')) => {
                self.next += 1;
                self.sum()?;
                self.expect(')')
            }
            _ => Err(self.needs("a number, a name or `(`")),
        }
    }

    fn name(&mut self, name: &str) -> Result<(), ExpressionError> {
        if name == self.variable {
            self.program.push(Step::Variable);
            return Ok(());
        }
        if name == "pi" {
            self.program.push(Step::Number(std::f64::consts::PI));
            return Ok(());
        }
        let Some((_, function)) = TABLE.iter().find(|(known, _)| *known == name) else {
            return Err(ExpressionError::Unknown {
                name: name.to_owned(),
                variable: self.variable,
            });
        };
        self.expect('(')?;
        self.sum()?;
        if matches!(function, Function::Two(_)) {
            self.expect(',')?;
            self.sum()?;
        }
        self.expect(')')?;
        self.program.push(Step::Call(*function));
        Ok(())
    }

    fn take(&mut self, signs: &[char]) -> Option<char> {
        match self.tokens.get(self.next) {
            Some((_, Token::Sign(sign))) if signs.contains(sign) => {
                self.next += 1;
                Some(*sign)
            }
            _ => None,
        }
    }

    fn expect(&mut self, sign: char) -> Result<(), ExpressionError> {
        match self.take(&[sign]) {
            Some(_) => Ok(()),
            None => Err(self.needs(&format!("`{sign}`"))),
        }
    }

    fn needs(&self, expected: &str) -> ExpressionError {
        let (position, found) = match self.tokens.get(self.next) {
            Some((position, Token::Number(value))) => (*position, format!("{value}")),
            Some((position, Token::Name(name))) => (*position, format!("`{name}`")),
            Some((position, Token::Sign(sign))) => (*position, format!("`{sign}`")),
            None => (self.end, "the end".to_owned()),
        };
        ExpressionError::Syntax {
            expected: expected.to_owned(),
            found,
            position,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use proptest::prelude::*;

    use super::{EvaluationError, Expression, ExpressionError, FUNCTIONS};

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
        assert_eq!(super::TABLE.map(|(name, _)| name), FUNCTIONS);
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
