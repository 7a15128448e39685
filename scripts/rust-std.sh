# Rust's std for another target: rustup's, or where rustup has none to give (no network to it, or no rustup) one that is
# built, from the source in Debian's package of the same release. The toolchain stays as it is: what was built lies in a
# folder of its own, and rustc is told of it. Sourced after common.sh and debian.sh.
# shellcheck shell=bash disable=SC2034,SC2154

# rust_std TARGET CRATES: brings it, CRATES being what is built beside std's own. Sets std_flags, what rustc must be told.
rust_std() {
  local target=$1 crates=$2 own toolchain host release
  std_flags=()
  has_std "$target" && return 0
  host=$(rustc -vV | sed -n 's/^host: //p')
  release=$(rustc -vV | sed -n 's/^release: //p')
  toolchain=$(rustc --print sysroot)
  own=$deps/rust-$release-$target-$(cksum <<<"$toolchain $(rustc -vV)" | cut -d ' ' -f 1)
  if [[ ! -e $own/lib ]]; then
    if command -v rustup >/dev/null && rustup target add "$target" >/dev/null 2>&1 && has_std "$target"; then
      say "added Rust's std for $target"
      return 0
    fi
    build_std || exit 1
  fi
  std_flags=(--sysroot "$own")
}

has_std() { compgen -G "$(rustc --print target-libdir --target "$1")/libstd-*.rlib" >/dev/null; }

# Knows what rust_std knows.
build_std() (
  instead="run 'rustup target add $target'" new=$own.new work=$own.work started=$SECONDS
  debian_tools "$instead"
  mkdir -p "$deps"
  exec 9>"$own.lock"
  flock 9 # one at a time; whoever waited finds the work done
  [[ -e $own/lib ]] && return 0
  say "building Rust's std for $target, since rustup did not give it (once, a minute or two)"
  rm -rf "$new" "$work"
  trap 'rm -rf "$own.new" "$own.work"' EXIT
  mkdir -p "$new/lib/rustlib/$target/lib" "$new/lib/rustlib/src/rust" "$work/none/src"
  ln -s "$toolchain/lib/rustlib/$host" "$new/lib/rustlib/$host"

  debian_open "$work" trixie-backports "$(dpkg --print-architecture)" "$instead"
  (cd "$work" && debian_apt download "rust-src=$release*") ||
    fail "rustup did not give Rust's std for $target, and Debian has no source of Rust $release: $instead"
  dpkg-deb -x "$work"/rust-src_*.deb "$work/source"
  ln -s "$work/source/usr/src/rustc-$release/library" "$new/lib/rustlib/src/rust/library"
  printf '#!/bin/sh\nexec "%s" --sysroot "%s" "$@"\n' "$toolchain/bin/rustc" "$new" >"$work/rustc"
  chmod +x "$work/rustc"

  # cargo finds the source where rustc says it looks, and builds std only for somebody: a crate with nothing in it.
  printf '[package]\nname = "none"\nedition = "2024"\n[workspace]\n' >"$work/none/Cargo.toml"
  echo '#![no_std]' >"$work/none/src/lib.rs"
  (
    cd "$work/none"
    unset CARGO_TARGET_DIR CARGO_BUILD_TARGET_DIR CARGO_ENCODED_RUSTFLAGS RUSTFLAGS
    RUSTC=$work/rustc RUSTC_BOOTSTRAP=1 cargo build --release -Z build-std="std,$crates" --target "$target"
  ) >"$work/log" 2>&1 || fail "Rust's std for $target cannot be built ($(grep -m 1 '^error' "$work/log")): $instead"
  cp "$work/none/target/$target"/release/deps/*.rlib "$new/lib/rustlib/$target/lib/"
  rm -rf "$new/lib/rustlib/$target/lib"/libnone-*.rlib "$new/lib/rustlib/src"
  rm -rf "$own"
  mv "$new" "$own"
  say "built Rust's std for $target in $own ($((SECONDS - started)) s); the toolchain itself is unchanged"
)
