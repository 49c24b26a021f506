#!/usr/bin/env bash
# render_and_compare.sh GOLDENS OUT: an image test for CI, on a Debian 12 without a GPU. Installs what is missing, builds
# tarn, renders a few pictures of one scene into OUT/actual, and compares them with those in the folder GOLDENS.
# OUT/junit.xml is for the CI service, OUT/page/index.html for people, OUT/numbers.json for scripts.
# Where GOLDENS holds no picture yet, this run's pictures become the goldens.
#
# Exit status: 0 all passed, or goldens were made; 3 a picture did not pass; 1 something failed; 2 wrong usage.
# Variables: SCENE, a glTF file or one of the project's scenes; SIZE; EXPOSURE of the PNG; TARN, a tarn that is built
# already: then nothing is installed or built; REQUIRE_GOLDENS=1 makes it an error that there are none.
set -euo pipefail
TARN_TOOL=render_and_compare
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/lib/setup.sh"
if (($# != 2)) || [[ -z $1 || -z $2 ]]; then
    say "usage: render_and_compare.sh GOLDENS OUT"
    exit 2
fi
goldens=$1 out=$2
scene=${SCENE:-cornell} size=${SIZE:-320x180} exposure=${EXPOSURE:-1}

# The seed is fixed, and equal programs on equal systems give equal bits. The limits leave room for another version of
# the driver or the compiler: FLIP of the whole picture, of its worst place, and no pixel that is not a number.
limits=(--max flip=0.01 --max flip_tile=0.1 --max non_finite=0)

# render NAME OPTIONS...: a picture of the scene.
render() { "$TARN" render "$scene" --size "$size" --seed 1 --out "$out/actual/$1" "${@:2}" >&2; }

# has_pictures FOLDER
has_pictures() { [[ -d $1 && $(find -L "$1" \( -iname '*.exr' -o -iname '*.hdr' -o -iname '*.png' \) -print -quit) ]]; }

if [[ ! ${TARN:-} ]]; then
    ensure_packages
    build_preset release tarn content/cornell.glb
    TARN=$TARN_ROOT/build/release/tarn
fi
if [[ ${REQUIRE_GOLDENS:-} ]] && ! has_pictures "$goldens"; then fail "there are no goldens in $goldens"; fi

# What an earlier run left must not be taken for this one's.
rm -rf "$out/actual" "$out/page" "$out/junit.xml" "$out/numbers.json"
mkdir -p "$out/actual"
render direct.exr --raw --accumulate --frames 32                   # linear radiance: direct light,
render global.exr --raw --indirect path --accumulate --frames 32   # all light,
render shown.png --frames 12 --exposure "$exposure"                # and what `tarn render` shows, at a fixed exposure

if ! has_pictures "$goldens"; then
    rm -rf "$goldens.part"
    mkdir -p "$goldens"
    cp -R "$out/actual" "$goldens.part"
    mv "$goldens.part"/* "$goldens"
    rmdir "$goldens.part"
    say "there were no goldens in $goldens: these pictures are the goldens now. Look at them, then commit them"
    exit 0
fi
exec "$TARN" compare "$goldens" "$out/actual" "${limits[@]}" \
    --junit "$out/junit.xml" --html "$out/page" --json "$out/numbers.json"
