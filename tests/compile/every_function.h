/* Calls every function of the interface once, in the common subset of C99 and C++98. Returns the number of
 * wrong answers. Include "tribox.h" first. */
#ifndef EVERY_FUNCTION_H
#define EVERY_FUNCTION_H

static void every_function_emit(void *user, int x0, int x1, int y, int z)
{
    *(int *)user += x1 - x0 + 1 + 0 * (y + z);
}

static int every_function_one_box(void)
{
    const float  t[3][3] = {{0.25f, 0.25f, 0.5f}, {0.75f, 0.25f, 0.5f}, {0.25f, 0.75f, 1.0f}};
    const double d[3][3] = {{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.25, 0.75, 1.0}};
    const float  lo[3] = {0, 0, 1};
    const float  hi[3] = {1, 1, 2};
    const double dlo[3] = {0, 0, 1};
    const double dhi[3] = {1, 1, 2};
    int          wrong = 0;

    wrong += tribox_overlap(t[0], t[1], t[2], lo, hi) != 1;
    wrong += tribox_overlap_f64(d[0], d[1], d[2], dlo, dhi) != 1;
    wrong += tribox_overlap_rule(t[0], t[1], t[2], lo, hi, TRIBOX_HALF_OPEN) != 1;
    wrong += tribox_overlap_rule_f64(d[0], d[1], d[2], dlo, dhi, TRIBOX_OPEN) != 0;
    wrong += tribox_sat(t[0], t[1], t[2], lo, hi) != 1;
    return wrong;
}

static int every_function_tri(void)
{
    const float  t[3][3] = {{0.25f, 0.25f, 0.5f}, {0.75f, 0.25f, 0.5f}, {0.25f, 0.75f, 1.0f}};
    const double d[3][3] = {{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.25, 0.75, 1.0}};
    const float  size[3] = {1, 1, 1};
    const double dsize[3] = {1, 1, 1};
    const float  p[3] = {0, 0, 1};
    const double dp[3] = {0, 0, 1};
    tribox_tri   tri;
    int          wrong = 0;

    tribox_tri_init(&tri, t[0], t[1], t[2], size, 0);
    wrong += tribox_tri_test(&tri, p) != 1;
    wrong += tribox_tri_test_f64(&tri, dp) != 1;
    tribox_tri_init_f64(&tri, d[0], d[1], d[2], dsize, TRIBOX_OPEN);
    wrong += tribox_tri_test(&tri, p) != 0;
    wrong += tribox_tri_test_f64(&tri, dp) != 0;
    return wrong;
}

static void every_function_mesh_span(void *user, size_t triangle, int x0, int x1, int y, int z)
{
    *(int *)user += x1 - x0 + 1 + (int)triangle;
    (void)y;
    (void)z;
}

static int every_function_grid(void)
{
    const float  t[3][3] = {{0.25f, 0.25f, 0.5f}, {0.75f, 0.25f, 0.5f}, {0.25f, 0.75f, 1.0f}};
    const double d[3][3] = {{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.25, 0.75, 1.0}};
    tribox_grid  grid;
    tribox_mesh  mesh;
    tribox_mesh_f64 mesh_f64;
    uint64_t     bits[4] = {0, 0, 0, 0};
    int          index[3];
    int          counted = 0;
    int          wrong = 0;
    int          a;

    for (a = 0; a < 3; a++) {
        grid.origin[a] = 0;
        grid.size[a] = 1;
        grid.lo[a] = 0;
        grid.hi[a] = a == 2 ? 4 : 1;
    }
    grid.flags = 0;
    mesh.positions = t[0];
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    wrong += tribox_grid_spans(&grid, t[0], t[1], t[2], every_function_emit, &counted) != 2;
    wrong += tribox_grid_spans_f64(&grid, d[0], d[1], d[2], every_function_emit, &counted) != 2;
    wrong += counted != 4;
    wrong += tribox_grid_words(&grid) != 4;
    tribox_grid_fill(&grid, &mesh, bits);
    wrong += tribox_grid_get(&grid, bits, 0, 0, 1) != 1;
    mesh_f64.positions = d[0];
    mesh_f64.stride = 0;
    mesh_f64.indices = 0;
    mesh_f64.triangles = 1;
    tribox_grid_fill_f64(&grid, &mesh_f64, bits);
    wrong += tribox_mesh_spans(&grid, &mesh, every_function_mesh_span, &counted) != 2;
    wrong += tribox_mesh_spans_f64(&grid, &mesh_f64, every_function_mesh_span, &counted) != 2;
    wrong += counted != 8;
    wrong += tribox_grid_locate(&grid, d[2], index) != 1 || index[2] != 1;
    wrong += tribox_grid_fit(&grid, &mesh, 4) != 1;
    wrong += tribox_grid_fit_f64(&grid, &mesh_f64, 4) != 1;
    return wrong;
}

/* A triangle across x = 0.25 that holds the centres of rows (0,0) and (0,1), seen along x. */
static int every_function_solid(void)
{
    static const float  t[3][3] = {{0.25f, 0, 0}, {0.25f, 4, 0}, {0.25f, 0, 4}};
    static const double d[3][3] = {{0.25, 0, 0}, {0.25, 4, 0}, {0.25, 0, 4}};
    static const double inside[3] = {0.5, 0.5, 0.5};
    uint64_t            bits[2] = {0, 0};
    tribox_grid         grid;
    tribox_mesh         mesh;
    tribox_mesh_f64     mesh_f64;
    int                 wrong = 0;
    int                 a;

    for (a = 0; a < 3; a++) {
        grid.origin[a] = 0;
        grid.size[a] = 1;
        grid.lo[a] = 0;
        grid.hi[a] = a == 0 ? 2 : 1;
    }
    grid.hi[2] = 2;
    grid.flags = 0;
    mesh.positions = t[0];
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    mesh_f64.positions = d[0];
    mesh_f64.stride = 0;
    mesh_f64.indices = 0;
    mesh_f64.triangles = 1;
    tribox_grid_fill_solid(&grid, &mesh, bits);
    wrong += bits[0] != 3 || bits[1] != 3;
    tribox_grid_fill_solid_f64(&grid, &mesh_f64, bits);
    wrong += bits[0] != 0 || bits[1] != 0;
    wrong += tribox_mesh_contains(&mesh, inside) != 1;
    wrong += tribox_mesh_contains_f64(&mesh_f64, inside) != 1;
    wrong += tribox_ray_crosses(t[0], t[1], t[2], d[0]) != 1;
    return wrong;
}

/* The triangle z = 1 over half of the box [0,2]^3, and a ray up its middle. */
static int every_function_companions(void)
{
    static const float t[3][3] = {{0, 0, 1}, {2, 0, 1}, {0, 2, 1}};
    static const float lo[3] = {0, 0, 0};
    static const float hi[3] = {2, 2, 2};
    static const float from[3] = {0.5f, 0.5f, -1};
    static const float dir[3] = {0, 0, 1};
    float              at[2] = {0, 0};
    float              axis[3];
    float              polygon[9][3];
    uint32_t           found[1] = {7};
    tribox_mesh        mesh;
    tribox_tri         tri;
    int                wrong = 0;

    mesh.positions = t[0];
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    wrong += tribox_box_box(lo, hi, t[0], hi) != 1;
    wrong += tribox_plane_box(dir, -3, lo, hi) != -1;
    wrong += tribox_segment_box(from, t[0], lo, hi) != 1;
    wrong += tribox_ray_box(from, dir, 0, 9, lo, hi, &at[0], &at[1]) != 1 || at[0] < 1 || at[1] > 3;
    wrong += tribox_ray_triangle(from, dir, 0, 9, t[0], t[1], t[2], &at[0]) != 1 || at[0] < 2;
    wrong += tribox_sweep(t[0], t[1], t[2], lo, hi, dir, &at[0], &at[1], axis) != 1 || at[1] < 1;
    wrong += tribox_clip(t[0], t[1], t[2], lo, hi, polygon) != 3 || polygon[0][2] < 1;
    tribox_closest(t[0], t[1], t[2], hi, axis);
    wrong += axis[1] < 0.5f || axis[2] < 0.5f;
    wrong += tribox_mesh_query(&mesh, lo, hi, found, 1) != 1 || found[0] != 0;
    tribox_tri_init(&tri, t[0], t[1], t[2], dir, 0);
    tribox_tri_resize(&tri, hi);
    wrong += tribox_tri_octants(&tri, lo) != 7;
    return wrong;
}

static int every_function_companions_f64(void)
{
    static const double t[3][3] = {{0, 0, 1}, {2, 0, 1}, {0, 2, 1}};
    static const double lo[3] = {0, 0, 0};
    static const double hi[3] = {2, 2, 2};
    static const double from[3] = {0.5, 0.5, -1};
    static const double dir[3] = {0, 0, 1};
    double              at[2] = {0, 0};
    double              weights[3];
    double              polygon[9][3];
    uint32_t            found[1] = {7};
    tribox_mesh_f64     mesh;
    tribox_tri          tri;
    int                 wrong = 0;

    mesh.positions = t[0];
    mesh.stride = 0;
    mesh.indices = 0;
    mesh.triangles = 1;
    wrong += tribox_box_box_f64(lo, hi, t[0], hi) != 1;
    wrong += tribox_segment_box_f64(from, t[0], lo, hi) != 1;
    wrong += tribox_ray_box_f64(from, dir, 0, 9, lo, hi, &at[0], &at[1]) != 1 || at[0] < 1 || at[1] > 3;
    wrong += tribox_ray_triangle_f64(from, dir, 0, 9, t[0], t[1], t[2], &at[0]) != 1 || at[0] < 2;
    wrong += tribox_clip_f64(t[0], t[1], t[2], lo, hi, polygon) != 3 || polygon[0][2] < 1;
    tribox_closest_f64(t[0], t[1], t[2], hi, weights);
    wrong += weights[1] < 0.5 || weights[2] < 0.5;
    wrong += tribox_mesh_query_f64(&mesh, lo, hi, found, 1) != 1 || found[0] != 0;
    tribox_tri_init_f64(&tri, t[0], t[1], t[2], dir, 0);
    tribox_tri_resize_f64(&tri, hi);
    wrong += tribox_tri_octants_f64(&tri, lo) != 7;
    return wrong;
}

static int every_function_voxel(void *user, int x, int y, int z)
{
    *(int *)user += 1 + 0 * (x + y + z);
    return 0;
}

static int every_function_contact(void)
{
    static const float t[3][3] = {{0, 0, 1}, {2, 0, 1}, {0, 2, 1}};
    static const float lo[3] = {0, 0, 1};
    static const float hi[3] = {2, 2, 2};
    static const float down[3] = {0, 0, -1};
    static const double p[3] = {0.5, 0.5, -1};
    static const double q[3] = {0.5, 0.5, 3.5};
    tribox_grid        grid;
    float              at[2] = {9, 9};
    float              axis[3] = {9, 9, 9};
    int                counted = 0;
    int                wrong = 0;
    int                a;

    for (a = 0; a < 3; a++) {
        grid.origin[a] = 0;
        grid.size[a] = 1;
        grid.lo[a] = 0;
        grid.hi[a] = 3;
    }
    grid.flags = 0;
    wrong += tribox_sweep_rule(t[0], t[1], t[2], lo, hi, down, TRIBOX_OPEN, &at[0], &at[1], axis) != 1 || axis[2] < 1;
    wrong += tribox_sweep_box(lo, hi, t[0], t[0], down, 0, &at[0], &at[1], axis) != 1 || at[0] > 0 || at[1] < 1;
    wrong += tribox_gap(t[0], t[1], t[2], lo, hi, axis) < 0 || axis[2] < 1;
    wrong += tribox_grid_segment(&grid, p, q, every_function_voxel, &counted) != 3 || counted != 3;
    wrong += tribox_sphere_sphere(lo, 1, hi, 2) != 1;
    wrong += tribox_plane_sphere(down, 0, hi, 1) != -1;
    wrong += tribox_sphere_box(t[0], 1, lo, hi) != 1;
    wrong += tribox_sphere_triangle(hi, 1.5f, t[0], t[1], t[2]) != 0;
    wrong += tribox_ray_sphere(hi, down, 0, 9, t[1], 2.5f, &at[0], &at[1]) != 1 || at[0] > 0 || at[1] < 2;
    return wrong;
}

static int every_function(void)
{
    return every_function_one_box() + every_function_tri() + every_function_grid() + every_function_solid() +
           every_function_companions() + every_function_companions_f64() + every_function_contact();
}

#endif /* EVERY_FUNCTION_H */
