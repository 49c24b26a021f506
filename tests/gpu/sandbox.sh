#!/usr/bin/env bash
# sandbox.sh TARN_SANDBOX FOLDER: plays in the lantern court, in a real window with keys and mouse. Waits for what it
# expects, never for a time, so that a slow machine passes too. Pictures stay in FOLDER.
set -euo pipefail

if [[ -n ${TARN_SKIP_VIEWER:-} ]]; then
    echo "skipped: $TARN_SKIP_VIEWER"
    exit 77
fi

sandbox=$1
folder=$2
picture=320x180+0+0
source "$(dirname "${BASH_SOURCE[0]}")/window_steps.sh"

title() { xdotool getwindowname "$window"; }
has_title() { [[ $(title) == *" $1 "* ]]; }
# number NAME: x, y, z, yaw, balls, fireflies or step, as the title has it.
number() { title | sed -n "s/.* $1=\([-0-9.]*\) .*/\1/p"; }
# In metres, along the floor, from the place at "$1 $2".
distance() { awk -v x="$(number x)" -v z="$(number z)" -v a="$1" -v b="$2" 'BEGIN { print sqrt((x-a)^2 + (z-b)^2) }'; }
has_gone() { awk -v d="$(distance "$1" "$2")" -v least="$3" 'BEGIN { exit !(d > least) }'; }
# Whether it walks no farther, while the key is down: over 30 steps less than a hand's breadth.
is_stopped() {
    local x z step
    x=$(number x) z=$(number z) step=$(number step)
    wait_until has_stepped "$((step + 30))"
    ! has_gone "$x" "$z" 0.1
}
has_stepped() { (($(number step) > $1)); }
is_in_court() {
    awk -v x="$(number x)" -v y="$(number y)" -v z="$(number z)" \
        'BEGIN { exit !(x > -18.8 && x < 18.8 && z > -15.8 && z < 15.8 && y > -0.2 && y < 5) }'
}
has_turned() { awk -v yaw="$(number yaw)" -v before="$1" 'BEGIN { exit !(yaw > before + 0.05 || yaw < before - 0.05) }'; }
exists() { window=$(xdotool search --name '^Tarn sandbox: .* playing ' 2>/dev/null | head -n 1) && [[ -n $window ]]; }
is_saved() { compgen -G "data/tarn/lantern_court-*.$1" >/dev/null; }
fails_with() {
    local text=$1 status=0
    shift
    "$@" >said.txt 2>&1 || status=$?
    ((status == 1)) && [[ $(wc -l <said.txt) == 1 ]] && grep -qF -- "$text" said.txt ||
        fail "status $status instead of 1 and one line with '$text': $(cat said.txt)"
    echo "ok: $text"
}

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
export XDG_DATA_HOME=$PWD/data XDG_CONFIG_HOME=$PWD/config

# start FILE: a session that is recorded there.
start() {
    "$sandbox" --size 320x180 --scale 0.25 --frame-ms 1 --record "$1" >log.txt 2>&1 &
    viewer=$!
    wait_for "a window, playing" exists
    wait_for "steps pass" has_stepped 20
}
recorded_steps() { awk '$1 == "step" { n += $2 } END { print n + 0 }' "$1"; }
has_recorded() { (($(recorded_steps "$1") > $2)); }

start run.replay
has_title "fireflies=60" || fail "there are no sixty fireflies: $(title)"
look start
wait_for "frames take longer than they may: less is rendered, in two steps" has_title "rung=2"

x=$(number x) z=$(number z)
xdotool keydown w
wait_for "W walks" has_gone "$x" "$z" 1
xdotool keydown shift
wait_for "a wall, a stall or the fountain stops who runs" is_stopped
is_in_court || fail "it is outside: $(title)"
xdotool keyup shift keyup w
yaw=$(number yaw)
xdotool mousemove_relative -- 150 -20
wait_for "the mouse turns the head" has_turned "$yaw"

xdotool click 1
wait_for "a ball flies" has_title "balls=1"
xdotool click 1
wait_for "and another" has_title "balls=2"
xdotool key F5
wait_for "F5 saves" is_saved save
xdotool key F12
wait_for "F12 writes a picture" is_file out/sandbox_0001.png
[[ $(identify -format '%wx%h' out/sandbox_0001.png) == 320x180 ]] || fail "the screenshot has another size"

xdotool key shift+F12
wait_for "Shift+F12 writes radiance" is_file out/sandbox_0001.exr
[[ $(od -An -tx1 -N4 out/sandbox_0001.exr) == " 76 2f 31 01" ]] || fail "that is no EXR file"
[[ ! -e out/sandbox_0002.png ]] || fail "Shift+F12 writes a PNG too"

look before
xdotool key F2
wait_for "F2 shows the panel and frees the mouse" has_title paused
wait_for "the panel is there" differs before 140x150+175+10 0.05
look panel
xdotool key F2
wait_for "F2 goes on" has_title playing
xdotool key r
wait_for "R starts again" has_title "balls=0"
look before
xdotool mousemove_relative -- 200 -20
wait_for "and the picture follows the head" differs before "$picture" 0.03
xdotool windowsize "$window" 400 200
wait_for "the renderer follows the window" has_title "400x200"
xdotool key F11
wait_for "F11 fills the screen" has_title "1280x800"
xdotool key F11
wait_for "and back" has_title "400x200"

xdotool key Escape
wait_for "Escape frees the mouse" has_title paused
xdotool mousemove 100 100 click 1
wait_for "a click goes on" has_title playing
xdotool key F9
wait_for "F9 loads what was saved" has_title "balls=2"
xdotool key Escape
wait_for "Escape frees it again" has_title paused
steps=$(number step)
((steps > 0)) || fail "no steps"
xdotool key Escape
expect_end "the second Escape"
echo "ok: the second Escape ends it with 0"
is_saved autosave || fail "there is no automatic save"

is_file run.replay || fail "there is no record"
[[ $(grep -m 1 '^step' run.replay) == *' - 0 0 0' ]] || fail "the head turns by itself: $(grep -m 1 '^step' run.replay)"
"$sandbox" --replay run.replay --headless --every 60 --out headless --times >>log.txt 2>&1 || fail "headless: $(tail -n 1 log.txt)"
"$sandbox" --replay run.replay --every 60 --out windowed >>log.txt 2>&1 || fail "windowed: $(tail -n 1 log.txt)"
grep -q '^median of [0-9]* frames: [0-9.]* ms$' log.txt || fail "no times: $(cat log.txt)"
(($(ls headless | wc -l) > 3)) || fail "there are $(ls headless | wc -l) pictures"
diff -r headless windowed || fail "a window and none show different pictures"
echo "ok: the replay has the same pictures in a window and without one"

# again FLAG...: a session like the last one, without a record.
again() {
    "$sandbox" --size 320x180 --scale 0.25 --frame-ms 1 "$@" >log.txt 2>&1 &
    viewer=$!
    wait_for "a window, playing" exists
}
[[ $(grep '^restart' config/tarn/keys.ini) == "restart = R" ]] || fail "the keys are not written"
sed -i 's/^restart = R/restart = F7/' config/tarn/keys.ini
again --continue
wait_for "play goes on where it was left" has_title "balls=2"
step=$(number step)
xdotool key r
wait_for "R is bound to nothing" has_stepped "$((step + 10))"
has_title "balls=2" || fail "R starts again, though the keys say F7"
xdotool key F7
wait_for "F7 starts again, as the keys say" has_title "balls=0"
xdotool click 1
wait_for "a ball flies" has_title "balls=1"
kill -TERM "$viewer"
expect_end "SIGTERM"
for file in data/tarn/*.autosave; do printf x >>"$file"; done
again --continue
wait_for "a damaged save is kept aside" is_saved autosave.damaged
wait_for "and play begins anew" has_title "balls=0"
[[ $(wc -l <log.txt) == 1 ]] && grep -q 'it is damaged.*; kept as' log.txt || fail "it says: $(cat log.txt)"
kill -TERM "$viewer"
expect_end "SIGTERM"

head -c 300 run.replay >cut.replay
fails_with "cut.replay: line" "$sandbox" --replay cut.replay --headless --out cut
fails_with "nowhere.replay: the replay cannot be read" "$sandbox" --replay nowhere.replay --headless --out cut
fails_with "scene 'nowhere'" "$sandbox" nowhere
sed 's/^use = E/use = F7/' -i config/tarn/keys.ini
fails_with "keys.ini: line" "$sandbox"
rm config/tarn/keys.ini
fails_with "no display" env -u DISPLAY -u WAYLAND_DISPLAY "$sandbox"

"$sandbox" --replay run.replay --fireflies 3 >said.txt 2>&1 && fail "a replay takes other fireflies than its own"

# Killed without a warning, it leaves what was done until then.
start killed.replay
wait_for "the record grows while it plays" has_recorded killed.replay 0
wait_for "and goes on" has_recorded killed.replay "$(recorded_steps killed.replay)"
kill -KILL "$viewer"
wait "$viewer" || true
viewer=
"$sandbox" --replay killed.replay --headless --every 1000 --out killed >said.txt 2>&1 || fail "killed: $(cat said.txt)"
grep -q "cut off after $(recorded_steps killed.replay) steps" said.txt || fail "it says: $(cat said.txt)"
echo "ok: a killed session is replayed"

start ended.replay
kill -TERM "$viewer"
expect_end "SIGTERM"
[[ $(tail -n 1 ended.replay) == "end $(recorded_steps ended.replay) "* ]] || fail "no end: $(tail -n 1 ended.replay)"
"$sandbox" --replay ended.replay --headless --every 1000 --out ended >said.txt 2>&1 || fail "ended: $(cat said.txt)"
[[ ! -s said.txt ]] || fail "it says: $(cat said.txt)"
echo "ok: SIGTERM ends the record properly"
fails_with "nowhere/a.replay: the replay cannot be written" "$sandbox" --size 320x180 --record nowhere/a.replay
