# Replaces the text OLD of the environment by NEW. OLD must occur exactly once in the function (or macro) that IN
# names, or in the whole file if IN is empty. Any run of blanks and line breaks stands for any other, so that OLD
# survives a new line break.
BEGIN {
    RS = "\001" # the whole file is one record
    words = split(ENVIRON["OLD"], word, /[ \t\n]+/)
    first = word[1] == "" ? 2 : 1 # leading blanks do not count
    last = word[words] == "" ? words - 1 : words
    IN = ENVIRON["IN"]
}

# the length of OLD where text begins with it, else 0
function found(text,    i, at) {
    at = 1
    for (i = first; i <= last; i++) {
        if (i > first) {
            if (!match(substr(text, at, 400), /^[ \t\n]+/)) {
                return 0
            }
            at += RLENGTH
        }
        if (substr(text, at, length(word[i])) != word[i]) {
            return 0
        }
        at += length(word[i])
    }
    return at - 1
}

# Where does IN stand? Ranges from[1..ranges], to[]: definitions from the line that names it at its left margin to
# the closing brace there; macros to their last line.
function places(text,    lines, line, n, i, at, open, macro) {
    n = split(text, line, "\n")
    at = 1
    open = 0 # 1: a head that may be a prototype, 2: a body, 3: a macro
    ranges = 0
    for (i = 1; i <= n; i++) {
        if (open == 0 && line[i] ~ ("^#define " IN "[ (]")) {
            begin = at
            open = 3
        } else if (open == 0 && line[i] ~ /^[A-Za-z]/ && line[i] ~ ("(^|[ *])" IN "\\(")) {
            begin = at
            open = 1
        }
        if (open == 1 && line[i] ~ /;[ \t]*$/) {
            open = 0
        } else if (open == 1 && line[i] == "{") {
            open = 2
        } else if (open == 2 && line[i] == "}" || open == 3 && line[i] !~ /\\$/) {
            from[++ranges] = begin
            to[ranges] = at + length(line[i])
            open = 0
        }
        at += length(line[i]) + 1
    }
}

{
    if (IN == "") {
        ranges = 1
        from[1] = 1
        to[1] = length($0)
    } else {
        places($0)
    }
    times = 0
    for (r = 1; r <= ranges; r++) {
        at = from[r]
        while ((step = index(substr($0, at, to[r] - at), word[first])) > 0) {
            at += step - 1
            size = found(substr($0, at, 4000))
            if (size > 0) {
                times++
                place = at
                span = size
            }
            at++
        }
    }
    if (times != 1) {
        exit 1
    }
    printf "%s%s%s", substr($0, 1, place - 1), ENVIRON["NEW"], substr($0, place + span)
}
