#!/usr/bin/env bash
# render_and_compare_test.sh BUILD: content/examples/render_and_compare.sh as a CI job runs it, on a tiny size and with
# the tarn of BUILD. Ends with 1 when an expectation fails.
set -euo pipefail
SOURCE=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
BUILD=$1
SANDBOX=$(mktemp -d)
trap 'rm -rf "$SANDBOX"' EXIT
export TARN=$BUILD/tarn SIZE=96x54
unset SCENE EXPOSURE REQUIRE_GOLDENS
failures=0

# expect NAME ACTUAL EXPECTED: counts and shows a difference.
expect() {
    [[ $2 == "$3" ]] && return
    printf 'FAILED %s\n  expected: %s\n  actual:   %s\n' "$1" "$3" "$2"
    failures=$((failures + 1))
}

# run_job ARGS...: sets status, output and errors.
run_job() {
    status=0
    output=$("$SOURCE/content/examples/render_and_compare.sh" "$@" 2>"$SANDBOX/errors" </dev/null) || status=$?
    errors=$(<"$SANDBOX/errors")
}

# list FOLDER: the files below it, on one line.
list() { (cd "$1" && find . -type f | sort | xargs echo); }

# count_failures: tests and failures as the JUnit report has them.
count_failures() {
    python3 -c 'import sys, xml.etree.ElementTree as E; root = E.parse(sys.argv[1]).getroot()
print(root.get("tests"), len(root.findall(".//failure")))' out/junit.xml
}

# change_scene FILE STRENGTH: the Cornell box with another strength of its lamp, which is 17.
change_scene() {
    python3 - "$BUILD/content/cornell.glb" "$1" "$2" <<'PYTHON'
import json, struct, sys
data = open(sys.argv[1], "rb").read()
length, = struct.unpack("<I", data[12:16])
scene, rest = json.loads(data[20:20 + length]), data[20 + length:]
lamp, = (m for m in scene["materials"] if m["name"] == "light")
assert lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] == 17
lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = float(sys.argv[3])
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
open(sys.argv[2], "wb").write(b"glTF" + struct.pack("<IIII", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) +
                              text + rest)
PYTHON
}

cd "$SANDBOX"
run_job goldens
expect "usage" "$status" 2
REQUIRE_GOLDENS=1 run_job goldens out
expect "goldens are required: status" "$status" 1
expect "goldens are required: line" "$errors" "render_and_compare: there are no goldens in goldens"

mkdir goldens  # as a repository has it that is to get some
touch goldens/.gitkeep
run_job goldens out
expect "first run: status" "$status" 0
expect "first run: goldens" "$(list goldens)" "./.gitkeep ./direct.exr ./global.exr ./shown.png"
expect "first run: says so" "$(grep -c 'these pictures are the goldens now' <<<"$errors")" 1

REQUIRE_GOLDENS=1 run_job goldens out
expect "second run: status" "$status $errors" "0 "
expect "second run: tests and failures" "$(count_failures)" "3 0"
expect "second run: last line" "${output##*$'\n'}" "3 pictures: 3 passed"
expect "second run: no pictures are needed" "$(list out/page)" "./index.html"

change_scene brighter.glb 17.5
SCENE=brighter.glb run_job goldens out
expect "3 % more light: status" "$status" 3
expect "3 % more light: tests and failures" "$(count_failures)" "3 3"
expect "3 % more light: files" "$(list out/page)" "./index.html $(
    for name in direct.exr global.exr shown.png; do echo "./pictures/$name."{actual,expected,flip}.png; done | xargs)"
expect "3 % more light: the page" "$(grep -c '3 of 3 pictures did not pass</h1>' out/page/index.html)" 1

change_scene same.glb 17
SCENE=same.glb run_job goldens out
expect "the lamp as it was: status" "$status" 0

SIZE=96x60 run_job goldens out
expect "another size: status" "$status" 3
expect "another size: verdicts" "$(grep -c 'other size' <<<"$output")" 4
cp goldens/direct.exr goldens/gone.exr
run_job goldens out
expect "a picture that is gone: status" "$status" 3
expect "a picture that is gone: verdict" "$(grep -c '^gone.exr  *missing' <<<"$output")" 1

SCENE=nowhere.glb run_job goldens out
expect "a broken scene: status" "$status" 1
expect "a broken scene: nothing of the run before is left" "$(list out)" ""

((failures == 0)) || { printf '%d expectations failed\n' "$failures"; exit 1; }
echo "all passed"
