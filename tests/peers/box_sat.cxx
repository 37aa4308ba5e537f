// The textbook in plain float, tribox_sat: for comparison.
#include "peers.h"
#include "tribox.h"
#include <cstdio>
static void peer_begin() {}
static const char *peer_name() { return "tribox_sat, the 13 axes in plain float"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    float f[15];
    for (int i = 0; i < 15; i++) {
        const double x = i < 9 ? v[i] : i < 12 ? lo[i - 9] : hi[i - 12];
        f[i] = (float)x;
        if ((double)f[i] != x) {
            return -1;
        }
    }
    return tribox_sat(f, f + 3, f + 6, f + 9, f + 12);
}
PEER_MAIN
