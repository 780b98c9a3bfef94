//! What can go wrong, and how the kernel's words reach us.

use std::path::PathBuf;

/// An operation failed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BridgeError {
    /// OpenCASCADE threw an exception or gave no result.
    #[error("{operation}: OpenCASCADE failed: {message}")]
    Kernel {
        /// What was being done.
        operation: &'static str,
        /// OpenCASCADE's own words.
        message: String,
    },
    /// A Boolean operation ended with error alerts.
    #[error("{operation}: OpenCASCADE reports {}", alerts.join("; "))]
    Alerts {
        /// What was being done.
        operation: &'static str,
        /// Names of the alerts, how often, and the arguments they concern.
        alerts: Vec<String>,
    },
    /// Stopping was asked through a [`Cancel`](crate::Cancel).
    #[error("cancelled")]
    Cancelled,
    /// What was given cannot be used.
    #[error("{operation}: {message}")]
    Input {
        /// What was being done.
        operation: &'static str,
        /// Which value, where, and what is needed.
        message: String,
    },
    /// A file could not be read or written.
    #[error("{}: {message}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What failed.
        message: String,
    },
}

pub(crate) fn input(operation: &'static str, message: impl Into<String>) -> BridgeError {
    BridgeError::Input {
        operation,
        message: message.into(),
    }
}

/// Reads the kind of an error from the first word of its message (shim/failure.hpp).
pub(crate) fn from_kernel(operation: &'static str, error: &cxx::Exception) -> BridgeError {
    classify(operation, error.what())
}

/// The same for an operation on a file.
pub(crate) fn from_file(
    operation: &'static str,
    path: &std::path::Path,
    error: &cxx::Exception,
) -> BridgeError {
    match classify(operation, error.what()) {
        BridgeError::Kernel { message, .. } if error.what().starts_with("io:") => BridgeError::Io {
            path: path.to_path_buf(),
            message,
        },
        other => other,
    }
}

fn classify(operation: &'static str, text: &str) -> BridgeError {
    let (kind, rest) = text.split_once(':').unwrap_or(("", text));
    match kind {
        "cancelled" => BridgeError::Cancelled,
        "input" => input(operation, rest),
        "alerts" => BridgeError::Alerts {
            operation,
            alerts: rest.lines().map(str::to_owned).collect(),
        },
        "kernel" | "io" => BridgeError::Kernel {
            operation,
            message: rest.to_owned(),
        },
        _ => BridgeError::Kernel {
            operation,
            message: text.to_owned(),
        },
    }
}
