// The golden inputs answered by device code: one thread a chunk, then the same hash as everywhere. Without
// a GPU the program says that it was only compiled, and passes.
#include "golden_answers.h"
#include "golden_overlap.h"

#include <cstdio>
#include <vector>

__global__ void golden_kernel(uint64_t *chunks)
{
    const uint32_t chunk = blockIdx.x * blockDim.x + threadIdx.x;
    if (chunk < GOLDEN_CHUNKS) {
        chunks[chunk] = golden_chunk(chunk);
    }
}

static bool failed(cudaError_t status, const char *what)
{
    if (status != cudaSuccess) {
        std::printf("golden gpu: %s: %s\n", what, cudaGetErrorString(status));
    }
    return status != cudaSuccess;
}

int main()
{
    int devices = 0;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
        std::printf("SKIP: no GPU: device code was compiled only\n");
        return 0;
    }
    cudaDeviceProp properties;
    std::vector<uint64_t> chunks(GOLDEN_CHUNKS);
    uint64_t *device = 0;
    if (failed(cudaGetDeviceProperties(&properties, 0), "properties") ||
        failed(cudaDeviceSetLimit(cudaLimitStackSize, 32768), "stack") ||
        failed(cudaMalloc(&device, GOLDEN_CHUNKS * sizeof *device), "memory")) {
        return 1;
    }
    golden_kernel<<<GOLDEN_CHUNKS / 64, 64>>>(device);
    if (failed(cudaGetLastError(), "launch") || failed(cudaDeviceSynchronize(), "run") ||
        failed(cudaMemcpy(chunks.data(), device, GOLDEN_CHUNKS * sizeof *device, cudaMemcpyDeviceToHost),
               "copy")) {
        return 1;
    }
    cudaFree(device);
    uint64_t hash = GOLDEN_BASIS;
    for (uint32_t i = 0; i < GOLDEN_CHUNKS; ++i) {
        hash = golden_mix(hash, chunks[i]);
    }
    const bool ok = hash == GOLDEN_HASH;
    std::printf("golden gpu %s %08lx%08lx %s\n", properties.name, (unsigned long)(hash >> 32),
                (unsigned long)(hash & 0xffffffffu), ok ? "ok" : "DIFFERS");
    return ok ? 0 : 1;
}
