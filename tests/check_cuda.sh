#!/usr/bin/env bash
# The header in device code: compiled for several architectures, with and without --use_fast_math, and run
# where there is a GPU. Run from the repository's root.
set -u
. tests/check_lib.sh

PATH=$PATH:/usr/local/cuda/bin
NVCC=${NVCC:-nvcc}
out=$CHECK_DIR/cuda
mkdir -p "$out"

# Warnings are errors, but for functions of the header that a file does not use.
compile() { # output, source, flags...
    "$NVCC" -std=c++17 -I. -Werror all-warnings -diag-suppress 177 "${@:3}" "$2" -o "$1"
}
compile_and_run() { # output, source, flags...
    compile "$@" && "$1"
}
export NVCC
export -f compile compile_and_run

if ! have "$NVCC"; then
    echo "SKIP: the CUDA checks: no $NVCC"
    exit 0
fi

arches=$("$NVCC" --list-gpu-arch | sed 's/compute_//' | sort -n)
oldest=$(echo "$arches" | head -n 1)
newest=$(echo "$arches" | tail -n 1)
here=
if [ -e /dev/nvidiactl ]; then
    here=native
    echo "a GPU is present: device code is run"
fi
if [ -z "$here" ]; then # minutes for each, so few
    echo "SKIP: no GPU: golden.cu and cuda_overlap.cu"
    job "cuda: device.cu sm_$oldest" compile "$out/device-$oldest.o" tests/compile/device.cu -c -Itests/compile \
        -arch=sm_"$oldest"
    job "cuda: device.cu sm_$newest --use_fast_math" compile "$out/device-$newest.o" tests/compile/device.cu -c \
        -Itests/compile -arch=sm_"$newest" --use_fast_math
    check_end
    exit
fi
for math in "" --use_fast_math; do
    for arch in $oldest 80 90 $newest; do
        # shellcheck disable=SC2086
        job "cuda: device.cu sm_$arch $math" compile "$out/device-$arch$math.o" tests/compile/device.cu -c \
            -Itests/compile -arch=sm_"$arch" $math
    done
    # shellcheck disable=SC2086
    job "cuda: golden.cu $here $math" compile_and_run "$out/golden$math" tests/golden.cu -arch="$here" $math
    # shellcheck disable=SC2086
    job "cuda: cuda_overlap.cu $here $math" compile_and_run "$out/cuda_overlap$math" examples/cuda_overlap.cu \
        -arch="$here" $math
done

check_end
