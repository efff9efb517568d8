#!/usr/bin/env bash
# Builds the library for other machines and shows that it gives the same bits there: wide kernels against their scalar twins,
# and the built-in scenes against what was recorded on x86-64, both precisions. For WebAssembly by clang and by Emscripten (run
# by Node.js), 64-bit ARM (run by qemu) and Windows (by MinGW-w64, run by Wine); for this machine without what only some compilers
# have (plain). Builds are left in build/wasm, build/emscripten, build/aarch64, build/windows and build/plain.
#   tools/portability.sh [wasm] [emscripten] [aarch64] [windows] [plain]
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case "${1:-}" in -h | --help) sed -n '2,6s/^# \?//p' "${BASH_SOURCE[0]}" && exit 0 ;; esac
machines=("$@")
if [ "${#machines[@]}" -eq 0 ]; then machines=(wasm emscripten aarch64 windows plain); fi

# Emscripten of Debian asks for modules that Debian's own Node.js alone finds without being told.
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}"

# Wine says what it lacks (a screen), and keeps a folder as its drive.
export WINEDEBUG="${WINEDEBUG:--all}" WINEPREFIX="${WINEPREFIX:-$root/build/wine}"

failed=no
for machine in "${machines[@]}"; do
    case "$machine" in wasm | emscripten | aarch64 | windows | plain) ;; *) fail "unknown machine $machine (see --help)" ;; esac
    "$root/tools/setup.sh" "$machine"
    say "$machine: configuring and building (build/$machine)"
    configure "$machine" -DSWEPT_BUILD_TESTS=ON
    build "$machine" all
    if [ "$machine" = windows ]; then
        # What makes the folder is alone with it: two at once get in each other's way.
        quietly wine "$(sed -n 's/^SWEPT_WINE:[A-Z]*=//p' "$root/build/windows/CMakeCache.txt")" cmd /c exit || fail "Wine does not run"
    fi
    log="$log_dir/ctest-$machine.log"
    if ctest --test-dir "$root/build/$machine" --parallel "$(nproc)" --output-on-failure --no-tests=error >"$log" 2>&1; then
        printf '%s: kernels and built-in scenes give the same bits as on x86-64 (%s)\n' "$machine" \
            "$(sed -n 's/ tests failed out of/ failures in/p' "$log" | sed 's/^.*, //')"
    else
        grep -E 'Failure|FAILED|\*\*\*' "$log" | head -n 40 >&2
        printf '%s: NOT the same bits as on x86-64, see build/logs/ctest-%s.log\n' "$machine" "$machine"
        failed=yes
    fi
done
[ "$failed" = no ]
