#!/usr/bin/env bash
# with_display.sh COMMAND...: runs it in a virtual display of its own, and ends as it ends.
#
# The server chooses a number that is free and says when it is ready, so that several can start at once. -noreset: else it
# starts anew whenever its last client leaves, and refuses whoever comes at that moment.
set -euo pipefail

folder=$(mktemp -d)
mkfifo "$folder/number"
Xvfb -displayfd 3 -noreset -nolisten tcp -screen 0 1280x800x24 3>"$folder/number" >"$folder/log" 2>&1 &
server=$!
end_server() {
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
    rm -rf "$folder"
}
trap end_server EXIT
trap 'exit 143' TERM INT

if ! read -r number <"$folder/number"; then
    echo "with_display.sh: Xvfb does not start: $(tail -n 1 "$folder/log")" >&2
    exit 1
fi
status=0
DISPLAY=:$number "$@" || status=$?
exit "$status"
