/* What a peer's program shares: the classes, and a main that asks every case and prints false answers per million.
 *
 *   #define PEER "name version"
 *   static int peer(const double v[9], const double lo[3], const double hi[3]) { ... 1, 0, or -1: not asked ... }
 *   PEER_MAIN
 */
#ifndef PEERS_H
#define PEERS_H
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { RANDOM, FAR_OFF, TENTHS, INTEGERS, FACE_PLANE, REPEATED, SLIVER, ULPS, FACE_PLANE_DOUBLE, CLASSES };

/* One row of the table: for each class "missed + invented", per million; "-" where nothing was asked. */
#define PEER_MAIN                                                                              \
    int main(int, char **argv)                                                                 \
    {                                                                                          \
        static double asked[CLASSES], missed[CLASSES], invented[CLASSES];                      \
        FILE *file = fopen(argv[1], "rb");                                                     \
        double c[17];                                                                          \
        int k;                                                                                 \
        if (!file) {                                                                           \
            return 2;                                                                          \
        }                                                                                      \
        peer_begin();                                                                          \
        while (fread(c, sizeof c, 1, file) == 1) {                                             \
            int answer = peer(c + 1, c + 10, c + 13);                                          \
            if (answer >= 0) {                                                                 \
                k = (int)c[0];                                                                 \
                asked[k] += 1;                                                                 \
                missed[k] += answer == 0 && c[16] > 0;                                         \
                invented[k] += answer == 1 && c[16] < 1;                                       \
            }                                                                                  \
        }                                                                                      \
        std::printf("| %s ", peer_name());                                                     \
        for (k = 0; k < CLASSES; k++) {                                                        \
            if (asked[k] > 0) {                                                                \
                std::printf("| %.0f + %.0f ", 1e6 * missed[k] / asked[k], 1e6 * invented[k] / asked[k]); \
            } else {                                                                           \
                std::printf("| - ");                                                           \
            }                                                                                  \
        }                                                                                      \
        std::printf("|\n");                                                                    \
        return 0;                                                                              \
    }
#endif
