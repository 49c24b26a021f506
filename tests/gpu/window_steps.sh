# What tests of programs in windows have in common; to be sourced. The program under test is `viewer`, a process; pictures
# of the screen stay in `folder`; `window` is the program's.
patience_s=60
viewer=

fail() {
    echo "FAILED: $*" >&2
    [[ -f $folder/log.txt ]] && sed 's/^/  program: /' "$folder/log.txt" >&2
    exit 1
}
end_viewer() { [[ -z $viewer ]] || kill "$viewer" 2>/dev/null || true; }
trap end_viewer EXIT

# Runs a command until it succeeds; fails when the viewer has died or patience ends.
wait_until() {
    local end=$((SECONDS + patience_s))
    until "$@"; do
        kill -0 "$viewer" 2>/dev/null || fail "the program died while waiting for: $*"
        ((SECONDS < end)) || fail "not within $patience_s s: $*"
        sleep 0.05
    done
}
# wait_for WHAT COMMAND...: the same, and says so.
wait_for() {
    local what=$1
    shift
    wait_until "$@" || fail "$what"
    echo "ok: $what"
}

look() { import -window root "$folder/$1.png"; }
# How much a part of the screen differs from an earlier look, 0 to 1 (root mean square).
difference() {
    compare -metric RMSE -extract "$2" "$folder/$1.png" "$folder/now.png" null: 2>&1 | sed 's/.*(\(.*\))/\1/' || true
}
differs() {
    look now
    awk -v d="$(difference "$1" "$2")" -v least="$3" 'BEGIN { exit !(d + 0 > least) }'
}
# The last frame on the screen, from the window's title.
frame() { xdotool getwindowname "$window" | sed -n 's/.* frame=\([0-9]*\)$/\1/p'; }
is_file() { [[ -s $1 ]]; }
is_gone() { ! kill -0 "$viewer" 2>/dev/null; }
# expect_end WHAT: the program ends, with 0, after what was done.
expect_end() {
    local end=$((SECONDS + patience_s)) status=0
    until is_gone; do
        ((SECONDS < end)) || fail "$1 does not end the program"
        sleep 0.1
    done
    wait "$viewer" || status=$?
    viewer=
    ((status == 0)) || fail "the program ended with $status"
}
