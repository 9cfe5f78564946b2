#!/usr/bin/env bash
# The only unsafe code, crates/lanes, under what finds undefined behaviour and races; no part of .ci/run, which has the stable compiler alone.
#
#   tests/miri.sh            all of these that the machine has
#   tests/miri.sh miri       Miri: scalar lanes, gathers and the team of threads (rustup component add miri --toolchain nightly)
#   tests/miri.sh address    AddressSanitizer, all instruction sets of this machine (nightly)
#   tests/miri.sh thread     ThreadSanitizer, the team (nightly)
#   tests/miri.sh memcheck   Valgrind's memcheck, up to AVX2 (stable)
#
# Valgrind's helgrind and drd are of no use here: they know locks but no atomic operations, of which the team is made, and tell races at every one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

target=$(rustc -vV | sed -n 's/^host: //p')
folder=$(cargo metadata --format-version 1 --no-deps | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')

has() {
    case $1 in
        miri) cargo +nightly miri --version ;;
        address | thread) rustc +nightly --version ;;
        memcheck) command -v valgrind ;;
    esac >/dev/null 2>&1
}

check() {
    printf '=== %s\n' "$1"
    case $1 in
        miri)
            # Clocks: members of a team wait for each other.
            MIRIFLAGS="-Zmiri-disable-isolation ${MIRIFLAGS:-}" cargo +nightly miri test -p embate-lanes --lib
            ;;
        address)
            RUSTFLAGS=-Zsanitizer=address cargo +nightly test -p embate-lanes --lib --target "$target" --target-dir "$folder/address"
            ;;
        thread)
            # The standard library comes without its races watched: what the test harness does with its channel is let pass, and one test runs at a time.
            supp=$(mktemp)
            trap 'rm -f "$supp"' RETURN
            echo 'race:test::' >"$supp"
            TSAN_OPTIONS="suppressions=$supp" RUSTFLAGS="-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer" \
                cargo +nightly test -p embate-lanes --lib --target "$target" --target-dir "$folder/thread" -- --test-threads=1
            ;;
        memcheck)
            runner=$(tr a-z- A-Z_ <<<"CARGO_TARGET_${target}_RUNNER")
            env "$runner=valgrind --error-exitcode=9 --quiet" cargo test -p embate-lanes --lib -- --test-threads=1
            ;;
        *)
            printf 'error: %s is none of miri, address, thread, memcheck\n' "$1" >&2
            exit 2
            ;;
    esac
}

if [ $# -gt 0 ]; then
    for tool in "$@"; do check "$tool"; done
    exit
fi
for tool in miri address thread memcheck; do
    if has "$tool"; then check "$tool"; else printf '=== %s: not on this machine\n' "$tool"; fi
done
