# Joins the reports that gcov -b -c -t prints, of several programs that include tribox.h: a line or branch is
# covered if any program ran it. Instances of one inlined line count together.
#
# -v reasons=FILE: why branches may stay untaken. "# reason", then lines "function | text | n": n branches at
# the lines of that function that contain the text. One more untaken, or one fewer, and the line is wrong.

BEGIN {
    while ((getline row < reasons) > 0) {
        if (row ~ /^# /) {
            reason = substr(row, 3)
        } else if (reason != "" && split(row, part, " [|] ") == 3) {
            entries++
            entry_function[entries] = part[1]
            entry_text[entries] = part[2]
            entry_sides[entries] = part[3] + 0
            entry_reason[entries] = reason
        }
    }
}

/:Source:/ {
    in_header = /tribox\.h$/
    next
}

!in_header {
    next
}

# "   count:  line:text"; ##### and ===== mark lines that never ran, - lines without code
/^ *[-0-9#=*]+: *[0-9]+:/ {
    split($0, field, ":")
    count = field[1]
    gsub(/[ *]/, "", count)
    line = field[2] + 0
    source = substr($0, length(field[1]) + length(field[2]) + 3)
    if (line > 0) {
        text[line] = source
        last = line > last ? line : last
    }
    if (line > 0 && count != "-") {
        is_code[line] = 1
        if (count !~ /^[#=]/) {
            ran[line] = 1
        }
    }
    branch = 0
    next
}

/^branch / {
    key = line SUBSEP branch
    branch++
    known[key] = 1
    if ($3 == "taken" && $4 + 0 > 0) {
        taken[key] = 1
    }
}

# 1 if some reason covers the line, whose untaken branches are then counted to it
function explained(name, source, n,    e) {
    for (e = 1; e <= entries; e++) {
        if (entry_function[e] == name && index(source, entry_text[e]) > 0) {
            entry_found[e] += n
            return 1
        }
    }
    return 0
}

END {
    for (key in known) {
        branches++
        if (!(key in taken)) {
            untaken++
            split(key, part, SUBSEP)
            sides[part[1]]++
        }
    }
    for (line = 1; line <= last; line++) {
        if (text[line] ~ /^(TRIBOX|TBX)_(FN|COLD|NOINLINE|FORCED|FOR_FORMAT) /) {   # a function begins
            name = text[line]
            sub(/\(.*/, "", name)
            sub(/.*[ *]/, "", name)
        }
        if (!(line in is_code)) {
            continue
        }
        lines++
        if (!(line in ran)) {
            missed++
            print "line " line " never runs: " text[line]
        } else if (line in sides && !explained(name, text[line], sides[line])) {
            open += sides[line]
            print "branch at line " line ", " name " (" sides[line] " untaken):" text[line]
        }
    }
    for (e = 1; e <= entries; e++) {
        if (entry_found[e] != entry_sides[e]) {
            open++
            print "reason off: " entry_function[e] " | " entry_text[e] " | " entry_sides[e] \
                ", but " entry_found[e] + 0 " untaken"
        } else {
            group[entry_reason[e]] += entry_sides[e]
        }
    }
    for (reason in group) {
        print group[reason] " untaken: " reason
    }
    print "lines: " lines + 0 ", never run: " (lines > 0 ? missed + 0 : "no data")
    print "branches: " branches + 0 ", never taken: " untaken + 0 ", of these without a reason: " \
        (branches > 0 ? open + 0 : "no data")
}
