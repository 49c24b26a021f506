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
picture=300x300+340+30  # beside the panel
panel=300x200+10+10
source "$(dirname "${BASH_SOURCE[0]}")/window_steps.sh"

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
expect_end "Escape"
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
