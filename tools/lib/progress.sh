# Progress of long work for a person: a bar on a terminal, a line now and then otherwise, nothing when it is short.
# To be sourced by bash.
PROGRESS_SILENT_S=2 # work that ends sooner says nothing
PROGRESS_LINE_S=15  # seconds between two lines where there is no terminal

# show_progress LABEL LOG: copies stdin to the file LOG and shows on stderr how far ninja or apt-get has come.
show_progress() {
    local label=$1 log=$2 line part='' percent='' step='' status
    local columns=0 start_s=$SECONDS next_s=$((SECONDS + PROGRESS_SILENT_S)) shown=
    if [[ -t 2 ]]; then columns=$(stty size <&2 | cut -d ' ' -f 2); fi
    while true; do
        status=0
        IFS= read -r -t 1 line || status=$?
        part+=$line
        if ((status == 0)); then
            printf '%s\n' "$part"
            read_progress_line "$part"
            part=''
        elif ((status <= 128)); then # the end; above 128 a second has gone by without a whole line
            printf '%s' "$part"
            break
        fi
        if ((SECONDS >= next_s)); then draw_progress; fi
    done >"$log"
    if [[ $shown ]]; then end_progress; fi
}

# read_progress_line LINE: sets show_progress's percent and step where the line tells them.
read_progress_line() {
    if [[ $1 =~ ^\[([0-9]+)/([0-9]+)\]\ (.*) ]]; then # ninja
        percent=$((100 * BASH_REMATCH[1] / (BASH_REMATCH[2] > 0 ? BASH_REMATCH[2] : 1)))
        step=${BASH_REMATCH[3]}
    elif [[ $1 =~ ^(dl|pm)status:[^:]*(:[a-z0-9]+)?:([0-9]+)[.0-9]*:(.*) ]]; then # apt-get, with APT::Status-Fd
        percent=${BASH_REMATCH[3]}
        step=${BASH_REMATCH[4]}
    fi
}

# draw_progress: shows the values of show_progress as a bar or as a line, and says when to do so again.
draw_progress() {
    shown=yes
    if ((columns == 0)); then
        printf '%s: %s: %s%s\n' "$TARN_TOOL" "$label" "${percent:+$percent % }" "${step:0:100}" >&2
        next_s=$((SECONDS + PROGRESS_LINE_S))
        return
    fi
    local filled=$((${percent:-0} / 5)) bar='####################....................'
    local text="$label [${bar:20-filled:20}] ${percent:-0} % $step"
    printf '\r\e[K%s' "${text:0:columns-1}" >&2
}

# end_progress: takes the bar away, or says how long the work took.
end_progress() {
    if ((columns > 0)); then
        printf '\r\e[K' >&2
    else
        printf '%s: %s: %d s\n' "$TARN_TOOL" "$label" $((SECONDS - start_s)) >&2
    fi
}
