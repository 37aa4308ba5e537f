#!/usr/bin/env bash
# The filter's error constants, read from tribox.h and proved by Gappa: float and double, nearest and
# directed rounding, with and without fused multiply-add. Run from the repository's root.
set -u
. tests/check_lib.sh

out=$CHECK_DIR/proofs
mkdir -p "$out"
have gappa || { check_end; exit 0; }

# A constant of the header: the first number in the only line that matches, or follows one that does.
constant() { # sed pattern with one group, sed pattern of the line before
    local value script="s/$1/\\1/p"
    [ $# -eq 2 ] && script="/$2/{n;$script}"
    value=$(sed -n "$script" tribox.h)
    if [ "$(echo "$value" | wc -l)" -ne 1 ] || [ -z "$value" ]; then
        echo "not found exactly once in tribox.h: $1" >&2
        echo missing
        return
    fi
    printf '%.0f\n' "$value"
}

ULPS=$(constant '^#define TRIBOX_IMPL_ULPS \([0-9]*\)$')
TERMS=$(constant '.*bound = \([0-9.]*\) \* u \* terms + [0-9.]* \* TRIBOX_IMPL_U64 \* made.*')
MADE=$(constant '.*bound = [0-9.]* \* u \* terms + \([0-9.]*\) \* TRIBOX_IMPL_U64 \* made.*')
NORMAL=$(constant '.*abs(p) + tribox_impl_abs(q)) \* (\([0-9.]*\) \* TRIBOX_IMPL_U64);.*')
FRAME=$(constant '^ *(\([0-9.]*\) \* TRIBOX_IMPL_U64);$' 'w->slack\[k\] = (farthest')
REACH=$(constant '.*w->slack\[k\] += reach \* (\([0-9.]*\) \* TRIBOX_IMPL_U64);.*')
LANES=$(constant '.*bound = c->bound \* scale + (double)(\([0-9.]*\)f \* TRIBOX_IMPL_U32);.*')
GRID=$(constant '^ *(\([0-9.]*\) \* TRIBOX_IMPL_U64);$' 'abs(x) + tribox_impl_abs(along)')
export ULPS TERMS MADE NORMAL FRAME REACH LANES GRID
echo "constants of tribox.h: one box $ULPS; prepared $TERMS and $MADE;" \
    "sign of the normal $NORMAL; walk $FRAME, $REACH and $LANES; grid plane $GRID"

# UNITS(n): n + 1/8 units of 2^-P, so that terms of second order fit. BELOW(n): n - 1 units, since the
# header rounds its bound too. FUSED and PLAIN: lines for one kind of contraction.
prove() { # script, P, FUSED or PLAIN
    local other=PLAIN
    [ "$3" = PLAIN ] && other=FUSED
    sed -E -e "s/^$3 //" -e "/^$other /d" -e "s/@ULPS@/$ULPS/g; s/@TERMS@/$TERMS/g; s/@MADE@/$MADE/g" \
        -e "s/@NORMAL@/$NORMAL/g; s/@WALK@/$((REACH + FRAME - 2))/g; s/@LANES@/$LANES/g" \
        -e "s/@GRID@/$GRID/g; s/\bP\b/$2/g" "tests/proofs/$1.gappa" |
        awk -v p="$2" '{
            while (match($0, /(UNITS|BELOW)\([0-9]+\)/)) {
                n = substr($0, RSTART + 6, RLENGTH - 7) * 64
                n += substr($0, RSTART, 5) == "UNITS" ? 8 : -64
                $0 = substr($0, 1, RSTART - 1) n "b-" (p + 6) substr($0, RSTART + RLENGTH)
            }
            print
        }' | tee "$CHECK_DIR/proofs/$1-$2-$3.gappa" | gappa
}
export -f prove

# 23 and 52: u of every rounding mode; one more: that of rounding to nearest
job "proof: rounding" prove rounding 23 PLAIN
for p in 23 24 52 53; do
    job "proof: sums and products, 2^-$p" prove products $p PLAIN
    job "proof: grid walk, 2^-$p" prove walk $p PLAIN
    for contraction in PLAIN FUSED; do
        for script in coords lines normal edge plane; do
            job "proof: $script, 2^-$p, $contraction" prove $script $p $contraction
        done
    done
done

check_end
