# How programs for Android are built: with an NDK where there is one; otherwise linked against stand-ins for Android's
# libraries, which proves that nothing is missing and makes nothing that has met Android. Sourced after common.sh.
# shellcheck shell=bash disable=SC2034,SC2154

android_target=aarch64-linux-android
android_manifest=$project/android/AndroidManifest.xml
android_symbols=$project/android/bionic.txt
# Android 15 and later may have pages of 16 KiB.
android_page=16384

# The oldest Android the manifest lets the program be installed on.
android_api() { sed -n 's/.*minSdkVersion="\([0-9]*\)".*/\1/p' "$android_manifest"; }

# android_choose: sets android_clang, the NDK's compiler, which is empty where there is no NDK, and android_how, one phrase.
android_choose() {
  local ndk api name
  api=$(android_api)
  ndk=${ANDROID_NDK_HOME:-${ANDROID_NDK_ROOT:-}}
  if [[ ! $ndk && ${ANDROID_HOME:-} ]]; then ndk=$(compgen -G "$ANDROID_HOME/ndk/*" | sort -V | tail -n 1 || true); fi
  android_clang=
  if [[ ! $ndk ]]; then
    android_how="link-checked: linked without an NDK against stand-ins for Android's libraries"
    return 0
  fi
  name=aarch64-linux-android$api-clang
  android_clang=$(compgen -G "$ndk/toolchains/llvm/prebuilt/*/bin/$name" | head -n 1 || true)
  [[ $android_clang ]] || fail "the NDK in $ndk has no $name: release 24 is the first that has it (unset ANDROID_NDK_HOME to link without an NDK)"
  android_how="linked with the NDK in $ndk"
}

# stand_ins FOLDER: libraries with the names of Android's and the functions of android/bionic.txt, empty; and an unwinder.
# Whatever else a program calls fails its link, until somebody has looked when Android got it.
stand_ins() {
  local folder=$1 api host lld library known=(c m dl log android)
  api=$(android_api)
  # One line each: the library, the function, and the first API level that has it.
  grep -vE '^(#|$)' "$android_symbols" | awk -v api="$api" -v known="${known[*]}" '
    BEGIN { split(known, names, " "); for (i in names) is[names[i]] }
    NF != 3 || !($1 in is) || $3 !~ /^[0-9]+$/ { print "\"" $0 "\": it must be LIBRARY FUNCTION LEVEL, LIBRARY one of " known; exit }
    $3 > api { print $2 ": Android has it since API " $3 ", and the manifest promises " api; exit }
  ' | { if read -r wrong; then fail "android/bionic.txt: $wrong"; fi; } || exit 1
  grep -vE '^(#|$)' "$android_symbols" | LC_ALL=C sort -uc 2>/dev/null || fail "android/bionic.txt is not sorted, each line once: LC_ALL=C sort -u does that"
  host=$(rustc -vV | sed -n 's/^host: //p')
  lld=$(rustc --print sysroot)/lib/rustlib/$host/bin/rust-lld
  [[ -x $lld ]] || fail "this Rust has no linker of its own ($lld), which links without an NDK need: take Rust from rustup, or set ANDROID_NDK_HOME"
  if [[ ! -e $folder/libunwind.a || $folder/libunwind.a -ot $android_symbols || $folder/libunwind.a -ot $project/android/unwind/Cargo.lock ]]; then
    rm -rf "$folder"
    mkdir -p "$folder"
    for library in "${known[@]}"; do
      {
        echo '#![no_std]'
        awk -v library="$library" '
          BEGIN { print "core::arch::global_asm!(r#\"" }
          $1 == library { print ".globl " $2 "\n.type " $2 ",%function\n" $2 ":" }
          END { print "ret\n\"#);" }' "$android_symbols"
      } | rustc --edition 2024 --crate-type lib --crate-name "$library" --emit "obj=$folder/$library.o" "${std_flags[@]}" --target "$android_target" - ||
        fail "the stand-in for Android's lib$library.so cannot be made"
      "$lld" -flavor gnu -shared -soname "lib$library.so" -o "$folder/lib$library.so" "$folder/$library.o"
    done
    CARGO_TARGET_DIR=$folder/unwind CARGO_BUILD_TARGET=$android_target \
      cargo build --quiet --release --locked --manifest-path "$project/android/unwind/Cargo.toml" || fail "the stand-in for the NDK's libunwind.a cannot be made"
    cp "$folder/unwind/$android_target/release/libunwind.a" "$folder/libunwind.a"
  fi
}
