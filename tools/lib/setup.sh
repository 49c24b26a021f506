# What tools/run, tools/test and .ci/run share: the packages, the configured and the finished build.
# To be sourced by bash under `set -euo pipefail`, with TARN_TOOL set to the name that messages begin with.
TARN_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$TARN_ROOT/tools/lib/progress.sh"

# say TEXT: one line to the user. On stderr, so that stdout is tarn's alone.
say() { printf '%s: %s\n' "$TARN_TOOL" "$*" >&2; }

# fail TEXT: says what is wrong in one line and ends the script with status 1.
fail() { say "$@"; exit 1; }

# list_packages: the names in tools/packages.txt, one per line.
list_packages() { sed -e 's/[[:space:]]*#.*//' -e '/^$/d' "$TARN_ROOT/tools/packages.txt"; }

# list_missing_packages: those of them that dpkg does not know as installed.
list_missing_packages() {
    local names installed
    names=$(list_packages)
    # dpkg-query ends with 1 when it does not know one of the names: that is an answer here, not an error.
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $names 2>/dev/null || true)
    comm -23 <(sort <<<"$names") <(sed -n 's/^installed //p' <<<"$installed" | sort)
}

# ensure_packages: installs what is missing, as root or through sudo; silent when nothing is.
ensure_packages() {
    # A plain `su` leaves the user's PATH in place, without the folders that dpkg's own helpers are in.
    PATH=$PATH:/usr/local/sbin:/usr/sbin:/sbin
    command -v apt-get >/dev/null ||
        fail "no apt-get: this is not Debian or its like; the packages needed are:" $(list_packages)
    local missing
    missing=$(list_missing_packages)
    if [[ $missing ]]; then install_packages $missing; fi
}

# install_packages NAMES...: apt-get update and install.
install_packages() {
    local log=$TARN_ROOT/build/packages.log as_root=()
    if (($(id -u) != 0)); then
        as_root=(sudo)
        can_sudo || fail "neither root nor sudo to install the missing packages: $*"
    fi
    local apt=("${as_root[@]}" env LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive apt-get -y
        -o APT::Status-Fd=1 -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3)
    mkdir -p "$TARN_ROOT/build"
    say "installing the missing packages: $*"
    {
        "${apt[@]}" update </dev/null 2>&1 &&
            "${apt[@]}" install --no-install-recommends "$@" </dev/null 2>&1
    } | show_progress "packages" "$log" || fail_with_log "packages could not be installed" "$log"
}

# can_sudo: whether sudo is there and lets this user through.
can_sudo() {
    command -v sudo >/dev/null || return 1
    # On a terminal it may ask for a password: now, before a progress bar draws over the question.
    if [[ -t 0 && -t 2 ]]; then sudo -v; else sudo -n true 2>/dev/null; fi
}

# build_preset PRESET TARGETS...: configures build/PRESET when that is not done yet, then builds the targets there.
# One at a time per folder; silent when there is nothing to do; the whole log is build/PRESET/build.log.
build_preset() {
    local preset=$1 folder=$TARN_ROOT/build/$1 log=$TARN_ROOT/build/$1/build.log
    shift
    mkdir -p "$folder"
    exec {build_lock}>"$folder/.lock"
    flock -n "$build_lock" || { say "waiting for another build in $folder"; flock "$build_lock"; }
    configure_preset "$preset" "$folder"
    LC_ALL=C.UTF-8 NINJA_STATUS='[%f/%t] ' ninja -C "$folder" "$@" </dev/null 2>&1 |
        show_progress "build" "$log" || fail_with_log "the build failed" "$log"
    exec {build_lock}>&-
}

# configure_preset PRESET FOLDER: runs CMake unless the folder holds build files of this very checkout.
configure_preset() {
    local cache=$2/CMakeCache.txt log=$2/configure.log
    if [[ -e $2/build.ninja ]] && grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$TARN_ROOT" "$cache"; then return; fi
    # A checkout that was moved or copied leaves a cache that points at its old place.
    rm -rf "$cache" "$2/CMakeFiles"
    (cd "$TARN_ROOT" && LC_ALL=C.UTF-8 cmake --preset "$1" </dev/null 2>&1) |
        show_progress "configure" "$log" || fail_with_log "CMake could not configure the build" "$log"
}

# fail_with_log TEXT LOG: shows the log from its first error on, says where the rest is, and ends.
fail_with_log() {
    local first
    first=$(grep -nm 1 -E '^(FAILED: |CMake Error|E: |dpkg: error)' "$2" | cut -d : -f 1) || first=1
    tail -n "+$first" "$2" | head -n 200 >&2
    fail "$1; the whole log: $2"
}

# has_display: whether a window can be opened. A variable alone proves nothing: it outlives the display it names.
has_display() {
    if [[ ${DISPLAY:-} ]] && timeout 5 xdotool getdisplaygeometry >/dev/null 2>&1; then return 0; fi
    # Debian's usual GLFW speaks X11 alone.
    [[ ${WAYLAND_DISPLAY:-} && -S ${XDG_RUNTIME_DIR:-}/$WAYLAND_DISPLAY ]] &&
        dpkg-query -W libglfw3-wayland >/dev/null 2>&1
}
