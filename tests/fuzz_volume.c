/* Fuzzes the readers of voxel files in examples/volume.h: no bytes may make them read or write outside, leak, or hang.
 *
 *   clang -std=c99 -I. -O1 -g -fsanitize=fuzzer,address,undefined tests/fuzz_volume.c -o fuzz_volume -lm
 *
 * The first byte names the format.
 */
#define VOX_MOST_BITS 4e9 /* 500 MB: libFuzzer allows 2 GB */
#include "examples/volume.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const names[] = {"x.npy", "x.nrrd", "x.mha", "x.vti", "x.vox", "x"};
    static const size_t dims[3] = {5, 3, 2};
    char error[MESH_ERROR];
    unsigned char *copy;
    volume v;
    int kind;
    if (size < 1) {
        return 0;
    }
    kind = data[0] % 6;
    size -= 1;
    copy = (unsigned char *)calloc(size + 2, 1);
    if (!copy) {
        return 0;
    }
    memcpy(copy, data + 1, size);
    if (volume_read_memory(&v, names[kind], copy, size, kind == 5 ? dims : NULL, 'z', error)) {
        if (volume_count(&v) < 1 << 20) {
            double least;
            double greatest;
            volume_range(&v, &least, &greatest);
        }
        volume_free(&v);
    }
    free(copy);
    return 0;
}
