# shellcheck shell=bash
# For the check scripts: jobs run a few at a time, each ends in one line "ok NAME" or "FAIL NAME" with the
# end of its output, and check_end prints the count. Sourced by bash scripts that run in the repository's
# root.

CHECK_DIR=${CHECK_DIR:-build/check}
CHECK_JOBS=${CHECK_JOBS:-2}
CHECK_LIMIT=${CHECK_LIMIT:-900} # seconds a job may take
# CHECK_WITH=command: jobs are run by it (nice, a queue)
# CHECK_TIMES=file: each job's seconds of processor time and its name are added to it
# CHECK_SHOW=1: ok lines show the job's last line too
# CHECK_ONLY=pattern: only jobs whose name it matches
export CHECK_DIR

mkdir -p "$CHECK_DIR"
check_results=$(mktemp "$CHECK_DIR/results.XXXXXX")

# in the background: one job, its line, and on failure the end of what it printed
check_one() { # name, command...
    local name=$1 log
    shift
    log=$(mktemp "$CHECK_DIR/log.XXXXXX")
    local TIMEFORMAT=%U status
    # shellcheck disable=SC2086 # a list of words
    { time ${CHECK_WITH:-} timeout "$CHECK_LIMIT" bash -c '"$@"' job "$@" </dev/null >"$log" 2>&1; } 2>"$log.time"
    status=$?
    if [ -n "${CHECK_TIMES:-}" ]; then
        echo "$(tail -n 1 "$log.time") $name" >>"$CHECK_TIMES"
    fi
    rm -f "$log.time"
    if [ $status -eq 0 ]; then
        echo "ok   $name${CHECK_SHOW:+: $(tail -n 1 "$log")}"
        echo ok >>"$check_results"
    else
        { echo "FAIL $name"; echo "     $*"; tail -n 12 "$log" | sed 's/^/     /'; }
        echo FAIL >>"$check_results"
    fi
    rm -f "$log"
}

# Runs a command (an exported function will do) as a job beside at most CHECK_JOBS - 1 others.
job() { # name, command...
    [[ -z ${CHECK_ONLY:-} || $1 =~ $CHECK_ONLY ]] || return 0
    while [ "$(jobs -rp | wc -l)" -ge "$CHECK_JOBS" ]; do
        wait -n
    done
    check_one "$@" &
}

# Is the tool here? Says so once if not, so that what was not checked shows by name.
declare -A check_missing=()
have() { # tool
    if command -v "$1" >/dev/null 2>&1; then
        return 0
    fi
    if [ -z "${check_missing[$1]:-}" ]; then
        check_missing[$1]=1
        echo "SKIP: $1 not found"
    fi
    return 1
}

# waits for all jobs, prints the count, and is true if none failed
check_end() {
    wait
    local passed failed
    passed=$(grep -c ok "$check_results")
    failed=$(grep -c FAIL "$check_results")
    rm -f "$check_results"
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}
