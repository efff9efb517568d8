#!/usr/bin/env bash
# Installs the Debian packages that are missing (apt, with sudo when not root). Silent when all is there.
#   tools/setup.sh         all
#   tools/setup.sh demo    only what the swept command needs
#   tools/setup.sh wasm, emscripten, aarch64, windows, plain   only what tools/portability.sh needs for that machine
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

demo_packages=(g++ cmake ninja-build pkg-config nlohmann-json3-dev libcli11-dev libbox2d-dev
    libpng-dev libwebp-dev libosmesa6-dev libhwy-dev libtbb-dev)
test_packages=(libgtest-dev libbenchmark-dev libchipmunk-dev gnuplot-nox clang-14 libclang-rt-14-dev)

# Compilers and emulators of other machines; of Highway the headers do there, of GoogleTest the sources.
cross_packages=(cmake ninja-build libhwy-dev googletest)
wasm_packages=(clang-14 lld-14 llvm-14 wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32 nodejs)
emscripten_packages=(emscripten)
aarch64_packages=(g++-aarch64-linux-gnu qemu-user)
windows_packages=(g++-mingw-w64-x86-64-posix wine64)

usage="usage: tools/setup.sh [all|demo|wasm|emscripten|aarch64|windows|plain]"
if [ "$#" -gt 1 ]; then fail "$usage"; fi
case "${1:-all}" in
    all) wanted=("${demo_packages[@]}" "${test_packages[@]}") ;;
    demo) wanted=("${demo_packages[@]}") ;;
    wasm) wanted=("${cross_packages[@]}" "${wasm_packages[@]}") ;;
    emscripten) wanted=("${cross_packages[@]}" "${emscripten_packages[@]}") ;;
    aarch64) wanted=("${cross_packages[@]}" "${aarch64_packages[@]}") ;;
    plain) wanted=("${cross_packages[@]}" g++) ;;
    windows) wanted=("${cross_packages[@]}" "${windows_packages[@]}") ;;
    -h | --help)
        echo "$usage"
        exit 0
        ;;
    *) fail "$1: no such set of packages; $usage" ;;
esac

# For any machine: a package that is there for two of them has two lines.
is_installed() { dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -x installed >/dev/null; }

# Another system may have all of it under other names: then CMake says what it cannot find.
if ! command -v dpkg-query >/dev/null; then exit 0; fi

missing=()
for package in "${wanted[@]}"; do
    if ! is_installed "$package"; then missing+=("$package"); fi
done
if [ "${#missing[@]}" -eq 0 ]; then exit 0; fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
        fail "missing packages and neither root nor sudo; as root: apt-get install ${missing[*]}"
    as_root=(sudo)
fi
command -v apt-get >/dev/null || fail "missing packages and no apt-get to install them: ${missing[*]}"

install() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
}

say "installing ${#missing[@]} packages: ${missing[*]}"
mkdir -p "$log_dir"
log="$log_dir/setup.log"
{ "${as_root[@]}" apt-get update && install "${missing[@]}"; } >"$log" 2>&1 && exit 0

# Something is not to be had: install what can be, then name the rest.
lost=()
for package in "${missing[@]}"; do
    is_installed "$package" || install "$package" >>"$log" 2>&1 || lost+=("$package")
done
if [ "${#lost[@]}" -eq 0 ]; then exit 0; fi
fail "cannot install ${lost[*]} ($(grep -m1 '^E:' "$log" || echo "see ${log#"$root"/}"))"
