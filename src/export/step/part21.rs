//! How the entities of an exchange file (ISO 10303-21) and their values are spelt.
//!
//! Numbers have the fewest digits that give the same number back.

use std::fmt::{self, Display, Write as _};

/// References on one line of a list.
const PER_LINE: usize = 10;
/// The number of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Id(pub(super) usize);

impl Id {
    /// The entity that is so many places after this one.
    pub(super) fn after(self, places: usize) -> Self {
        Self(self.0 + places)
    }
}

impl Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// References in brackets.
pub(super) struct List<'a>(pub(super) &'a [Id]);

impl Display for List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('(')?;
        for (at, id) in self.0.iter().enumerate() {
            f.write_str(separator(at))?;
            write!(f, "{id}")?;
        }
        f.write_char(')')
    }
}

/// What comes before an entry of a list.
fn separator(at: usize) -> &'static str {
    match at {
        0 => "",
        _ if at.is_multiple_of(PER_LINE) => ",\n",
        _ => ",",
    }
}

/// A string in quotes: quotes and backslashes doubled, what is not ASCII by its number, in four digits of \\X2\\ or, beyond these,
/// in eight of \\X4\\.
pub(super) struct Quoted<'a>(pub(super) &'a str);

impl Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // How the characters of a run are spelt.
        let spelling = |c: char| match c {
            ' '..='~' => "",
            '\0'..='\u{ffff}' => "\\X2\\",
            _ => "\\X4\\",
        };
        let mut run = "";
        let mut change = |f: &mut fmt::Formatter<'_>, to: &'static str| {
            if run != to {
                f.write_str(if run.is_empty() { "" } else { "\\X0\\" })?;
                f.write_str(to)?;
                run = to;
            }
            Ok(())
        };
        f.write_char('\'')?;
        for c in self.0.chars() {
            change(f, spelling(c))?;
            match (c, spelling(c)) {
                ('\'' | '\\', _) => write!(f, "{c}{c}")?,
                (c, "") => f.write_char(c)?,
                (c, "\\X2\\") => write!(f, "{:04X}", u32::from(c))?,
                (c, _) => write!(f, "{:08X}", u32::from(c))?,
            }
        }
        change(f, "")?;
        f.write_char('\'')
    }
}

/// True or false.
pub(super) struct Logical(pub(super) bool);

impl Display for Logical {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0 { ".T." } else { ".F." })
    }
}

/// Text that only grows.
#[derive(Debug, Default)]
pub(super) struct Text(pub(super) String);

impl Text {
    pub(super) fn push(&mut self, text: &str) {
        self.0.push_str(text);
    }

    pub(super) fn format(&mut self, text: fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.0.write_fmt(text);
    }

    pub(super) fn whole(&mut self, mut number: usize) {
        let mut digits = [0; 20];
        let mut at = digits.len();
        loop {
            at -= 1;
            digits[at] = b"0123456789"[number % 10];
            number /= 10;
            if number == 0 {
                break;
            }
        }
        self.0
            .extend(digits[at..].iter().map(|digit| char::from(*digit)));
    }

    /// A finite number, always with a point: `1000.`, `-0.5`, `1.E-7`.
    pub(super) fn real(&mut self, value: f64) {
        let mut buffer = ryu::Buffer::new();
        let text = buffer.format_finite(value);
        let (digits, exponent) = match text.split_once('e') {
            Some((digits, exponent)) => (digits, Some(exponent)),
            None => (text, None),
        };
        match digits.strip_suffix(".0") {
            Some(whole) => self.format(format_args!("{whole}.")),
            None => self.push(digits),
        }
        if !digits.contains('.') {
            self.push(".");
        }
        if let Some(exponent) = exponent {
            self.push("E");
            self.push(exponent);
        }
    }

    /// Values in brackets.
    pub(super) fn list<T>(
        &mut self,
        values: impl IntoIterator<Item = T>,
        write: impl Fn(&mut Self, T),
    ) {
        self.push("(");
        for (at, value) in values.into_iter().enumerate() {
            self.push(separator(at));
            write(self, value);
        }
        self.push(")");
    }

    /// Numbers in brackets.
    pub(super) fn reals(&mut self, values: &[f64]) {
        self.list(values.iter().copied(), Self::real);
    }

    /// Counts in brackets.
    pub(super) fn wholes(&mut self, values: &[usize]) {
        self.list(values.iter().copied(), Self::whole);
    }

    /// References to successive entities, in brackets.
    pub(super) fn run(&mut self, first: Id, count: usize) {
        self.list(0..count, |to, at| {
            to.push("#");
            to.whole(first.0 + at);
        });
    }

    /// `#n=`.
    pub(super) fn begin(&mut self, id: Id) {
        self.push("#");
        self.whole(id.0);
        self.push("=");
    }

    /// The end of an entity.
    pub(super) fn end(&mut self) {
        self.push(";\n");
    }

    /// A whole entity.
    pub(super) fn entity(&mut self, id: Id, body: fmt::Arguments<'_>) {
        self.begin(id);
        self.format(body);
        self.end();
    }
}
