//! The language of formulas: text → program → value.
//!
//! Precedence is that of mathematics: `-s^2` is −(s²) and `2^3^2` is 2^(3²). (The ready-made parser that was tried first has
//! neither, nor 1e-3, nor max(0, min(1, s)).) A formula becomes a program for a small stack machine.
//!
//! ```text
//! sum = product (("+" | "-") product)*        power = atom ("^" sign)?
//! product = sign (("*" | "/") sign)*          atom = number | variable | "pi" | "(" sum ")"
//! sign = ("-" | "+") sign | power                  | function "(" sum ("," sum)* ")"
//! ```

use super::expression::ExpressionError;

/// Deeper nesting is refused; it bounds the recursion of the parser.
pub(super) const MAX_NESTING: usize = 32;

#[derive(Clone, Copy, Debug)]
pub(super) enum Function {
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
}

/// The functions, by name.
#[rustfmt::skip]
pub(super) const TABLE: [(&str, Function); FUNCTIONS.len()] = [
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

/// A step of the stack machine: takes its operands from the stack and leaves its result there.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
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

/// The program of a formula of `variable`.
pub(super) fn parse(text: &str, variable: &'static str) -> Result<Vec<Step>, ExpressionError> {
    let mut parser = Parser {
        tokens: tokens(text)?,
        next: 0,
        depth: 0,
        end: text.chars().count() + 1,
        variable,
        program: Vec::new(),
    };
    parser.sum()?;
    if parser.next < parser.tokens.len() {
        return Err(parser.needs("an operator or the end"));
    }
    Ok(parser.program)
}

/// The value of a program where the variable is `at`.
pub(super) fn run(program: &[Step], at: f64) -> f64 {
    let mut stack: Vec<f64> = Vec::with_capacity(8);
    for step in program {
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
    stack.pop().unwrap_or(f64::NAN)
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
