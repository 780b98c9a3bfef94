# shellcheck shell=bash
# What the scripts share: where the project is, and how what they need gets installed.
# Sourced, never run: . "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

# The folder of the checkout; scripts work from any current folder.
# shellcheck disable=SC2034  # used by the scripts that source this file
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Compiler and linker for the C++ shims and for Rust, and OpenCASCADE 7.6 with its headers.
build_packages=(ca-certificates g++ libocct-data-exchange-dev)
# Python for the cross-checks, and the X and OpenGL libraries that the wheels of Gmsh and of the OpenCASCADE
# bindings are linked with though nothing is shown.
crosscheck_packages=(
    python3 python3-venv
    libfontconfig1 libgl1 libglu1-mesa libgomp1 libopengl0
    libxcursor1 libxext6 libxfixes3 libxft2 libxinerama1 libxrender1
)
# shellcheck disable=SC2034  # used by script/test
test_packages=("${build_packages[@]}" "${crosscheck_packages[@]}" shellcheck)

say() { printf '\n== %s\n' "$*" >&2; }
die() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
    exit 3
}

# Whether Debian's package is installed.
has_package() { [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]; }

# Installs the packages that are missing: nothing is asked of the network when all are there.
install_packages() {
    local package missing=()
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        command -v c++ >/dev/null || die "no C++ compiler, and no apt-get to install one"
        printf 'not a Debian system: a C++ compiler is here; for OpenCASCADE elsewhere than /usr set OCCT_ROOT\n' >&2
        return
    fi
    for package in "$@"; do
        # An OpenCASCADE of one's own replaces Debian's.
        [[ $package == libocct-* && -n ${OCCT_ROOT:-} ]] && continue
        has_package "$package" || missing+=("$package")
    done
    ((${#missing[@]})) || return 0
    say "installing ${missing[*]}"
    local as_root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            die "as root, run: apt-get update && apt-get install --no-install-recommends ${missing[*]}"
        printf 'with sudo, which may ask for your password\n' >&2
        as_root=(sudo)
    fi
    # Results go to standard output, apt's chatter to standard error.
    "${as_root[@]}" apt-get update -qq >&2
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# Finds Rust, also where rustup put it but the shell does not look yet.
find_rust() {
    # shellcheck source=/dev/null
    command -v cargo >/dev/null || { [[ -r $HOME/.cargo/env ]] && . "$HOME/.cargo/env"; } || true
    command -v cargo >/dev/null ||
        die "no Rust toolchain: install 1.89 or newer as https://rustup.rs says, then run this again"
}

# make_python FOLDER REQUIREMENTS: makes a Python environment, both below the root, and names its Python in `python`.
make_python() {
    local folder=$root/$1 requirements=$root/$2
    python=$folder/bin/python
    if ! "$python" -c 'import pip' 2>/dev/null; then
        rm -rf "$folder"
        python3 -m venv "$folder"
    fi
    # pip is asked only when what we want has changed.
    if ! cmp -s "$requirements" "$folder/requirements.txt"; then
        say "installing ${requirements#"$root"/} into ${folder#"$root"/}"
        "$python" -m pip install --quiet --disable-pip-version-check -r "$requirements"
        cp "$requirements" "$folder/requirements.txt"
    fi
}

# Cargo's folder of outputs.
target_folder() { printf '%s\n' "${CARGO_TARGET_DIR:-$root/target}"; }
