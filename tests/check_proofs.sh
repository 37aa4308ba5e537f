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
    printf '%g\n' "$value"
}

ULPS=$(constant '^#define TBX_ULPS \([0-9]*\)$')
TRI=$(constant '^#define TBX_TRI_ULPS \([0-9]*\)$')
NORMAL=$(constant '^#define TBX_NORMAL_ULPS \([0-9]*\)$')
COORDINATE=$(constant '^#define TBX_COORDINATE_ERROR (\([0-9.]*\) \* TBX_U64)$')
LINE=$(constant '^#define TBX_LINE_ERROR \([0-9.]*\)$')
WALK_NORMAL=$(constant '^#define TBX_NORMAL_ERROR (\([0-9.]*\) \* TBX_U64)$')
FIXED=$(constant '^#define TBX_FIXED_ERROR (\([0-9.]*\) \* TBX_U64)$')
GRID=$(constant '^#define TBX_PLANE_ERROR (\([0-9.]*\) \* TBX_U64)$')
CROSS_EDGE=$(constant '^#define TBX_CROSS_EDGE_ERROR (\([0-9.]*\) \* TBX_U64)$')
CROSS_PLANE=$(constant '^#define TBX_CROSS_PLANE_ERROR (\([0-9.]*\) \* TBX_U64)$')
SOLID=$(constant '^#define TBX_SOLID_ERROR (\([0-9.]*\) \* TBX_U64)$')
SOLID_EDGE=$(constant '^#define TBX_SOLID_EDGE_ERROR (\([0-9.]*\) \* TBX_U64)$')
SOLID_NORMAL=$(constant '^#define TBX_SOLID_NORMAL_ERROR (\([0-9.]*\) \* TBX_U64)$')
SOLID_PLANE=$(constant '^#define TBX_SOLID_PLANE_ERROR (\([0-9.]*\) \* TBX_U64)$')
PLACE=$(constant '^#define TBX_PLACE_ERROR (\([0-9.]*\) \* TBX_U64)$')
CELL=$(constant '^#define TBX_SOLID_CELL_ERROR \([0-9.]*\)$')
CELL_SUMS=$(constant '^#define TBX_SOLID_CELL_SUMS \([0-9.]*\)$')
SOLID_LINE=$(constant '^#define TBX_SOLID_LINE_ERROR (\([0-9.]*\) \* TBX_U64)$')
SOLID_BOX=$(constant '^#define TBX_SOLID_BOX_ERROR (\([0-9.]*\)f \* TBX_U32)$')
SOLID_PLACE=$(constant '^#define TBX_SOLID_PLACE_ERROR (\([0-9.]*\)f \* TBX_U32)$')
SOLID_ROW=$(constant '^#define TBX_SOLID_ROW_ERROR \([0-9.]*\)f$')
SOLID_ROW_ULPS=$(constant '^#define TBX_SOLID_ROW_ULPS (\([0-9.]*\)f \* TBX_U32)$')
SOLID_NEAR=$(constant '^#define TBX_SOLID_NEAR_ERROR (\([0-9.]*\)f \* TBX_U32)$')
SOLID_ALONE=$(constant '^#define TBX_SOLID_ALONE_ERROR (\([0-9.]*\)f \* TBX_U32)$')
SOLID_REST=$(constant '^#define TBX_SOLID_ALONE_REST (\([0-9.]*\)f \* TBX_U32)$')
SOLID_CLOSE=$(constant '^#define TBX_SOLID_CLOSE_ERROR (\([0-9.]*\) \* TBX_U64)$')
SOLID_FEW=$(constant '^#define TBX_SOLID_FEW_ERROR (\([0-9.]*\) \* TBX_U64)$')
BALL=$(constant '^#define TBX_BALL_ERROR (\([0-9.]*\) \* TBX_U64)$')
BALL4=$(constant '^#define TBX_BALL_ERROR4 (\([0-9.]*\)f \* TBX_U32)$')
PLANE_SPHERE=$(constant '^#define TBX_PLANE_SPHERE_ERROR (\([0-9.]*\) \* TBX_U64)$')
PLANE_SPHERE4=$(constant '^#define TBX_PLANE_SPHERE_ERROR4 (\([0-9.]*\)f \* TBX_U32)$')
TOUCH=$(constant '^#define TBX_TOUCH_ERROR (\([0-9.]*\) \* TBX_U64)$')
PIERCE=$(constant '^#define TBX_PIERCE_ERROR (\([0-9.]*\) \* TBX_U64)$')
SHOT=$(constant '^#define TBX_SHOT_ERROR (\([0-9.]*\) \* TBX_U64)$')
SEGMENT=$(constant '^#define TBX_SEGMENT_ERROR (\([0-9.]*\) \* TBX_U64)$')
GAP4=$(constant '^#define TBX_GAP_ERROR4 (\([0-9.]*\)f \* TBX_U32)$')
GAP_EDGE=$(constant '^#define TBX_GAP_EDGE_ERROR (\([0-9.]*\) \* TBX_U64)$')
GAP_FACE=$(constant '^#define TBX_GAP_FACE_ERROR (\([0-9.]*\) \* TBX_U64)$')
GAP_NORMAL=$(constant '^#define TBX_GAP_NORMAL_ERROR (\([0-9.]*\) \* TBX_U64)$')
GAP_SURE=$(constant '^#define TBX_GAP_SURE \([0-9.]*\) .*')
GAP_LENGTH=$(constant '^#define TBX_GAP_LENGTH \([0-9.e-]*\) .*')
GAP_GUESS=$(constant '^#define TBX_GAP_GUESS \([0-9.e-]*\) .*')
PIERCE4=$(constant '^#define TBX_PIERCE_ERROR4 (\([0-9.]*\)f \* TBX_U32)$')
SLAB=$(constant '^#define TBX_SLAB_ERROR \([0-9.e-]*\) .*')
SLAB_INVERSE=$(constant '^#define TBX_SLAB_INVERSE_ERROR \([0-9.e-]*\) .*')
RAY=$(constant '^#define TBX_RAY_ERROR \([0-9.e-]*\)f .*')
NUM=$(constant '^#define TBX_NUM_ERROR \([0-9.e-]*\) .*' '^#if TBX_DOUBLE_IS_53_BITS')
export SLAB SLAB_INVERSE RAY NUM GAP_FACE
export PIERCE4 SHOT BALL BALL4 PLANE_SPHERE PLANE_SPHERE4 TOUCH PIERCE SEGMENT GAP4 GAP_EDGE GAP_NORMAL GAP_SURE GAP_LENGTH GAP_GUESS
export CROSS_EDGE CROSS_PLANE SOLID SOLID_EDGE SOLID_NORMAL SOLID_PLANE SOLID_LINE SOLID_BOX SOLID_PLACE SOLID_ROW \
    SOLID_ROW_ULPS SOLID_NEAR SOLID_ALONE SOLID_REST SOLID_CLOSE SOLID_FEW PLACE CELL CELL_SUMS
# groups: delta's share of n u; the bounds in units of n delta and n^2 delta
SHARE=$(constant '^#define TBX_PLACED_ERROR (\([0-9.]*\)f \* TBX_U32)$')
LINES=$(constant '^#define TBX_GROUP_EDGE_ERROR \([0-9.]*\)f$')
PLANES=$(constant '^#define TBX_GROUP_PLANE_ERROR \([0-9.]*\)f$')
SMALL_EDGE=$(constant '^#define TBX_SMALL_EDGE_ERROR \([0-9.]*\) .*')
SMALL_PLANE=$(constant '^#define TBX_SMALL_PLANE_ERROR \([0-9.]*\) .*')
LONE_EDGE=$(constant '^#define TBX_LONE_EDGE_ERROR (\([0-9.]*\)f \* TBX_U32)$')
LONE_PLANE=$(constant '^#define TBX_LONE_PLANE_ERROR (\([0-9.]*\)f \* TBX_U32)$')
export LONE_EDGE LONE_PLANE SMALL_EDGE SMALL_PLANE SHARE LINES PLANES ULPS TRI NORMAL COORDINATE LINE WALK_NORMAL FIXED GRID
echo "constants of tribox.h: one box $ULPS; prepared $TRI;" \
    "sign of the normal $NORMAL; walk $COORDINATE, $LINE, $WALK_NORMAL and $FIXED; grid plane $GRID;" \
    "groups $SHARE, $LINES and $PLANES; the walk's small boxes $SMALL_EDGE and $SMALL_PLANE"

# UNITS(n): n + 1/8 units of 2^-P, so that terms of second order fit; sums of several such are one or two units
# above what the header's comment counts, which leaves them out. BELOW(n): n - 1 units, since the header rounds its
# bound too. FUSED and PLAIN: lines for one kind of contraction.
prove() { # script, P, FUSED or PLAIN, N: lines for boxes of N^3 voxels
    local other=PLAIN n=${4:-0}
    rounding "$n"
    [ "$3" = PLAIN ] && other=FUSED
    sed -E -e "s/^$3 //" -e "/^$other /d" -e "s/@ULPS@/$ULPS/g; s/@TRI@/$TRI/g" \
        -e "s/@NORMAL@/$NORMAL/g; s/@WALK_NORMAL@/$WALK_NORMAL/g; s/@FIXED@/$FIXED/g" \
        -e "s/@CROSS_EDGE@/$CROSS_EDGE/g; s/@CROSS_PLANE@/$CROSS_PLANE/g; s/@SOLID@/$SOLID/g" \
        -e "s/@SOLID_EDGE@/$SOLID_EDGE/g; s/@SOLID_NORMAL@/$SOLID_NORMAL/g; s/@SOLID_PLANE@/$SOLID_PLANE/g" \
        -e "s/@BALL@/$BALL/g; s/@BALL4@/$BALL4/g; s/@PLANE_SPHERE@/$PLANE_SPHERE/g; s/@PLANE_SPHERE4@/$PLANE_SPHERE4/g" \
        -e "s/@TOUCH@/$TOUCH/g; s/@PIERCE@/$PIERCE/g; s/@PIERCE4@/$PIERCE4/g; s/@SEGMENT@/$SEGMENT/g; s/@SHOT@/$SHOT/g; s/@GAP4@/$GAP4/g" \
        -e "s/@GAP_EDGE@/$GAP_EDGE/g; s/@GAP_NORMAL@/$GAP_NORMAL/g; s/@GAP_FACE@/$GAP_FACE/g; s/@SLAB@/$SLAB/g" \
        -e "s/@SLAB_INVERSE@/$SLAB_INVERSE/g; s/@RAY@/$RAY/g; s/@NUM@/$NUM/g" \
        -e "s/@SOLID_LINE@/$SOLID_LINE/g; s/@SOLID_BOX@/$SOLID_BOX/g; s/@SOLID_PLACE@/$SOLID_PLACE/g; s/@PLACE@/$PLACE/g" \
        -e "s/@LONE_EDGE@/$LONE_EDGE/g; s/@LONE_PLANE@/$LONE_PLANE/g" \
        -e "s/@GRID@/$GRID/g; s/\bP\b/$2/g; s/^N$n //; /^N[2-4] /d" \
        -e "s/@M@/$((n - 1))/g; s/@N@/$n/g; s/@2MM@/$((2 * mm))/g; s/@4MM@/$((4 * mm))/g; s/@AREA@/$area/g" \
        -e "s/@NN@/$((n * n))/g; s/@3NNM@/$((3 * n * n * (n - 1)))/g; s/@EDGE@/$edge/g" \
        -e "s/@PLANE@/$plane/g" "tests/proofs/$1.gappa" |
        awk -v p="$2" '{
            while (match($0, /(UNITS|BELOW)\([0-9]+\)/)) {
                n = substr($0, RSTART + 6, RLENGTH - 7) * 64
                n += substr($0, RSTART, 5) == "UNITS" ? 8 : -64
                $0 = substr($0, 1, RSTART - 1) n "b-" (p + 6) substr($0, RSTART + RLENGTH)
            }
            print
        }' | tee "$CHECK_DIR/proofs/$1-$2-$3.gappa" | gappa
}

# In units of u: the rounding that groups.gappa proves for boxes of n^3, of the area, of E and D at the last
# point.
rounding() { # n
    mm=$((($1 - 1) * ($1 - 1)))
    area=$((20 * mm + 1))
    edge=$((4 * mm + 2 * ($1 - 2) * ($1 + 2 * mm)))
    plane=$(((8 + 9 * ($1 - 2)) * $1 * $1 * $1))
}

# Coordinates off by delta add 4 (n - 1) delta to E, and where a sign of an edge's component is wrong, 4.6 n
# delta; 4 n delta to the area, and so to the normal; that, times n - 1, and n^2 delta, three times each, to D.
# With the rounding, u <= delta / (SHARE n), this is below the bounds, and leaves a twentieth for terms of
# second order.
groups_room() { # n
    rounding "$1"
    awk -v n="$1" -v share="$SHARE" -v lines="$LINES" -v planes="$PLANES" -v area="$area" -v edge="$edge" \
        -v plane="$plane" 'BEGIN {
            u = 1 / (share * n)
            e = 4 * (n - 1) + 4.6 * n + edge * u
            a = 4 * n + area * u
            d = 3 * (n - 1) * a + 3 * n * n + plane * u
            print "E", e, "area", a, "of", lines * n, "D", d, "of", planes * n * n
            exit !(e <= 0.95 * lines * n && a <= 0.95 * lines * n && d <= 0.95 * planes * n * n)
        }'
}

# The same of the walk's boxes of up to 4^3: delta is COORDINATE u reach, reach 16 or more.
small_room() {
    rounding 4
    awk -v c="$COORDINATE" -v lines="$SMALL_EDGE" -v planes="$SMALL_PLANE" -v area="$area" -v edge="$edge" \
        -v plane="$plane" 'BEGIN {
            u = 1 / (c * 16)
            e = 4 * 3 + 4.6 * 4 + edge * u
            a = 4 * 4 + area * u
            d = 3 * 3 * a + 3 * 4 * 4 + plane * u
            print "E", e, "area", a, "of", lines, "D", d, "of", planes
            exit !(e <= 0.95 * lines && a <= 0.95 * lines && d <= 0.95 * planes)
        }'
}
export -f prove rounding groups_room small_room

# A coordinate of the walk, in units of u reach: 6 (UNITS) of |c + lo|, which is at most 2 reach, and 1 of |c|.
# A line of the walk, in units of delta, the coordinates' error, which is COORDINATE u reach or more: what multiplies 1 and
# what multiplies the slope: coordinates; the slope's 16 u times 2 reach; its roundings.
walk_room() {
    awk -v c="$COORDINATE" -v line="$LINE" 'BEGIN {
        one = 1 + 6.125 / c
        slope = 1 + (32 + 9.125) / c
        at = 2 * 6.125 + 1.125
        print "coordinate:", at, "of", c, "1:", one, "slope:", slope, "of", line
        exit !(at <= c - 0.5 && one <= 0.95 * line && slope <= 0.95 * line)
    }'
}
export -f walk_room
job "proof: grid walk, room in the bound of lines" walk_room

# The solid's rows, in units of R e and of u R^2: E at the first centre, 4 and 4; twice 2 and 10 for the steps to another,
# whose products are at most 2 R^2; six sums of 6 R^2, 36. Their sum at the first centre: 12, and 12 + 12.
solid_room() {
    awk -v row="$SOLID_ROW" -v ulps="$SOLID_ROW_ULPS" 'BEGIN {
        print "R e:", 4 + 2 * 2, 12, "of", row, "u R^2:", 4 + 2 * 10 + 36, 12 + 12, "of", ulps
        exit !(12 <= 0.95 * row && 60 <= 0.95 * ulps)
    }'
}
export -f solid_room
job "proof: solid, room in the bounds of rows" solid_room

# The solid by cells, in units of e: E at the first centre 4 R and a bit, R = 4 cells, and 2 for each of 3 rows and 3 layers, one
# for roundings and e^2; a crossing: E, 3 E for the sum, one for roundings.
solid_cells_room() {
    awk -v cell="$CELL" -v sums="$CELL_SUMS" 'BEGIN { exit !(cell >= 4 * 4 + 2 * (3 + 3) + 1 && sums >= 1 + 3 + 1) }'
}
export -f solid_cells_room
job "proof: solid, room in the bounds of cells" solid_cells_room

# The solid from close by. A corner c is off by PLACE u (|c| + rho), so its sign is sure where |c| > NEAR u rho. A product of
# two such, and their difference, in units of u: PLACE twice, 1 and 1, of the products; PLACE 2.2 rho four times; the errors'
# own product, rho being below 2048. Their sum has two roundings more, of twice the bound. Of CLOSE: three roundings of
# an edge, three more of the plane. Of FEW, beside the edges' CLOSE: a corner in voxels, the product, two sums; the edges'
# sum, with CLOSE and two sums.
solid_close_room() {
    awk -v place="$SOLID_PLACE" -v near="$SOLID_NEAR" -v alone="$SOLID_ALONE" -v rest="$SOLID_REST" -v close_="$SOLID_CLOSE" -v few="$SOLID_FEW" 'BEGIN {
        u = 2 ^ -23
        relative = 2 * place + 2
        absolute = 4 * place * 2.2 + 2 * place * place * u * 2048
        print "near:", place, "of", near, "alone:", relative, "of", alone, "and", absolute, "of", rest, "close:", 6, "of", close_, "few:", 2 * close_ + 3 + 1 + 2 + 2, "of", few
        exit !(place <= 0.9 * near && relative <= 0.95 * alone && relative + 2 <= 0.95 * 2 * alone && absolute <= rest - 0.5 && 6 <= 0.8 * close_ && 2 * close_ + 8 <= 0.8 * few)
    }'
}
export -f solid_close_room
job "proof: solid, room in the bounds from close by" solid_close_room

# A gap is known to 2^-40: what SURE leaves to the sums; the error of l, 4 u of what is at most 1 / sqrt(LENGTH) of it; a
# quarter of the guess's fifth power; some units of rounding.
gap_room() {
    awk -v sure="$GAP_SURE" -v length_="$GAP_LENGTH" -v guess="$GAP_GUESS" 'BEGIN {
        unit = 2 ^ -40
        sums = 1 / sure
        l = 4 * 2 ^ -52 / sqrt(length_)
        root = 1 / 4 * guess ^ 5
        print "sums:", sums / unit, "l:", l / unit, "root:", root / unit, "of", 1
        exit !(sums + l + root + 16 * 2 ^ -52 <= 0.95 * unit)
    }'
}
export -f gap_room
job "proof: contact, room in the accuracy of gaps" gap_room

# 23 and 52: u of every rounding mode; one more: that of rounding to nearest
job "proof: rounding" prove rounding 23 PLAIN
for p in 52 53; do
    job "proof: rays and numbers, 2^-$p" prove rays $p PLAIN
done
for p in 23 24 52 53; do
    job "proof: sums and products, 2^-$p" prove products $p PLAIN
    job "proof: grid walk, 2^-$p" prove walk $p PLAIN
    job "proof: solid, 2^-$p" prove solid $p PLAIN
    job "proof: contact, 2^-$p" prove contact $p PLAIN
    for contraction in PLAIN FUSED; do
        for script in coords lines normal edge plane; do
            job "proof: $script, 2^-$p, $contraction" prove $script $p $contraction
        done
    done
done

job "proof: small boxes of the walk, room in the bounds" small_room
for contraction in PLAIN FUSED; do
    job "proof: small boxes of the walk, 2^-52, $contraction" prove groups 52 $contraction 4
done
for contraction in PLAIN FUSED; do
    job "proof: one triangle's spans, 2^-23, $contraction" prove lone 23 $contraction
done
for n in 2 3 4; do
    job "proof: groups of $n^3, room in the bounds" groups_room $n
    for contraction in PLAIN FUSED; do
        job "proof: groups of $n^3, 2^-23, $contraction" prove groups 23 $contraction $n
    done
done

check_end
