#!/usr/bin/env bash
# Tests of tools/run, tools/test and tools/lib in a copy of the checkout's tools, with stand-ins for the programs they
# start: nothing is installed or built. Ends with 1 when an expectation fails.
set -euo pipefail
SOURCE=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
SANDBOX=$(mktemp -d)
trap 'rm -rf "$SANDBOX"' EXIT
failures=0

# expect NAME ACTUAL EXPECTED: counts and shows a difference.
expect() {
    [[ $2 == "$3" ]] && return
    printf 'FAILED %s\n  expected: %s\n  actual:   %s\n' "$1" "$3" "$2"
    failures=$((failures + 1))
}

# stand_in NAME BODY: a program for the sandbox's PATH; what it is called with is added to calls.
stand_in() {
    printf '#!/bin/bash\nprintf "%%s\\n" "%s $*" >>"%s/calls"\n%s\n' "$1" "$SANDBOX" "$2" >"$SANDBOX/bin/$1"
    chmod +x "$SANDBOX/bin/$1"
}

# make_checkout: a checkout with two packages in its list, both installed, and a tarn that tells how it was called.
make_checkout() {
    rm -rf "${SANDBOX:?}"/*
    mkdir -p "$SANDBOX"/{bin,here,root/build/release}
    cp -r "$SOURCE/tools" "$SANDBOX/root/"
    printf '# a list\none  # the first\n\ntwo\n' >"$SANDBOX/root/tools/packages.txt"
    : >"$SANDBOX/calls"
    stand_in dpkg-query 'printf "installed one\ninstalled two\n"'
    stand_in apt-get 'true'
    stand_in cmake "printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s/root\n' '$SANDBOX' >build/release/CMakeCache.txt
        touch build/release/build.ninja"
    stand_in ninja 'echo "[1/2] Compiling"; echo "[2/2] Linking"'
    stand_in ctest 'true'
    stand_in nproc 'echo 4'
    stand_in xdotool 'exit 1'
    printf '#!/bin/bash\necho "$PWD" "$@"\nexit 7\n' >"$SANDBOX/root/build/release/tarn"
    printf '#!/bin/bash\necho "plays in $PWD" "$@"\n' >"$SANDBOX/root/build/release/tarn-sandbox"
    chmod +x "$SANDBOX/root/build/release/"tarn{,-sandbox}
}

# run_tool NAME ARGS...: runs it as a user in the folder `here` would; sets output, errors and status.
run_tool() {
    status=0
    output=$(cd "$SANDBOX/here" && PATH=$SANDBOX/bin:/usr/bin:/bin "$SANDBOX/root/tools/$1" "${@:2}" \
        2>"$SANDBOX/errors" </dev/null) || status=$?
    errors=$(<"$SANDBOX/errors")
}

test_arguments_folder_and_status_pass_through() {
    make_checkout
    run_tool run render 'a b.gltf' --out x.png
    expect "tarn's arguments and folder" "$output" "$SANDBOX/here render a b.gltf --out x.png"
    expect "tarn's status" "$status" 7
    expect "set-up is silent" "$errors" ""
}

test_second_run_does_not_configure() {
    make_checkout
    run_tool run info
    run_tool run info
    expect "times configured" "$(grep -c '^cmake' "$SANDBOX/calls")" 1
    expect "times built" "$(grep -c '^ninja' "$SANDBOX/calls")" 2
    expect "times installed" "$(grep -c '^apt-get' "$SANDBOX/calls")" 0
}

test_moved_checkout_is_configured_again() {
    make_checkout
    run_tool run info
    echo "CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere" >"$SANDBOX/root/build/release/CMakeCache.txt"
    run_tool run info
    expect "times configured" "$(grep -c '^cmake' "$SANDBOX/calls")" 2
}

test_only_missing_packages_are_installed() {
    make_checkout
    stand_in dpkg-query 'printf "installed one\nconfig-files two\n"; exit 1'
    stand_in id 'echo 0'
    run_tool run info
    expect "told" "$errors" "tools/run: installing the missing packages: two"
    expect "asked of apt-get" "$(grep -c 'apt-get .* install --no-install-recommends two$' "$SANDBOX/calls")" 1
    expect "updated first" "$(grep '^apt-get' "$SANDBOX/calls" | head -n 1 | grep -c ' update$')" 1
}

test_sudo_is_used_by_others_than_root() {
    make_checkout
    stand_in dpkg-query 'printf "installed one\n"; exit 1'
    stand_in id 'echo 1000'
    stand_in sudo '[[ $1 == -n ]] && shift; exec "$@"'
    run_tool run info
    expect "status" "$status" 7
    expect "through sudo" "$(grep -c '^sudo env .* install --no-install-recommends two$' "$SANDBOX/calls")" 1
}

test_failed_installation_shows_its_error_and_ends() {
    make_checkout
    stand_in dpkg-query 'printf "installed one\n"; exit 1'
    stand_in id 'echo 0'
    stand_in apt-get 'echo "Reading package lists..."; echo "E: Unable to locate package two"; exit 100'
    run_tool run info
    expect "status" "$status" 1
    expect "errors" "$(tail -n 2 <<<"$errors")" "E: Unable to locate package two
tools/run: packages could not be installed; the whole log: $SANDBOX/root/build/packages.log"
    expect "not built" "$(grep -c '^ninja' "$SANDBOX/calls")" 0
}

test_neither_root_nor_sudo_is_one_line() {
    make_checkout
    stand_in dpkg-query 'echo "installed one"; exit 1'
    stand_in id 'echo 1000'
    stand_in sudo 'exit 1'
    run_tool run info
    expect "status" "$status" 1
    expect "line" "$errors" "tools/run: neither root nor sudo to install the missing packages: two"
    expect "nothing run" "$output" ""
}

test_failed_build_shows_its_error_and_ends() {
    make_checkout
    stand_in ninja 'echo "[1/2] Compiling"; echo "FAILED: a.o"; echo "a.cpp:1: error: no"; exit 1'
    run_tool test
    expect "status" "$status" 1
    expect "errors" "$errors" "FAILED: a.o
a.cpp:1: error: no
tools/test: the build failed; the whole log: $SANDBOX/root/build/release/build.log"
    expect "tests not run" "$(grep -c '^ctest' "$SANDBOX/calls")" 0
}

test_main_job_without_a_display_is_the_report() {
    make_checkout
    printf '#!/bin/bash\necho "$1" "${@: -2}"\n' >"$SANDBOX/root/build/release/tarn"
    local out=$SANDBOX/root/out/report
    DISPLAY=:77 WAYLAND_DISPLAY='' BROWSER='' run_tool run
    expect "the three steps" "$output" "flythrough --out $out/flythrough
bench --out $out/bench
report --out $out/report.html"
    expect "status" "$status" 0
    expect "where" "${errors##* }" "$out/report.html"
}

test_a_browser_opens_the_report() {
    make_checkout
    printf '#!/bin/bash\n' >"$SANDBOX/root/build/release/tarn"
    stand_in reader 'echo "reads $1"'
    DISPLAY=:77 WAYLAND_DISPLAY='' BROWSER=reader run_tool run
    expect "what is opened" "$output" "reads $SANDBOX/root/out/report/report.html"
}

test_main_job_with_a_display_is_the_sandbox() {
    make_checkout
    stand_in xdotool 'echo 1280 720'
    DISPLAY=:77 run_tool run
    expect "what is run" "$output" "plays in $SANDBOX/here"
    expect "what is built" "$(grep -c '^ninja.* tarn-sandbox' "$SANDBOX/calls")" 1
    DISPLAY=:77 run_tool run view
    expect "the viewer" "$output" "$SANDBOX/here view"
}

test_the_ci_example_installs_and_builds_tarn_alone() {
    make_checkout
    mkdir -p "$SANDBOX/root/content/examples"
    cp "$SOURCE/content/examples/render_and_compare.sh" "$SANDBOX/root/content/examples/"
    stand_in dpkg-query 'printf "installed one\n"; exit 1'
    stand_in id 'echo 0'
    # Each picture's name as its content, and no comparison that could pass.
    printf '#!/bin/bash\nif [[ $1 == compare ]]; then echo "$2 $3"; exit 3; fi
        while [[ $1 != --out ]]; do shift; done; echo "$2" >"$2"\n' >"$SANDBOX/root/build/release/tarn"
    TARN='' run_tool ../content/examples/render_and_compare.sh goldens out
    expect "status" "$status" 0
    expect "installed" "$(grep -c 'apt-get .* install --no-install-recommends two$' "$SANDBOX/calls")" 1
    expect "built" "$(grep '^ninja' "$SANDBOX/calls" | sed 's/.*release //')" "tarn content/cornell.glb"
    expect "goldens" "$(cat "$SANDBOX"/here/goldens/* | xargs)" \
        "out/actual/direct.exr out/actual/global.exr out/actual/shown.png"
    TARN='' run_tool ../content/examples/render_and_compare.sh goldens out
    expect "tarn's verdict passes through" "$status $output" "3 goldens out/actual"
}

test_arguments_of_tools_test_go_to_ctest() {
    make_checkout
    run_tool test -L unit
    expect "ctest" "$(tail -n 1 "$SANDBOX/calls")" \
        "ctest --test-dir $SANDBOX/root/build/release --output-on-failure -j6 -L unit"
}

test_progress_tells_percent_after_a_while_and_keeps_the_log() {
    make_checkout
    stand_in ninja 'echo "[1/4] Compiling a"; sleep 2.5; echo "[2/4] Compiling b"; printf "no newline"'
    run_tool run info
    expect "first line" "$(head -n 1 <<<"$errors")" "tools/run: build: 25 % Compiling a"
    expect "last line" "$(tail -n 1 <<<"$errors" | sed 's/[0-9]\+ s$/N s/')" "tools/run: build: N s"
    expect "log" "$(<"$SANDBOX/root/build/release/build.log")" "[1/4] Compiling a
[2/4] Compiling b
no newline"
}

test_package_list_explains_every_name_once() {
    expect "lines without a reason" "$(grep -vcE '^$|^#|^[a-z0-9+.-]+ +# .' "$SOURCE/tools/packages.txt")" 0
    expect "doubled" "$(grep -oE '^[a-z0-9+.-]+' "$SOURCE/tools/packages.txt" | sort | uniq -d)" ""
}

for test in $(compgen -A function test_); do "$test"; done
((failures == 0)) || { printf '%d expectations failed\n' "$failures"; exit 1; }
echo "all passed"
