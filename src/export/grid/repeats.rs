//! Numbers of a keyword as Eclipse's readers take them: `n*v` for a value that repeats, in lines of fewer than 128 characters.

use std::io::{self, Write};

/// Most characters of a line; readers ignore what follows the 128th.
const LONGEST: usize = 120;

/// Writes the values of one keyword.
pub(super) struct Repeats<'a> {
    to: &'a mut dyn Write,
    /// The value that was last, and how often it came.
    last: Option<(Vec<u8>, u64)>,
    /// The line so far.
    line: Vec<u8>,
}

impl<'a> Repeats<'a> {
    /// Begins a keyword.
    pub(super) fn new(to: &'a mut dyn Write, keyword: &str) -> io::Result<Self> {
        writeln!(to, "{keyword}")?;
        Ok(Self {
            to,
            last: None,
            line: Vec::with_capacity(LONGEST + 1),
        })
    }

    /// Adds a value some times.
    pub(super) fn add(&mut self, value: &[u8], times: u64) -> io::Result<()> {
        if let Some((last, count)) = &mut self.last {
            if last == value {
                *count += times;
                return Ok(());
            }
            self.put()?;
        }
        match &mut self.last {
            // Its room serves again.
            Some((last, count)) => {
                last.clear();
                last.extend_from_slice(value);
                *count = times;
            }
            None => self.last = Some((value.to_vec(), times)),
        }
        Ok(())
    }

    /// Writes the value that was last.
    fn put(&mut self) -> io::Result<()> {
        let Some((value, count)) = &self.last else {
            return Ok(());
        };
        let repeat = if *count == 1 {
            String::new()
        } else {
            format!("{count}*")
        };
        let length = repeat.len() + value.len();
        if !self.line.is_empty() && self.line.len() + 1 + length > LONGEST {
            self.line.push(b'\n');
            self.to.write_all(&self.line)?;
            self.line.clear();
        }
        self.line.push(b' ');
        self.line.extend_from_slice(repeat.as_bytes());
        self.line.extend_from_slice(value);
        Ok(())
    }

    /// Ends the keyword.
    pub(super) fn end(mut self) -> io::Result<()> {
        self.put()?;
        self.line.extend_from_slice(b"\n/\n\n");
        self.to.write_all(&self.line)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    fn written(values: &[(&str, u64)]) -> String {
        let mut out = Vec::new();
        let mut repeats = Repeats::new(&mut out, "PORO").unwrap();
        for (value, times) in values {
            repeats.add(value.as_bytes(), *times).unwrap();
        }
        repeats.end().unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn equal_values_that_follow_each_other_are_one_repeat() {
        let values = [("0.1", 1), ("0.1", 2), ("0.2", 1), ("0.1", 1)];
        assert_eq!(written(&values), "PORO\n 3*0.1 0.2 0.1\n/\n\n");
        assert_eq!(written(&[("1", 7)]), "PORO\n 7*1\n/\n\n");
    }

    #[test]
    fn lines_are_shorter_than_readers_look_and_lose_nothing() {
        let numbers: Vec<String> = (0..1000).map(|n| format!("{}.125", n * n)).collect();
        let values: Vec<(&str, u64)> = numbers.iter().map(|n| (n.as_str(), 1)).collect();
        let text = written(&values);
        assert!(text.lines().all(|line| line.len() < 128));
        let read: Vec<&str> = text
            .lines()
            .skip(1)
            .flat_map(str::split_whitespace)
            .collect();
        assert_eq!(read[..1000], numbers[..]);
        assert_eq!(read[1000..], ["/"]);
    }
}
