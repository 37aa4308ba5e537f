# The deepest chain of stack frames in call graphs written by gcc -fcallgraph-info=su: awk -v limit=16384 -f
# this *.ci Prints the chain; fails when it is deeper than the limit, or when there is a cycle.

/^node:/ {
    match($0, /title: "[^"]*"/)
    name = substr($0, RSTART + 8, RLENGTH - 9)
    frame[name] = 0
    if (match($0, /[0-9]+ bytes \([a-z,]*\)/)) {
        split(substr($0, RSTART, RLENGTH), words, " ")
        frame[name] = words[1]
        if (index(substr($0, RSTART, RLENGTH), "(dynamic)") > 0) {
            print "unbounded frame: " name
            bad = 1
        }
    }
}

/^edge:/ {
    match($0, /sourcename: "[^"]*"/)
    from = substr($0, RSTART + 13, RLENGTH - 14)
    match($0, /targetname: "[^"]*"/)
    to = substr($0, RSTART + 13, RLENGTH - 14)
    calls[from] = calls[from] SUBSEP to
}

function depth(name,    list, n, i, most, d) {
    if (name in known) {
        return known[name]
    }
    if (name in open_calls) {
        print "recursion at " name
        bad = 1
        return 0
    }
    open_calls[name] = 1
    most = 0
    n = split(substr(calls[name], 2), list, SUBSEP)
    for (i = 1; i <= n; i++) {
        d = depth(list[i])
        if (d > most) {
            most = d
            next_call[name] = list[i]
        }
    }
    delete open_calls[name]
    known[name] = most + frame[name]
    return known[name]
}

END {
    for (name in frame) {
        nodes++
        d = depth(name)
        if (d > deepest) {
            deepest = d
            top = name
        }
    }
    print "deepest chain: " deepest " bytes of " limit
    for (name = top; name != ""; name = next_call[name]) {
        print "  " frame[name] " " name
    }
    exit !(nodes > 0 && deepest > 0 && deepest <= limit && !bad)
}
