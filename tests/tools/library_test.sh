#!/usr/bin/env bash
# library_test.sh BUILD GLFW_RUNNER...: Tarn as others use it. Installs BUILD into a temporary folder and moves that
# away, builds the examples beside it by find_package and runs them there; then the examples' objects by
# add_subdirectory. That does not build the engine a second time, which takes minutes: the examples that Tarn's own build
# links in the same way (content/examples) stand for the rest. The window opens under GLFW_RUNNER, if there is one.
set -euo pipefail
SOURCE=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
BUILD=$1
shift
SANDBOX=$(mktemp -d)
trap 'rm -rf "$SANDBOX"' EXIT
for variable in ${!TARN_*}; do unset "$variable"; done
failures=0

# check NAME COMMAND...: runs it and counts it as a failure when it fails; what it says goes to out.
check() {
    local name=$1
    shift
    if "$@" >"$SANDBOX/out" 2>&1; then return; fi
    printf 'FAILED %s\n' "$name"
    tail -n 20 "$SANDBOX/out"
    failures=$((failures + 1))
}

# fails_with TEXT COMMAND...: succeeds where the command fails and says TEXT.
fails_with() {
    local text=$1
    shift
    if "$@" >"$SANDBOX/said" 2>&1; then echo "it succeeded"; return 1; fi
    grep -qF -- "$text" "$SANDBOX/said" || { cat "$SANDBOX/said"; return 1; }
}

cmake --install "$BUILD" --prefix "$SANDBOX/first" >/dev/null
mv "$SANDBOX/first" "$SANDBOX/tarn"
mkdir "$SANDBOX/app"
cp "$SOURCE"/content/examples/{CMakeLists.txt,*.cpp} "$SANDBOX/app"
cd "$SANDBOX"
scene=$SANDBOX/tarn/share/tarn/content/cornell.glb

check "find_package" cmake -G Ninja -S app -B app/build -DCMAKE_PREFIX_PATH="$SANDBOX/tarn"
check "examples build" cmake --build app/build
check "render_to_exr" app/build/render_to_exr "$scene" picture.exr 2
check "its picture" test -s picture.exr
if (($# > 0)); then check "own_window" "$@" app/build/own_window "$scene" 3; fi
check "the program from elsewhere" tarn/bin/tarn render cornell --size 32x32 --out program.exr
check "the linked one" "$BUILD/render_to_exr" "$scene" linked.exr 2
check "both pictures are the same" cmp picture.exr linked.exr
check "the noise mask" cmp "$BUILD/noise/blue_noise.bin" tarn/share/tarn/noise/blue_noise.bin
check "where scenes are looked for" fails_with "$SANDBOX/tarn/share/tarn/content" tarn/bin/tarn info nowhere

# Whether it was the installed shaders that were used, and not those of the checkout.
rm tarn/share/tarn/shaders/passes/gbuffer/resolve.comp
for program in "app/build/render_to_exr $scene gone.exr" "tarn/bin/tarn render cornell --size 8x8 --out gone.exr"; do
    check "shaders are the installed ones: $program" fails_with "$SANDBOX/tarn/share/tarn/shaders" $program
done

check "add_subdirectory" cmake -G Ninja -S app -B app/sub -DTARN_SOURCES="$SOURCE"
check "objects by add_subdirectory" ninja -C app/sub CMakeFiles/{render_to_exr.dir/render_to_exr,own_window.dir/own_window}.cpp.o
check "no tests or tools by add_subdirectory" fails_with "unknown target" ninja -C app/sub tarn-content

((failures == 0)) && echo "all is well"
