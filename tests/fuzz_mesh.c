/* The mesh readers of the examples on any bytes: no crash, no overrun, and indices that lie inside the
 * vertices.
 *
 *   clang -std=c99 -I. -g -O1 -fsanitize=fuzzer,address,undefined tests/fuzz_mesh.c -o build/fuzz_mesh -lm
 *   build/fuzz_mesh -max_total_time=60
 *
 * The first byte chooses the name's ending, the rest is the file.
 */
#include "examples/mesh_stats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const names[6] = {"a.obj", "a.stl", "a.ply", "a", "a.off", "a.gltf"};
    char error[MESH_ERROR] = "";
    unsigned char *bytes;
    mesh m;
    size_t edges;
    if (size == 0) {
        return 0;
    }
    /* exactly the two zero bytes that the reader asks for */
    bytes = (unsigned char *)calloc(size + 1, 1);
    if (!bytes) {
        return 0;
    }
    memcpy(bytes, data + 1, size - 1);
    if (mesh_read_memory(&m, names[data[0] % 6], bytes, size - 1, error)) {
        mesh_measure(&m);
        if (m.triangles == 0 || !mesh_open_edges(&m, &edges)) {
            abort();
        }
        mesh_free(&m);
    } else if (error[0] == 0 || m.positions || m.indices) {
        abort();
    }
    free(bytes);
    return 0;
}
