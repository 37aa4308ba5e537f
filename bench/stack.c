/* stack.c - every public function, kept, so that the compiler reports the stack of each: make bench-stack */
#include "tribox.h"

typedef void (*any_function)(void);

extern const any_function stack_roots[];

const any_function stack_roots[] = {
    (any_function)tribox_overlap,
    (any_function)tribox_overlap_f64,
    (any_function)tribox_overlap_rule,
    (any_function)tribox_sat,
    (any_function)tribox_tri_init,
    (any_function)tribox_overlap_rule_f64,
    (any_function)tribox_tri_test,
    (any_function)tribox_tri_init_f64,
    (any_function)tribox_tri_test_f64,
    (any_function)tribox_grid_spans,
    (any_function)tribox_grid_words,
    (any_function)tribox_grid_spans_f64,
    (any_function)tribox_grid_fill,
    (any_function)tribox_grid_fill_f64,
    (any_function)tribox_mesh_spans,
    (any_function)tribox_mesh_spans_f64,
    (any_function)tribox_grid_fit_f64,
    (any_function)tribox_grid_get,
    (any_function)tribox_grid_fit,
    (any_function)tribox_grid_locate,
#ifdef STACK_COMPANIONS
    (any_function)tribox_box_box,
    (any_function)tribox_plane_box,
    (any_function)tribox_segment_box,
    (any_function)tribox_ray_box,
    (any_function)tribox_sweep,
    (any_function)tribox_tri_resize,
    (any_function)tribox_clip,
    (any_function)tribox_closest,
    (any_function)tribox_tri_resize_f64,
    (any_function)tribox_mesh_query,
    (any_function)tribox_ray_triangle,
    (any_function)tribox_tri_octants,
    (any_function)tribox_tri_octants_f64,
#endif
};
