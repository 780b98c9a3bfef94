//! Prints the heights of a file as the readers see them, for cross-checks with programs that wrote it: x, y and height a line, and how many
//! nodes or points have none at the end.
//!
//! `heights FILE [FORMAT]`
#![allow(clippy::print_stdout, reason = "this is what it is for")]

use std::error::Error;

use clinothem::data::{self, Format, Reading};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("name a file")?;
    let reading = Reading {
        format: arguments.next().and_then(|word| Format::of_word(&word)),
        ..Reading::default()
    };
    let heights = data::read(&std::fs::read(file)?, &reading)?;
    for sample in heights.samples() {
        println!("{} {} {}", sample.at.x, sample.at.y, sample.at.z);
    }
    println!("nulls {}", heights.nulls());
    Ok(())
}
