#!/usr/bin/env bash
# viewer.sh TARN SCENE FOLDER: drives `tarn view` in a real window with keys and mouse, and looks at the screen.
# Waits for what it expects, never for a time, so that a slow machine passes too. Pictures stay in FOLDER.
set -euo pipefail

if [[ -n ${TARN_SKIP_VIEWER:-} ]]; then
    echo "skipped: $TARN_SKIP_VIEWER"
    exit 77
fi

tarn=$1
scene=$2
folder=$3
patience_s=60
picture=300x300+340+30  # beside the panel
panel=300x200+10+10
viewer=

fail() {
    echo "FAILED: $*" >&2
    [[ -f $folder/log.txt ]] && sed 's/^/  viewer: /' "$folder/log.txt" >&2
    exit 1
}
end_viewer() { [[ -z $viewer ]] || kill "$viewer" 2>/dev/null || true; }
trap end_viewer EXIT

# Runs a command until it succeeds; fails when the viewer has died or patience ends.
wait_until() {
    local end=$((SECONDS + patience_s))
    until "$@"; do
        kill -0 "$viewer" 2>/dev/null || fail "the viewer died while waiting for: $*"
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
is_past() { (($(frame) > $1)); }
is_still() {
    look before
    wait_until is_past "$(($(frame) + 2))"
    ! differs before "$1" 0.002
}
shows_something() {
    look now
    local deviation
    deviation=$(convert "$folder/now.png" -crop "$1" +repage -format '%[fx:standard_deviation]' info:)
    awk -v d="$deviation" 'BEGIN { exit !(d > 0.03) }'
}
has_title() { xdotool search --name "^Tarn: .*$1" >/dev/null 2>&1; }
is_file() { [[ -s $1 ]]; }

# The numbers in it may have changed.
panel_is_back() { ! differs before "$panel" 0.04; }
# Moving the mouse while the button is down; true once the picture has changed.
drag_a_little() {
    xdotool mousemove_relative -- -12 3
    differs before "$picture" 0.03
}
# choose COMBO_Y ROW TITLE: opens the combo and clicks a row of its list, which covers what lies below.
choose() {
    local below=150x32+20+$(($1 + 12))
    xdotool mousemove 500 200
    wait_for "the widgets at $1 rest" is_still "$below"
    xdotool mousemove 100 "$1" click 1
    wait_for "a list opens there" differs before "$below" 0.05
    wait_for "its rows rest" is_still "$below"
    xdotool mousemove 60 "$(($1 + 19 + 17 * $2))" click 1
    wait_for "the choice '$3'" has_title "$3"
}
is_gone() { ! kill -0 "$viewer" 2>/dev/null; }

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

# Albedo has no noise: what changes there, a person changed.
"$tarn" view "$scene" --size 640x360 --scale 1 --view albedo --exposure 2 >log.txt 2>&1 &
viewer=$!
wait_for "a window" has_title 'view=albedo'
window=$(xdotool search --name '^Tarn: ' | head -n 1)
wait_for "a picture" shows_something "$picture"
wait_for "a panel" shows_something "$panel"
wait_for "a picture without noise" is_still "$picture"

xdotool keydown w
wait_for "W moves the camera" differs before "$picture" 0.03
xdotool keyup w
wait_for "the camera stops" is_still "$picture"

xdotool mousemove 500 200 mousedown 3
wait_for "the right button turns it" drag_a_little
xdotool mouseup 3
wait_for "the turn stops" is_still "$picture"

xdotool key Tab
wait_for "Tab hides the panel" differs before "$panel" 0.05
xdotool key Tab
wait_for "Tab brings it back" panel_is_back

xdotool mousemove 100 229 click 1
wait_for "the settings unfold" differs before 300x100+10+240 0.02
choose 251 0 'direct=uniform'
choose 119 0 'view=radiance'
look with_radiance
wait_for "the picture of light" shows_something "$picture"

xdotool key F12
wait_for "F12 writes a picture" is_file out/screenshot_0001.png
[[ $(identify -format '%wx%h' out/screenshot_0001.png) == 640x360 ]] || fail "the screenshot has another size"

xdotool windowsize "$window" 800 450
wait_for "the renderer follows the window" has_title '800x450'
wait_for "a picture of the new size" shows_something 120x80+450+365
xdotool key F5
look window

xdotool key Escape
end=$((SECONDS + patience_s))
until is_gone; do
    ((SECONDS < end)) || fail "Escape does not end the viewer"
    sleep 0.1
done
status=0
wait "$viewer" || status=$?
viewer=
((status == 0)) || fail "the viewer ended with $status"
echo "ok: Escape ends it with 0"

"$tarn" view "$scene" --size 320x180 --scale 1 --frames 3 --screenshot last.png >>log.txt 2>&1 ||
    fail "--frames 3 ended with $?"
[[ $(identify -format '%wx%h' last.png) == 320x180 ]] || fail "--screenshot wrote another size"
echo "ok: --frames and --screenshot"

status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$tarn" view "$scene" >no_display.txt 2>&1 || status=$?
((status == 1)) || fail "without a display the status is $status"
[[ $(wc -l <no_display.txt) == 1 ]] && grep -q "tarn render" no_display.txt || fail "without a display: $(cat no_display.txt)"
echo "ok: without a display one line says what to do"
