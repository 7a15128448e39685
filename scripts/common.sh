# What the entry scripts share: where the project is, how they speak, which tools they need. Sourced, never run.
# shellcheck shell=bash disable=SC2034

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Where set-up leaves what it fetched; a machine that builds many clones may point them at one place.
deps=${SWELL_DEPS:-$project/.deps}
[[ $deps == /* ]] || deps=$PWD/$deps

say() { printf 'swell: %s\n' "$*" >&2; }

# fail WHAT WAS WRONG AND WHAT TO DO: one line, exit status 1.
fail() {
  say "$*"
  exit 1
}

is_root() { [[ $(id -u) == 0 ]]; }

# Installs Debian packages quietly where that is possible: as root on a machine with apt.
apt_install() {
  local log
  log=$(mktemp)
  if { apt-get update -qq && apt-get install -y -qq --no-install-recommends "$@"; } \
    >"$log" 2>&1 </dev/null; then
    say "installed $*"
    rm -f "$log"
    return 0
  fi
  tail -n 3 "$log" >&2
  rm -f "$log"
  return 1
}

# need_tool COMMAND PURPOSE PACKAGE...: the command is there, or its packages are installed, or one line says which to install.
need_tool() {
  local tool=$1 purpose=$2
  shift 2
  command -v "$tool" >/dev/null && return 0
  if is_root && command -v apt-get >/dev/null && DEBIAN_FRONTEND=noninteractive apt_install "$@"; then
    return 0
  fi
  fail "'$tool' is missing ($purpose): install it, on Debian or Ubuntu with: apt-get install $*"
}

# need_header FILE PURPOSE PACKAGE...: the compiler finds a C header, or its packages are installed, or one line says which to install.
need_header() {
  local header=$1 purpose=$2
  shift 2
  printf '#include <%s>\n' "$header" | cc -E - >/dev/null 2>&1 && return 0
  if is_root && command -v apt-get >/dev/null && DEBIAN_FRONTEND=noninteractive apt_install "$@"; then
    return 0
  fi
  fail "'$header' is missing ($purpose): install it, on Debian or Ubuntu with: apt-get install $*"
}

# Rust is the one thing a person has to bring.
need_rust() {
  local home=~ # known even where HOME is not set
  PATH=$PATH:${CARGO_HOME:-$home/.cargo}/bin
  command -v cargo >/dev/null ||
    fail "Rust is missing: install it with rustup (see the 'Install Rust' page of the Rust project), then run this again"
  need_tool cc "Rust links with it" gcc libc6-dev
}

# need_rust_component CARGO-SUBCOMMAND COMPONENT
need_rust_component() {
  cargo "$1" --version >/dev/null 2>&1 && return 0
  if command -v rustup >/dev/null && rustup component add "$2" >/dev/null 2>&1; then
    say "added Rust's $2"
    return 0
  fi
  fail "'cargo $1' is missing: add it with 'rustup component add $2'"
}

# Where cargo leaves what it builds.
target_directory() {
  cargo metadata --format-version 1 --no-deps --locked --manifest-path "$project/Cargo.toml" |
    sed -n 's/.*"target_directory":"\([^"]*\)".*/\1/p'
}

# Cargo's options for the tests within src/: none of them is long, and without optimisation the library is compiled in a quarter
# of the time.
unit_tests=(--config 'profile.dev.package.swell.opt-level=0')
