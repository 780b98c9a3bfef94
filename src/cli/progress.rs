//! Progress on standard error: a bar per stage; silent if it is no terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

#[cfg(feature = "occt")]
use crate::assembly::Stage;

/// A bar of so many steps; hidden when quiet, or when standard error is no terminal, and then nothing moves by itself either, which
/// would take a thread.
pub(super) fn bar(quiet: bool, steps: u64, template: &str) -> ProgressBar {
    let target = if quiet {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    };
    let bar = ProgressBar::with_draw_target(Some(steps), target);
    let style = ProgressStyle::with_template(template);
    bar.set_style(
        style
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .progress_chars("=> "),
    );
    if !bar.is_hidden() {
        bar.enable_steady_tick(Duration::from_millis(250));
    }
    bar
}

/// A bar that shows the stage, its share and the time it takes.
pub(super) struct Progress {
    bar: ProgressBar,
}

/// Steps of a stage's bar.
const STEPS: u64 = 100;

impl Progress {
    /// Hidden when quiet.
    pub(super) fn new(quiet: bool) -> Self {
        let template = "{msg:12} [{bar:30}] {percent:>3} %  {elapsed}";
        Self {
            bar: bar(quiet, STEPS, template),
        }
    }

    /// A stage that has no share.
    pub(super) fn stage(&self, name: &'static str) {
        self.bar.set_message(name);
        self.bar.set_position(0);
    }

    /// A stage's share, from any thread.
    #[cfg(feature = "occt")]
    pub(super) fn share(&self, stage: Stage, fraction: f64) {
        self.bar.set_message(match stage {
            Stage::Assemble => "assembling",
            Stage::Prove => "proving",
        });
        self.part(fraction);
    }

    /// The share of the stage that was named last.
    pub(super) fn part(&self, fraction: f64) {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped"
        )]
        self.bar
            .set_position((fraction.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }

    /// Lets something be printed without the bar in its way.
    #[cfg(feature = "occt")]
    pub(super) fn aside(&self, print: impl FnOnce()) {
        self.bar.suspend(print);
    }

    /// Removes the bar.
    pub(super) fn done(&self) {
        self.bar.finish_and_clear();
    }
}
