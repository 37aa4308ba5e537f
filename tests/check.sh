#!/usr/bin/env bash
# Runs make targets as the parts of one check: tests/check.sh PART... Each part that prints "N passed, N
# failed" adds these; any other part counts as one. The last line is the sum. Run from the repository's
# root.
set -u

passed=0
failed=0
log=$(mktemp)
trap 'rm -f "$log"' EXIT

for part in "$@"; do
    echo "== make $part"
    start=$SECONDS
    make --no-print-directory "$part" 2>&1 | tee "$log"
    status=${PIPESTATUS[0]}
    count=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$log" | tail -n 1)
    if [ -n "$count" ]; then
        read -r p _ f _ <<<"$count"
        passed=$((passed + p))
        failed=$((failed + f))
        if [ "$status" -ne 0 ] && [ "$f" -eq 0 ]; then
            failed=$((failed + 1))
        fi
    elif [ "$status" -eq 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
    fi
    echo "== make $part: status $status, $((SECONDS - start)) s"
done

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
