# shellcheck shell=bash
# What the scripts in this folder share. Sourced, not run.

set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
log_dir="$root/build/logs"

# say TEXT...: one line about what is being done now.
say() { printf '==> %s\n' "$*"; }

# fail TEXT...: one line about why it ends here.
fail() {
    printf 'error: %s\n' "$*" >&2
    exit 1
}

# quietly NAME COMMAND...: runs a command with its output in build/logs/NAME.log; shows what matters of it on failure.
quietly() {
    local name="$1"
    shift
    mkdir -p "$log_dir"
    local log="$log_dir/$name.log"
    local status=0
    "$@" >"$log" 2>&1 || status=$?
    if [ "$status" -ne 0 ]; then
        local errors
        errors="$(grep -nE '(error|Error|FAILED)[: ]' "$log" | head -n 12 || true)"
        if [ -n "$errors" ]; then printf -- '--- errors in %s\n%s\n' "${log#"$root"/}" "$errors" >&2; fi
        printf -- '--- the end of %s\n' "${log#"$root"/}" >&2
        tail -n 25 "$log" >&2
        return "$status"
    fi
}

# Build processes: one per core, fewer when memory is short (a compiler may take 1.25 GiB).
build_jobs() {
    local cores jobs
    cores="$(nproc 2>/dev/null || echo 2)"
    jobs="$(awk '/MemAvailable/ {print int($2 / 1310720)}' /proc/meminfo 2>/dev/null || echo "$cores")"
    if [ "$jobs" -lt 1 ]; then jobs=1; fi
    echo $((cores < jobs ? cores : jobs))
}

# Arguments for cmake that use ccache where there is one.
launcher_arguments() {
    if command -v ccache >/dev/null; then echo "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"; fi
}

# Arguments for cmake that use the faster linker of binutils where it is: two hundred programs are linked. Not with
# sanitizers, of whose symbols it complains, nor for other machines.
linker_arguments() {
    case "$1" in
        release | debug) if command -v ld.gold >/dev/null; then echo "-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=gold"; fi ;;
    esac
}

# Arguments for cmake that have GCC free memory less often, where nobody set its flags: the largest sources take 1.25 GiB
# instead of 1, and 0.92 of the time.
memory_arguments() {
    local compiler="${CXX:-c++}"
    if [ "$1" != release ] || [ -n "${CXXFLAGS:-}" ]; then return; fi
    case "$("$compiler" --version 2>/dev/null)" in
        *"Free Software Foundation"*) echo "-DCMAKE_CXX_FLAGS=--param=ggc-min-expand=1000" ;;
    esac
}

# configure PRESET ARGUMENT...
configure() {
    local preset="$1"
    shift
    local launcher linker memory
    launcher="$(launcher_arguments)"
    linker="$(linker_arguments "$preset")"
    memory="$(memory_arguments "$preset")"
    quietly "configure-$preset" cmake -S "$root" --preset "$preset" ${launcher:+"$launcher"} ${linker:+"$linker"} \
        ${memory:+"$memory"} "$@" ||
        fail "configuring the preset '$preset' failed"
}

# build PRESET TARGET...
build() {
    local preset="$1"
    shift
    quietly "build-$preset" cmake --build "$root/build/$preset" --parallel "$(build_jobs)" --target "$@" ||
        fail "building the preset '$preset' failed"
}
