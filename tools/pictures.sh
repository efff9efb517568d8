#!/usr/bin/env bash
# Draws the pictures of the pages anew: all of samples/pictures/, tools/pictures/trade.png, and of toi/pictures/ all but
# the plots of `swept bench toi --plots`.
#   tools/pictures.sh [SWEPT]
# SWEPT is the command to use, build/release/bin/swept if left out.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case "${1:-}" in
    -h | --help) sed -n '2,5s/^# \?//p' "${BASH_SOURCE[0]}" && exit 0 ;;
    -*) fail "unknown argument $1 (see --help)" ;;
esac
[ $# -le 1 ] || fail "unknown argument $2 (see --help)"
swept="${1:-$root/build/release/bin/swept}"
[ -x "$swept" ] || fail "$swept is not there: build it with tools/demo.sh, or name another"
pictures="$root/samples/pictures"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$pictures"

# picture SCENE STEP OPTION...: the state after so many steps as SCENE.png.
picture() {
    local scene="$1" step="$2"
    shift 2
    say "$scene.png"
    quietly "picture-$scene" "$swept" run "$scene" --steps "$step" --every "$step" --png "$scratch/$scene" \
        --size 960x540 "$@" || fail "the scene $scene failed"
    mv "$scratch/$scene/$(printf 'frame_%06d.png' "$step")" "$pictures/$scene.png"
}

picture bullet-curtain 30 --trails
picture falling-shapes 54
picture ragdolls 75
picture newtons-cradle 120 --trails
picture terrain 120 --trails
picture machine-room 150
picture car 250 --trails --follow chassis --view=-2,0,5.5
picture conveyors 570

say "continuous-modes.png"
quietly picture-modes "$swept" modes continuous-off --steps 1 --png "$pictures/continuous-modes.png" ||
    fail "the scene continuous-off failed"

say "continuous-step.png"
quietly picture-step "$swept" run continuous-sub-step --steps 1 --png "$scratch/step" --size 960x540 --sweeps ||
    fail "the scene continuous-sub-step failed"
mv "$scratch/step/frame_000001.png" "$pictures/continuous-step.png"

say "wall-thickness.png"
quietly picture-wall "$swept" bench continuous --plots "$scratch/wall" || fail "bench continuous failed"
[ ! -f "$scratch/wall/wall-thickness.png" ] || mv "$scratch/wall/wall-thickness.png" "$pictures/wall-thickness.png"

say "dominoes.webp"
quietly picture-dominoes "$swept" run dominoes --duration 6 --every 4 --webp "$pictures/dominoes.webp" --size 640x360 ||
    fail "the scene dominoes failed"

say "trade.png"
quietly picture-trade "$swept" tune dominoes --duration 5 --max-error penetration=0.002 --out "$scratch/trade" ||
    fail "tuning dominoes failed"
[ ! -f "$scratch/trade/tune.png" ] || mv "$scratch/trade/tune.png" "$root/tools/pictures/trade.png"

for query in worst dip; do
    say "anatomy-$query.png"
    quietly "picture-anatomy-$query" "$swept" toi "$root/toi/pictures/anatomy-$query.jsonl" \
        --anatomy "$root/toi/pictures/anatomy-$query.png" || fail "the query $query failed"
done
