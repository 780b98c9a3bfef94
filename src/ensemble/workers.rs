//! Worker processes: one of the program's own for each realisation, with limits of time and memory.
//!
//! A crash, a hang or a realisation that wants too much memory ends its own process and nothing else. What ended so is tried once
//! more, since it may have been the machine's fault; what the program refused is not, since it would be refused again.
//! A worker ends when its standard input does, and so with a parent that is killed.

use std::collections::VecDeque;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::folder::{Folder, Settled};
use super::member::Member;
use crate::assembly::Cancel;

/// The hidden command by which the program starts itself.
pub const COMMAND: &str = "ensemble-worker";

/// How often a realisation is tried.
const ATTEMPTS: u32 = 2;

/// Exit codes of an answer: the model or the arguments are wrong, the assembly could not be proven.
const ANSWERS: [i32; 2] = [1, 2];

/// The exit code of what is no matter of the model: a full disk, a missing permission, a model file that was changed meanwhile.
const SURROUNDINGS: i32 = 3;

/// The shortest and the longest time between two looks at a worker.
const PATIENCE: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(20)];

/// How much of a worker's last words is kept, in bytes.
const LONGEST_WORDS: usize = 2000;

/// What all workers are started with.
#[derive(Clone, Debug)]
pub struct Job {
    /// The program: one that has [`COMMAND`].
    pub program: PathBuf,
    /// The model.
    pub model: PathBuf,
    /// The SHA-256 of the model file; a worker that finds another one refuses it.
    pub sha256: String,
    /// What the members have in common, as arguments of `build`.
    pub arguments: Vec<String>,
    /// What tells this ensemble's members from those of another one.
    pub common: String,
    /// How long a realisation may take.
    pub time_limit: Duration,
    /// How much memory it may have, in bytes of its address space.
    pub memory_limit: Option<u64>,
    /// Workers at a time.
    pub workers: usize,
    /// Threads of each.
    pub threads: usize,
}

/// How a member ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// It was made, or refused.
    Settled(Settled),
    /// Its process ended abnormally, twice.
    Crashed(String),
    /// It took too long, twice.
    TooLong(Duration),
    /// It wanted more memory than it may have, twice.
    OutOfMemory(u64),
    /// Its surroundings failed, twice; they would fail every other one, too.
    Surroundings(String),
}

impl End {
    /// One word for it.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Settled(Settled::Made) => "made",
            Self::Settled(Settled::Refused { .. }) => "refused",
            Self::Crashed(_) => "crashed",
            Self::TooLong(_) => "time limit",
            Self::OutOfMemory(_) => "memory limit",
            Self::Surroundings(_) => "surroundings",
        }
    }

    /// What there is to be said of it.
    pub fn words(&self) -> String {
        match self {
            Self::Settled(Settled::Made) => String::new(),
            Self::Settled(Settled::Refused { words, .. })
            | Self::Crashed(words)
            | Self::Surroundings(words) => words.clone(),
            Self::TooLong(limit) => {
                let seconds = limit.as_secs_f64();
                format!("it took longer than {seconds} s; allow more with --time-limit")
            }
            Self::OutOfMemory(limit) => {
                let mebibytes = limit / 1024 / 1024;
                format!(
                    "it wanted more than {mebibytes} MiB; allow more with --memory-limit, or take fewer --workers"
                )
            }
        }
    }
}

/// A member that has ended.
#[derive(Clone, Debug)]
pub struct Ended {
    /// Its place in the list of members.
    pub member: usize,
    /// How.
    pub end: End,
    /// How often it was tried.
    pub attempts: u32,
    /// How long all of that took.
    pub took: Duration,
}

/// Why workers could not go on.
#[derive(Debug, thiserror::Error)]
pub enum WorkersError {
    /// They were told to stop.
    #[error("interrupted")]
    Cancelled,
    /// A process could not be started.
    #[error(
        "the program could not be started again: {0}; end other programs, or take fewer --workers"
    )]
    Start(io::Error),
    /// A process could not do what it does, through no fault of the model.
    #[error("realisation {member}: {words}")]
    Surroundings {
        /// The realisation.
        member: String,
        /// Its last words.
        words: String,
    },
    /// A file could not be written or moved.
    #[error("cannot write to {}: {source}", path.display())]
    Io {
        /// Where.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

/// Makes members, those of the places `due`, in the order of the list; `tell` hears of each that has ended, in the order of their
/// ends. The ends are in the order of the list.
pub fn make(
    members: &[Member],
    due: &[usize],
    job: &Job,
    folder: &Folder,
    cancel: &Cancel,
    tell: &(dyn Fn(&Ended) + Sync),
) -> Result<Vec<Ended>, WorkersError> {
    let queue: Mutex<VecDeque<usize>> = Mutex::new(due.iter().copied().collect());
    let ended: Mutex<Vec<Ended>> = Mutex::default();
    let failed: Mutex<Option<WorkersError>> = Mutex::default();
    // A function of its own, so that nobody holds the queue while a member is made.
    let next = || lock(&queue).pop_front();
    let work = || {
        while let Some(at) = next() {
            match settle(at, &members[at], job, folder, cancel) {
                Ok(end) => {
                    tell(&end);
                    lock(&ended).push(end);
                }
                Err(error) => {
                    // What is in the making elsewhere is finished; nothing more is begun.
                    lock(&queue).clear();
                    lock(&failed).get_or_insert(error);
                }
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..job.workers.clamp(1, due.len().max(1)) {
            let started = std::thread::Builder::new().spawn_scoped(scope, work);
            if let Err(error) = started {
                lock(&queue).clear();
                lock(&failed).get_or_insert(WorkersError::Start(error));
            }
        }
    });
    if let Some(error) = lock(&failed).take() {
        return Err(error);
    }
    if cancel.is_cancelled() {
        return Err(WorkersError::Cancelled);
    }
    let mut ended = std::mem::take(&mut *lock(&ended));
    ended.sort_by_key(|one| one.member);
    Ok(ended)
}

/// A lock that is held only to put something in or take something out, which leaves nothing half-done.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a member, and puts what there is of it in its place.
fn settle(
    at: usize,
    member: &Member,
    job: &Job,
    folder: &Folder,
    cancel: &Cancel,
) -> Result<Ended, WorkersError> {
    let io = |source: io::Error| WorkersError::Io {
        path: folder.of(member),
        source,
    };
    let started = Instant::now();
    let mut attempts = 0;
    let end = loop {
        attempts += 1;
        folder.forget(member).map_err(io)?;
        let end = attempt(member, job, folder, cancel)?;
        if matches!(end, End::Settled(_)) || attempts == ATTEMPTS {
            break end;
        }
    };
    match &end {
        End::Settled(outcome) => folder
            .settle(member, member.key(&job.common), outcome.clone())
            .map_err(io)?,
        End::Surroundings(words) => {
            folder.forget(member).map_err(io)?;
            return Err(WorkersError::Surroundings {
                member: member.name(),
                words: words.clone(),
            });
        }
        _ => folder.forget(member).map_err(io)?,
    }
    Ok(Ended {
        member: at,
        end,
        attempts,
        took: started.elapsed(),
    })
}

/// One process, from its start to its end.
fn attempt(
    member: &Member,
    job: &Job,
    folder: &Folder,
    cancel: &Cancel,
) -> Result<End, WorkersError> {
    let output = folder.unfinished(member);
    let log = output.with_extension("log");
    let io = |source: io::Error| WorkersError::Io {
        path: log.clone(),
        source,
    };
    let words = File::create(&log).map_err(io)?;
    let mut command = Command::new(&job.program);
    command.arg(COMMAND);
    if let Some(bytes) = job.memory_limit {
        command.arg(format!("--memory-limit={bytes}"));
    }
    command
        .arg(format!("--sha256={}", job.sha256))
        .args(&job.arguments)
        .args(member.arguments())
        .arg(format!("--threads={}", job.threads))
        .arg("-o")
        .arg(&output)
        .arg("--")
        .arg(&job.model)
        // Threads of the program that know no option; each takes address space of its own.
        .env("RAYON_NUM_THREADS", job.threads.to_string())
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(words);
    let mut child = command.spawn().map_err(WorkersError::Start)?;
    // Open as long as this process lives and waits.
    let _input = child.stdin.take();
    let waited = wait(&mut child, job.time_limit, cancel);
    if !matches!(waited, Ok(Some(_))) {
        // Already ended, or to be ended: nothing is left to wait for.
        drop(child.kill());
        drop(child.wait());
    }
    let said = last_words(&log);
    drop(fs::remove_file(&log));
    if cancel.is_cancelled() {
        return Err(WorkersError::Cancelled);
    }
    match waited.map_err(WorkersError::Start)? {
        None => Ok(End::TooLong(job.time_limit)),
        Some(status) => Ok(end_of(status, said, job.memory_limit)),
    }
}

/// Waits until a process ends, takes too long (then nothing) or is no longer wanted.
fn wait(
    child: &mut std::process::Child,
    limit: Duration,
    cancel: &Cancel,
) -> io::Result<Option<ExitStatus>> {
    let started = Instant::now();
    let mut patience = PATIENCE[0];
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if cancel.is_cancelled() || started.elapsed() > limit {
            return Ok(None);
        }
        std::thread::sleep(patience);
        patience = (patience * 2).min(PATIENCE[1]);
    }
}

fn end_of(status: ExitStatus, words: String, memory_limit: Option<u64>) -> End {
    let code = status.code();
    if status.success() {
        return End::Settled(Settled::Made);
    }
    // A thread takes address space, too.
    let signs = [
        "memory allocation of",
        "bad_alloc",
        "Cannot allocate memory",
        "starts no threads",
        "no thread can be started",
    ];
    let wants_memory = signs.iter().any(|sign| words.contains(sign));
    match (code, memory_limit) {
        (_, Some(limit)) if wants_memory => End::OutOfMemory(limit),
        (Some(code), _) if ANSWERS.contains(&code) => {
            End::Settled(Settled::Refused { code, words })
        }
        (Some(SURROUNDINGS), _) if !words.is_empty() => End::Surroundings(words),
        _ if words.is_empty() => End::Crashed(format!("its process ended abnormally ({status})")),
        _ => End::Crashed(format!("its process ended abnormally ({status}): {words}")),
    }
}

/// The end of what a worker said.
fn last_words(log: &Path) -> String {
    // Words are for people; without them the exit status still tells.
    let bytes = fs::read(log).unwrap_or_default();
    let start = bytes.len().saturating_sub(LONGEST_WORDS);
    let text = String::from_utf8_lossy(&bytes[start..]);
    text.trim().trim_start_matches("error: ").to_owned()
}

/// Lets this process have no more memory than so many bytes of address space, where the system knows such limits.
pub fn limit_memory(bytes: u64) -> io::Result<()> {
    #[cfg(unix)]
    {
        use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
        let maximum = getrlimit(Resource::As).maximum;
        let bytes = maximum.map_or(bytes, |most| bytes.min(most));
        let limit = Rlimit {
            current: Some(bytes),
            maximum,
        };
        setrlimit(Resource::As, limit)?;
    }
    #[cfg(not(unix))]
    let _ = bytes;
    Ok(())
}

/// The memory of the machine in bytes, where the system tells (Linux).
pub fn memory_of_the_machine() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}
