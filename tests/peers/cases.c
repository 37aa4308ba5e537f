/* Writes the hard cases for the peers' box tests, with exact answers:  cases FILE [cases of each class]
 * and prints, as a row of the table, how many of a million touch.
 *
 * A case is 17 doubles: its class, the triangle, the box's least and greatest corner, the exact answer (closed). All but
 * the last class are floats, so that every library is asked the same question.
 */
#include "peers.h"
#include "tribox.h"

#include <math.h>
#include <string.h>

static uint64_t state = 20260101;

static uint32_t draw(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 33);
}

/* a float in [-1, 1) */
static double spread(void)
{
    return (double)((float)draw() / 1073741824.0f - 1.0f);
}

static int whole(int least, int most)
{
    return least + (int)(draw() % (uint32_t)(most - least + 1));
}

static void random_pair(double c[17], double offset)
{
    int i;
    int a;
    for (a = 0; a < 3; a++) {
        double x = spread();
        double y = spread();
        for (i = 0; i < 3; i++) {
            c[1 + 3 * i + a] = (double)(float)(spread() + offset);
        }
        c[10 + a] = (double)(float)(fmin(x, y) + offset);
        c[13 + a] = (double)(float)(fmax(x, y) + offset);
    }
}

static void grid_pair(double c[17], int decimals)
{
    int i;
    int a;
    for (a = 0; a < 3; a++) {
        int low = whole(0, 4);
        for (i = 0; i < 3; i++) {
            c[1 + 3 * i + a] = decimals ? (double)(0.1f * (float)whole(0, 5)) : whole(0, 5);
        }
        c[10 + a] = decimals ? (double)(0.1f * (float)low) : low;
        c[13 + a] = decimals ? (double)(0.1f * (float)(low + 1)) : low + 1;
    }
}

static void make(int kind, double c[17])
{
    int a = whole(0, 2);
    int i;
    switch (kind) {
    case RANDOM: random_pair(c, 0); break;
    case FAR_OFF: random_pair(c, 1000); break;
    case TENTHS: grid_pair(c, 1); break;
    case INTEGERS: grid_pair(c, 0); break;
    case FACE_PLANE:
    case FACE_PLANE_DOUBLE:
        random_pair(c, 0);
        for (i = 0; kind == FACE_PLANE_DOUBLE && i < 15; i++) {
            c[1 + i] += spread() * 1e-9;
        }
        for (i = 0; i < 3; i++) {       /* in the plane of a face */
            c[1 + 3 * i + a] = c[10 + a];
        }
        break;
    case REPEATED:
        random_pair(c, 0);
        memcpy(c + 7, c + 4, 3 * sizeof *c);
        break;
    case SLIVER:        /* the third corner within a rounding of the middle of the others */
        random_pair(c, 0);
        for (i = 0; i < 3; i++) {
            c[7 + i] = (double)(float)(0.5 * (c[1 + i] + c[4 + i]));
        }
        break;
    default:            /* ULPS: the highest corner along an axis, a float below or above the box's lower face, or on it */
        random_pair(c, 0);
        c[10 + a] = fmax(c[1 + a], fmax(c[4 + a], c[7 + a]));
        i = whole(-1, 1);
        c[10 + a] = i ? (double)nextafterf((float)c[10 + a], i < 0 ? -2.0f : 2.0f) : c[10 + a];
        c[13 + a] = fmax(c[13 + a], c[10 + a]);
        break;
    }
}

int main(int argc, char **argv)
{
    int count = argc > 2 ? atoi(argv[2]) : 20000;
    FILE *file = argc > 1 ? fopen(argv[1], "wb") : NULL;
    double c[17];
    int kind;
    int i;
    if (!file) {
        return 2;
    }
    printf("| *pairs that touch* ");
    for (kind = 0; kind < CLASSES; kind++) {
        double touch = 0;
        for (i = 0; i < count; i++) {
            make(kind, c);
            c[0] = kind;
            c[16] = tribox_overlap_f64(c + 1, c + 4, c + 7, c + 10, c + 13);
            touch += c[16];
            fwrite(c, sizeof c, 1, file);
        }
        printf("| %.0f ", 1e6 * touch / count);
    }
    printf("|\n");
    return fclose(file) ? 2 : 0;
}
