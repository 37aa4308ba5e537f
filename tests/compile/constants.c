/* One question each about constant floats: gcc clones what it knows the arguments of, and warned of the code for
 * doubles in the clone, which reads more than there is and never runs. */
#include "tribox.h"

int constants(void);

int constants(void)
{
    static const float o[3] = {0, 0, 0}, d[3] = {1, 2, 3}, lo[3] = {1, 1, 1}, hi[3] = {2, 3, 4};
    const float        v0[3] = {0, 0, 1}, v1[3] = {1, 0, 1}, v2[3] = {0, 1, 1};
    float              t0 = 0;
    float              t1 = 0;
    float              x[9][3];
    int                n = tribox_ray_box(o, d, 0.0f, 10.0f, lo, hi, &t0, &t1);

    n += tribox_ray_triangle(o, d, 0.0f, 10.0f, v0, v1, v2, &t0);
    n += tribox_segment_box(o, d, lo, hi);
    n += tribox_sweep(v0, v1, v2, lo, hi, d, &t0, &t1, x[0]) + tribox_clip(v0, v1, v2, lo, hi, x);
    n += tribox_ray_sphere(o, d, 0.0f, 10.0f, lo, 1.0f, &t0, &t1);
    tribox_closest(v0, v1, v2, d, x[0]);
    return n + (t0 < t1);
}
