# Joins the reports that gcov -b -c -t prints, of several programs that include tribox.h: a line or branch
# is covered if any program ran it. Instances of one inlined line count together.

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
    if (line > 0 && count != "-") {
        is_code[line] = 1
        last = line > last ? line : last
        text[line] = substr($0, length(field[1]) + length(field[2]) + 3)
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
        if (line in is_code) {
            lines++
            if (!(line in ran)) {
                missed++
                print "line " line " never runs: " text[line]
            } else if (line in sides) {
                print "branch at line " line " (" sides[line] " untaken):" text[line]
            }
        }
    }
    print "lines: " lines + 0 ", branches: " branches + 0 ", branches never taken: " untaken + 0
    print "uncovered lines: " (lines > 0 ? missed + 0 : "no data")
}
