# Reads the call graph that gcc -fcallgraph-info=su writes and prints, for every public function, the bytes of stack on
# its deepest chain of calls, return addresses included; then the deepest chain of all.

function quoted(key,    text) {
    text = $0
    if (!sub(".*" key ": \"", "", text)) {
        return ""
    }
    sub(/".*/, "", text)
    return text
}

function name_of(title) {
    sub(/.*:/, "", title)
    return title
}

function depth(title,    i, below, best) {
    if (title in known) {
        return known[title]
    }
    if (title in active) {
        print "recursion through " name_of(title)
        exit 1
    }
    active[title] = 1
    best = 0
    for (i = 1; i <= calls[title]; i++) {
        below = depth(callee[title, i])
        if (below > best) {
            best = below
            deepest[title] = callee[title, i]
        }
    }
    delete active[title]
    return known[title] = frame[title] + 8 + best
}

/^node:/ {
    title = quoted("title")
    label = quoted("label")
    if (match(label, /[0-9]+ bytes/)) {
        frame[title] = substr(label, RSTART, RLENGTH) + 0
    }
    if (label ~ /dynamic/ && label !~ /dynamic,bounded/) {
        unbounded[title] = 1
    }
    node[title] = 1
}

/^edge:/ {
    title = quoted("sourcename")
    callee[title, ++calls[title]] = quoted("targetname")
}

END {
    for (title in unbounded) {
        print "no bound on the stack of " name_of(title)
    }
    for (title in node) {
        name = name_of(title)
        if (name ~ /^tribox_/ && name !~ /^tbx_/) {
            printf "  %-28s %6d bytes\n", name, depth(title) | "sort -k2 -n -r"
            if (known[title] > known[worst]) {
                worst = title
            }
        }
    }
    close("sort -k2 -n -r")
    print "deepest chain:"
    for (title = worst; title != ""; title = deepest[title]) {
        printf "  %-40s %6d\n", name_of(title), frame[title] + 8
    }
    if (known[worst] > LIMIT) {
        print "over the promised " LIMIT " bytes"
        exit 1
    }
}
