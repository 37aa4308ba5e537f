// tribox.h's prepared triangle, whose way is another than that of the answers in the file.
#include "peers.h"
#include "tribox.h"
#include <cstdio>
static void peer_begin() {}
static const char *peer_name() { return "tribox.h, tribox_clip_f64 (not the function that made the answers)"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    double polygon[9][3];
    return tribox_clip_f64(v, v + 3, v + 6, lo, hi, polygon) > 0;
}
PEER_MAIN
