#!/usr/bin/env bash
# Builds the swept command and runs all built-in scenes, with pictures into out/.
#   tools/demo.sh [--duration S] [--out DIR]
# S shortens every scene to that many seconds.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

out="$root/out"
longest=""
while [ $# -gt 0 ]; do
    case "$1" in
        --duration) longest="${2:?--duration needs a number of seconds}" && shift 2 ;;
        --out) out="${2:?--out needs a directory}" && shift 2 ;;
        -h | --help) sed -n '2,4s/^# \?//p' "${BASH_SOURCE[0]}" && exit 0 ;;
        *) fail "unknown argument $1 (see --help)" ;;
    esac
done

"$root/tools/setup.sh" demo

say "configuring (Release, build/release)"
# Tests stay as they are in a tree that has them.
if [ -f "$root/build/release/CMakeCache.txt" ]; then configure release; else configure release -DSWEPT_BUILD_TESTS=OFF; fi
say "building the swept command (the first time takes a few minutes)"
build release swept
swept="$root/build/release/bin/swept"

mkdir -p "$out"
mapfile -t scenes < <("$swept" scenes)
[ "${#scenes[@]}" -gt 0 ] || fail "swept scenes lists nothing"
say "running ${#scenes[@]} scenes"
number=0
for line in "${scenes[@]}"; do
    number=$((number + 1))
    name="${line%% *}"
    seconds="$(sed -nE 's/.*\(([0-9.]+) s\)$/\1/p' <<<"$line")"
    seconds="${seconds:-10}"
    every=15 # a picture every quarter of a second at 60 steps per second
    tiles=9
    case "$name" in
        continuous-speed-limit) ;;
        continuous-*) seconds=0.083 every=1 tiles=6 ;; # its shots are out of the picture after five steps
    esac
    if [ -n "$longest" ]; then seconds="$(awk -v a="$seconds" -v b="$longest" 'BEGIN {print a < b ? a : b}')"; fi
    printf '    %2d/%d  %s\n' "$number" "${#scenes[@]}" "${line%% (*}"
    rm -rf "${out:?}/$name"
    quietly "demo-$name" "$swept" run "$name" --duration "$seconds" --png "$out/$name" --every "$every" --size 960x540 \
        --sheet "$tiles" --contacts || fail "the scene $name failed"
    ln -f "$out/$name/sheet.png" "$out/$name.png" 2>/dev/null || cp "$out/$name/sheet.png" "$out/$name.png"
done

printf '\nThe pictures are in %s: one contact sheet per scene (NAME.png), the frames in NAME/.\n' "$out"
printf 'Your own scene: %s run my.json --png out/my   (swept scenes --json NAME prints one to start from)\n' "${swept#"$PWD"/}"
