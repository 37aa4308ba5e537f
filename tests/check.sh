#!/usr/bin/env bash
# Runs make targets as the parts of one check: tests/check.sh PART... Each part's last line of the form "N passed, N
# failed", perhaps behind a name and a colon, is added; any other part counts as one, or as none if it only says what
# it skips. The last line is the sum; before it stands every SKIP line again. Run from the repository's root.
set -u

passed=0
failed=0
log=$(mktemp)
skips=$(mktemp)
trap 'rm -f "$log" "$skips"' EXIT

for part in "$@"; do
    echo "== make $part"
    start=$SECONDS
    make --no-print-directory "$part" 2>&1 | tee "$log"
    status=${PIPESTATUS[0]}
    grep '^SKIP' "$log" | sed "s/^/$part: /" >>"$skips"
    count=$(sed -nE 's/^([a-z-]+: )?([0-9]+) passed, ([0-9]+) failed$/\2 \3/p' "$log" | tail -n 1)
    if [ -z "$count" ]; then
        count="$((status == 0)) $((status != 0))"
        if [ "$status" -eq 0 ] && grep -q '^SKIP' "$log"; then
            count="0 0"
        fi
    fi
    read -r p f <<<"$count"
    if [ "$status" -ne 0 ] && [ "$f" -eq 0 ]; then
        f=1
    fi
    passed=$((passed + p))
    failed=$((failed + f))
    echo "== make $part: $p passed, $f failed, $((SECONDS - start)) s"
done

cat "$skips"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
