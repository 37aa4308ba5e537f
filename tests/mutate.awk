# Replaces the text OLD of the environment, which must occur exactly once, by NEW.
BEGIN {
    RS = "\001" # the whole file is one record
}

{
    old = ENVIRON["OLD"]
    at = index($0, old)
    if (at == 0 || index(substr($0, at + 1), old) != 0) {
        exit 1
    }
    printf "%s%s%s", substr($0, 1, at - 1), ENVIRON["NEW"], substr($0, at + length(old))
}
