//! OpenCASCADE operations that clinothem needs, as plain Rust types.
