# Replaces the text OLD of the environment, which must occur exactly once, by NEW. Any run of blanks and line
# breaks stands for any other, so that OLD survives a new line break.
BEGIN {
    RS = "\001" # the whole file is one record
    words = split(ENVIRON["OLD"], word, /[ \t\n]+/)
    first = word[1] == "" ? 2 : 1 # leading blanks do not count
}

# the length of OLD where text begins with it, else 0
function found(text,    i, at) {
    at = 1
    for (i = first; i <= words; i++) {
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

{
    times = 0
    from = 1
    while ((step = index(substr($0, from), word[first])) > 0) {
        from += step - 1
        size = found(substr($0, from, 4000))
        if (size > 0) {
            times++
            at = from
            span = size
        }
        from++
    }
    if (times != 1) {
        exit 1
    }
    printf "%s%s%s", substr($0, 1, at - 1), ENVIRON["NEW"], substr($0, at + span)
}
