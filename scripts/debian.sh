# Packages of a Debian release, fetched from the machine's own apt mirror without root and without any change to the
# machine. Sourced after common.sh.
# shellcheck shell=bash disable=SC2034,SC2154

debian_keyring=/usr/share/keyrings/debian-archive-keyring.gpg

# debian_tools WHAT-TO-DO-INSTEAD: what fetching and unpacking wants, or one line.
debian_tools() {
  local tool
  for tool in apt-get dpkg-deb flock tar; do
    command -v "$tool" >/dev/null || fail "no '$tool' here, so Debian's packages cannot be unpacked: $1"
  done
  [[ -r $debian_keyring ]] ||
    fail "$debian_keyring is missing, so Debian's packages cannot be checked: install debian-archive-keyring, or $1"
}

# debian_open FOLDER SUITES ARCHITECTURE WHAT-TO-DO-INSTEAD: makes FOLDER an apt of its own with the package lists of SUITES
# (one word, or several), for debian_apt. Archives come to FOLDER/cache/archives.
debian_open() {
  local apt=$1 suites=$2 architecture=$3 instead=$4 mirrors mirror suite
  mkdir -p "$apt"/{lists/partial,cache/archives/partial,empty.d}
  : >"$apt/status"
  # The machine's own hooks are not to run: containers have one that empties the machine's archive of packages, under
  # the hands of whoever is installing some.
  printf '#clear %s;\n' APT::Update::{Pre-Invoke,Post-Invoke,Post-Invoke-Success} DPkg::{Pre-Invoke,Post-Invoke,Pre-Install-Pkgs} \
    >"$apt/no-hooks"
  debian_log=$apt/log
  debian_options=(
    -c "$apt/no-hooks"
    -o APT::Architecture="$architecture" -o APT::Architectures="$architecture"
    -o Dir::Etc::sourcelist="$apt/sources.list" -o Dir::Etc::sourceparts="$apt/empty.d"
    -o Dir::Etc::preferences="$apt/none" -o Dir::Etc::preferencesparts="$apt/empty.d"
    -o Dir::State="$apt" -o Dir::State::lists="$apt/lists" -o Dir::State::status="$apt/status" -o Dir::Cache="$apt/cache"
    -o APT::Install-Recommends=false -o APT::Sandbox::User="$(id -un)" -o APT::Update::Error-Mode=any -o Debug::NoLocking=1
    -o Acquire::Languages=none -o Acquire::Retries=2 -o Acquire::http::Timeout=30 -o Acquire::https::Timeout=30
  )
  # apt reads both forms of its source files; each place it fetches a release's main packages from may be a Debian mirror.
  # The keyring decides: only one whose release Debian signed is taken.
  # shellcheck disable=SC2016 # the dollars are apt's
  mapfile -t mirrors < <(apt-get indextargets --format '$(COMPONENT) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    sed -n 's/^main //p' | awk '!seen[$0]++')
  ((${#mirrors[@]})) || fail "this machine's apt has no sources, so there is no mirror to fetch Debian's packages from: add one, or $instead"
  for mirror in "${mirrors[@]}"; do
    for suite in $suites; do echo "deb [signed-by=$debian_keyring] $mirror $suite main"; done >"$apt/sources.list"
    debian_apt update && return 0
  done
  fail "none of this machine's apt mirrors gave the package list of Debian's $suites (network? not a Debian mirror?): $(debian_why)"
}

debian_apt() { apt-get "${debian_options[@]}" -qq "$@" >>"$debian_log" 2>&1 </dev/null; }
debian_why() { grep -E '^(E|W|Err):' "$debian_log" | head -n 1 || true; }
