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
run=compile # what to do with programs: the golden one says itself that there is no GPU
if [ -e /dev/nvidiactl ]; then
    here=native
    run=compile_and_run
    echo "a GPU is present: device code is run"
else
    here=sm_$oldest
    echo "SKIP: no GPU: device code is compiled only"
fi

arches="$oldest 80 90 $newest"
if [ "$run" = compile ]; then
    arches="$oldest $newest" # what is not run is compiled less often
fi
for math in "" --use_fast_math; do
    for arch in $arches; do
        # shellcheck disable=SC2086
        job "cuda: device.cu sm_$arch $math" compile "$out/device-$arch$math.o" tests/compile/device.cu -c \
            -Itests/compile -arch=sm_"$arch" $math
    done
    # shellcheck disable=SC2086
    job "cuda: golden.cu $here $math" compile_and_run "$out/golden$math" tests/golden.cu -arch="$here" $math
    if [ -e examples/cuda_overlap.cu ]; then
        # shellcheck disable=SC2086
        job "cuda: cuda_overlap.cu $here $math" $run "$out/cuda_overlap$math" examples/cuda_overlap.cu \
            -arch="$here" $math
    fi
done

check_end
