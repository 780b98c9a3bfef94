//! The general fuse in a child process with a time limit.
//!
//! OpenCASCADE can crash or hang on input that it does not like. The fuse therefore runs in a second
//! process of this program, so that either is an error with the features' names and never the end of
//! the run. The job goes in by standard input, progress comes back line by line on standard output, and
//! the result is a file in a directory of the parent's. A child whose parent is gone ends too.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::kernel::{Cancel, FuseError, FuseJob, FuseReport, Solids, fuse};
use super::unfinished::{self, Unfinished};

/// The hidden command by which the program starts itself.
pub const COMMAND: &str = "fuse-worker";

/// How the parent starts its child.
#[derive(Clone, Debug)]
pub struct Child {
    /// The program to start: one whose [`COMMAND`] calls [`serve`].
    pub program: PathBuf,
    /// After this the child is ended; none: as long as a fuse of so many bodies may take.
    pub time_limit: Option<Duration>,
}

/// What the names of its folders for results begin with.
const FOLDERS: &str = "clinothem-fuse-";

/// Removes what runs that were killed have left among the temporary files.
pub fn clear_abandoned() {
    // Whatever cannot be read or removed is in nobody's way.
    drop(unfinished::clear(&std::env::temp_dir(), FOLDERS));
}

/// How often the parent looks for a request to stop.
const PATIENCE: Duration = Duration::from_millis(50);

#[derive(Serialize, Deserialize)]
enum Answer {
    Fused { solids: Vec<u8>, report: FuseReport },
    Failed(FuseError),
}

/// Why the child brought no answer.
#[derive(Debug, thiserror::Error)]
pub enum WorkerError {
    /// It was ended by a signal, as a crash is.
    #[error("the kernel's process ended abnormally ({0})")]
    Crashed(String),
    /// It took too long.
    #[error("the kernel took longer than {} s and was stopped", .0.as_secs())]
    TooLong(Duration),
    /// Processes or files failed.
    #[error("the kernel's process could not be used: {0}")]
    Io(#[from] std::io::Error),
    /// The answer is not one of ours.
    #[error("the kernel's process gave an answer that cannot be read: {0}")]
    Answer(String),
}

/// What a fuse came to: an outer error of the process, or an inner one of the kernel.
pub(crate) type Outcome = Result<Result<(Solids, FuseReport), FuseError>, WorkerError>;

/// Runs a job in a child process, passing on its progress, until it answers, fails, takes longer than it may or is
/// cancelled.
pub(crate) fn run(
    job: &FuseJob,
    (program, limit): (&Path, Duration),
    cancel: &Cancel,
    progress: &(dyn Fn(f64) + Sync),
) -> Outcome {
    let folder = Unfinished::new(&std::env::temp_dir(), FOLDERS)?;
    let result = folder.path().join("fused");
    let mut child = Command::new(program)
        .arg(COMMAND)
        .arg(&result)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let outcome = supervise(&mut child, job, limit, cancel, progress);
    if outcome.is_err() || matches!(outcome, Ok(Err(FuseError::Cancelled))) {
        // Already ended, or to be ended: both are fine, and nothing is left to wait for.
        drop(child.kill());
        drop(child.wait());
    }
    outcome.and_then(|ended| match ended {
        Ok(()) => read_answer(&result),
        Err(error) => Ok(Err(error)),
    })
}

/// Feeds the child and follows its progress until it exits.
fn supervise(
    child: &mut std::process::Child,
    job: &FuseJob,
    limit: Duration,
    cancel: &Cancel,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Result<(), FuseError>, WorkerError> {
    let started = Instant::now();
    let bytes = postcard::to_stdvec(job).map_err(|error| WorkerError::Answer(error.to_string()))?;
    let (Some(mut input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
        return Err(WorkerError::Answer(
            "it has no standard input or output".to_owned(),
        ));
    };
    let length = (bytes.len() as u64).to_le_bytes();
    std::thread::scope(|scope| {
        let thread = || std::thread::Builder::new();
        let (fed, _open) = mpsc::channel();
        // A child that dies while it is fed closes its end: its exit status says more than this error.
        let feed = move || {
            drop(
                input
                    .write_all(&length)
                    .and_then(|()| input.write_all(&bytes)),
            );
            // Its input stays open as long as somebody waits for it.
            drop(fed.send(input));
        };
        let (send, receive) = mpsc::channel();
        let listen = move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    break;
                }
            }
        };
        let started_all = thread()
            .spawn_scoped(scope, feed)
            .and_then(|_| thread().spawn_scoped(scope, listen));
        if let Err(error) = started_all {
            // What was started waits for the child.
            drop(child.kill());
            return Err(error.into());
        }
        loop {
            if cancel.is_cancelled() {
                drop(child.kill());
                return Ok(Err(FuseError::Cancelled));
            }
            if started.elapsed() > limit {
                drop(child.kill());
                return Err(WorkerError::TooLong(limit));
            }
            match receive.recv_timeout(PATIENCE) {
                Ok(line) => {
                    if let Ok(fraction) = line.parse() {
                        progress(fraction);
                    }
                }
                Err(mpsc::RecvTimeoutError::Timeout) => {}
                Err(mpsc::RecvTimeoutError::Disconnected) => break,
            }
        }
        let status = child.wait()?;
        if status.success() {
            Ok(Ok(()))
        } else {
            Err(WorkerError::Crashed(status.to_string()))
        }
    })
}

fn read_answer(path: &Path) -> Outcome {
    let bytes = std::fs::read(path)?;
    let unreadable = |error: &dyn std::fmt::Display| WorkerError::Answer(error.to_string());
    match postcard::from_bytes(&bytes).map_err(|error| unreadable(&error))? {
        Answer::Failed(error) => Ok(Err(error)),
        Answer::Fused { solids, report } => {
            let solids = Solids::from_bytes(&solids).map_err(|error| unreadable(&error))?;
            Ok(Ok((solids, report)))
        }
    }
}

/// A job, after its length in bytes.
fn read_job(input: &mut impl Read) -> std::io::Result<Vec<u8>> {
    let mut length = [0; 8];
    input.read_exact(&mut length)?;
    let length = u64::from_le_bytes(length);
    let mut bytes = Vec::new();
    let read = input.take(length).read_to_end(&mut bytes)?;
    if read as u64 == length {
        Ok(bytes)
    } else {
        Err(std::io::ErrorKind::UnexpectedEof.into())
    }
}

/// Ends this process when its standard input ends, which it does when the parent has ended or wants nothing more: the kernel may
/// not look at a request to stop for hours.
pub fn end_with_the_parent() -> std::io::Result<()> {
    let wait = || {
        let mut rest = Vec::new();
        drop(std::io::stdin().lock().read_to_end(&mut rest));
        std::process::exit(1);
    };
    std::thread::Builder::new().spawn(wait).map(drop)
}

/// The child's side: reads a job from standard input, writes the answer to `result`.
pub fn serve(result: &Path) -> Result<(), WorkerError> {
    let bytes = read_job(&mut std::io::stdin().lock())?;
    end_with_the_parent()?;
    let job: FuseJob =
        postcard::from_bytes(&bytes).map_err(|error| WorkerError::Answer(error.to_string()))?;
    let last = std::sync::atomic::AtomicU32::new(0);
    let progress = |fraction: f64| {
        // Whole percents only: the kernel reports far more often than anybody looks.
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped"
        )]
        let percent = (fraction.clamp(0.0, 1.0) * 100.0) as u32;
        if last.fetch_max(percent, std::sync::atomic::Ordering::Relaxed) < percent {
            let mut out = std::io::stdout().lock();
            // If nobody listens any more the parent is gone; the result is then nobody's either.
            drop(writeln!(out, "{}", f64::from(percent) / 100.0).and_then(|()| out.flush()));
        }
    };
    let answer = match fuse(&job, &Cancel::new(), &progress) {
        Ok((solids, report)) => {
            let solids = solids
                .to_bytes()
                .map_err(|error| WorkerError::Answer(error.to_string()))?;
            Answer::Fused { solids, report }
        }
        Err(error) => Answer::Failed(error),
    };
    let bytes =
        postcard::to_stdvec(&answer).map_err(|error| WorkerError::Answer(error.to_string()))?;
    std::fs::write(result, bytes)?;
    Ok(())
}
