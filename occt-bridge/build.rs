//! Finds OpenCASCADE, checks its version, compiles the shims and links the toolkits they use.
//!
//! Debian's packages are the default; `OCCT_ROOT` names another installation (its `include/opencascade` and `lib`).
//! Crates that depend on this one read `DEP_OCCT_BRIDGE_LIBDIR` (only set with `OCCT_ROOT`) to give their binaries a run path.

#![allow(
    clippy::print_stdout,
    reason = "a build script talks to cargo on standard output"
)]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

/// Oldest version the shims compile against, and the first one they do not.
const OLDEST: (u32, u32) = (7, 6);
const TOO_NEW: u32 = 8;

/// Every shim: one per task.
const SHIMS: [&str; 12] = [
    "shape",
    "geometry",
    "spline",
    "topology",
    "assembled",
    "partition",
    "measure",
    "check",
    "step",
    "brep",
    "boundary",
    "body",
];

/// Toolkits whose names never changed.
const TOOLKITS: [&str; 19] = [
    "TKernel",
    "TKMath",
    "TKG2d",
    "TKG3d",
    "TKGeomBase",
    "TKBRep",
    "TKGeomAlgo",
    "TKTopAlgo",
    "TKPrim",
    "TKBO",
    "TKShHealing",
    "TKXSBase",
    "TKCDF",
    "TKLCAF",
    "TKCAF",
    "TKVCAF",
    "TKService",
    "TKXCAF",
    "TKV3d",
];

/// STEP up to 7.7, and since 7.8.
const STEP_BEFORE_7_8: [&str; 5] = [
    "TKSTEPBase",
    "TKSTEPAttr",
    "TKSTEP209",
    "TKSTEP",
    "TKXDESTEP",
];
const STEP_SINCE_7_8: [&str; 1] = ["TKDESTEP"];

fn main() {
    println!("cargo:rerun-if-env-changed=OCCT_ROOT");
    println!("cargo:rerun-if-changed=shim");
    println!("cargo:rerun-if-changed=src/ffi.rs");
    if let Err(problem) = build() {
        // Cargo shows this line in full; what the build script prints otherwise is buried below it.
        println!("cargo::error={problem}");
        std::process::exit(1);
    }
}

fn build() -> Result<(), String> {
    let root = env::var_os("OCCT_ROOT").map(PathBuf::from);
    let include = find_headers(root.as_deref())?;
    let version_file = include.join("Standard_Version.hxx");
    println!("cargo:rerun-if-changed={}", version_file.display());
    let version = read_version(&version_file)?;
    check_version(version, &include)?;

    let mut shims = cxx_build::bridge("src/ffi.rs");
    shims.std("c++17").opt_level(2).include(".").warnings(false);
    // OpenCASCADE's headers are not ours to warn about, nor are names that a later version deprecates.
    shims
        .flag("-isystem")
        .flag(include.to_string_lossy().as_ref());
    shims.flag_if_supported("-Wno-deprecated-declarations");
    shims.define("OCCT_NO_DEPRECATED", None);
    for shim in SHIMS {
        shims.file(format!("shim/{shim}.cpp"));
    }
    shims.try_compile("occt_bridge_shims").map_err(|e| {
        format!(
            "the shims do not compile against {}: {e}",
            include.display()
        )
    })?;

    link(root.as_deref(), version)
}

fn find_headers(root: Option<&Path>) -> Result<PathBuf, String> {
    let candidates = match root {
        Some(root) => vec![
            root.join("include/opencascade"),
            root.join("include/occt"),
            root.join("include"),
        ],
        None => vec![
            PathBuf::from("/usr/include/opencascade"),
            PathBuf::from("/usr/local/include/opencascade"),
        ],
    };
    candidates
        .iter()
        .find(|dir| dir.join("Standard_Version.hxx").is_file())
        .cloned()
        .ok_or_else(|| {
            let tried: Vec<_> = candidates.iter().map(|c| c.display().to_string()).collect();
            format!(
                "OpenCASCADE's headers were not found (looked for Standard_Version.hxx in {}). On Debian or Ubuntu: \
                 apt-get install --no-install-recommends g++ libocct-data-exchange-dev. Another installation: set OCCT_ROOT \
                 to the folder that holds its include and lib.",
                tried.join(", ")
            )
        })
}

fn read_version(file: &Path) -> Result<(u32, u32), String> {
    let text =
        fs::read_to_string(file).map_err(|e| format!("cannot read {}: {e}", file.display()))?;
    let number = |name: &str| -> Result<u32, String> {
        text.lines()
            .find_map(|line| {
                let mut words = line.split_whitespace();
                (words.next() == Some("#define") && words.next() == Some(name))
                    .then(|| words.next())
                    .flatten()
            })
            .and_then(|word| word.parse().ok())
            .ok_or_else(|| format!("{} does not define {name}", file.display()))
    };
    Ok((number("OCC_VERSION_MAJOR")?, number("OCC_VERSION_MINOR")?))
}

fn check_version((major, minor): (u32, u32), include: &Path) -> Result<(), String> {
    if (major, minor) >= OLDEST && major < TOO_NEW {
        return Ok(());
    }
    Err(format!(
        "OpenCASCADE {major}.{minor} in {} cannot be used: {}.{} or newer, and older than {TOO_NEW}.0, is needed. Debian 12's \
         package libocct-data-exchange-dev is 7.6.3; set OCCT_ROOT to use another installation.",
        include.display(),
        OLDEST.0,
        OLDEST.1
    ))
}

fn link(root: Option<&Path>, version: (u32, u32)) -> Result<(), String> {
    if let Some(root) = root {
        let lib = ["lib", "lib64"]
            .iter()
            .map(|dir| root.join(dir))
            .find(|dir| dir.join("libTKernel.so").exists())
            .ok_or_else(|| {
                format!(
                    "no libTKernel.so in lib or lib64 of OCCT_ROOT={}",
                    root.display()
                )
            })?;
        println!("cargo:rustc-link-search=native={}", lib.display());
        // DT_RPATH, not DT_RUNPATH: the toolkits must find each other through it too.
        println!(
            "cargo:rustc-link-arg=-Wl,--disable-new-dtags,-rpath,{}",
            lib.display()
        );
        println!("cargo:libdir={}", lib.display());
    }
    let step: &[&str] = if version >= (7, 8) {
        &STEP_SINCE_7_8
    } else {
        &STEP_BEFORE_7_8
    };
    for toolkit in TOOLKITS.iter().chain(step) {
        println!("cargo:rustc-link-lib=dylib={toolkit}");
    }
    println!("cargo:version={}.{}", version.0, version.1);
    Ok(())
}
