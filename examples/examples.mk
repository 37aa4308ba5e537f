# Examples and the demo. Other sets of flags go to a folder of their own:
#   make examples B=build/sanitize CFLAGS="-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all"

EXAMPLES := 01_overlap voxelize check_voxels slabs sparse cells octree kdtree slide pick trace colours

.PHONY: build-examples examples demo mpi

build-examples: $(EXAMPLES:%=$(B)/%) ## build the example programs

$(B)/slabs: EXAMPLE_LIBS := -pthread
$(EXAMPLES:%=$(B)/%): $(B)/%: examples/%.c $(wildcard examples/*.h) tribox.h
	@mkdir -p $(B)
	$(CC_C99) $< -o $@ $(EXAMPLE_LIBS) -lm

examples: build-examples ## run the examples: .out files, good and bad meshes, voxels out and in again
	sh tests/test_examples.sh $(B)

demo: $(B)/voxelize ## voxelize the Utah teapot; writes build/teapot.png, .vox and .binvox
	$(B)/voxelize teapot 128 -o $(B)/teapot.png -o $(B)/teapot.vox -o $(B)/teapot.binvox
	@echo
	@echo 'Open $(B)/teapot.png in any viewer.'
	@echo 'MagicaVoxel opens $(B)/teapot.vox, viewvox opens $(B)/teapot.binvox.'
	@echo 'Your own mesh: $(B)/voxelize model.ply 256 -o model.vox   ($(B)/voxelize --help lists the options)'

# Several processes, or machines: needs Open MPI (Debian: libopenmpi-dev, openmpi-bin).
MPICC  ?= mpicc
MPIRUN ?= mpirun --oversubscribe --allow-run-as-root

$(B)/slabs_mpi: examples/slabs_mpi.c $(wildcard examples/*.h) tribox.h
	@mkdir -p $(B)
	OMPI_CC='$(CC)' $(MPICC) -std=c99 -I. $(CFLAGS) -Wall -Wextra $< -o $@ -lm

mpi: $(if $(shell command -v $(MPICC)),$(B)/slabs_mpi) ## fill in 1, 2 and 4 processes with MPI: the same file, byte by byte
	@if ! command -v $(MPICC) > /dev/null; then echo 'SKIP: mpicc not found'; exit 0; fi; \
	for ranks in 1 2 4; do \
	    $(MPIRUN) -n $$ranks $(B)/slabs_mpi teapot 256 $(B)/slabs_$$ranks.binvox || exit 1; \
	done && \
	cmp $(B)/slabs_1.binvox $(B)/slabs_2.binvox && cmp $(B)/slabs_1.binvox $(B)/slabs_4.binvox && \
	test "$$($(MPIRUN) -n 2 $(B)/slabs_mpi --help | grep -c '^usage: slabs_mpi')" = 1 && \
	$(MPIRUN) -n 2 $(B)/slabs_mpi --version | grep -q '^slabs_mpi, tribox.h ' && \
	if $(MPIRUN) -n 2 $(B)/slabs_mpi --sideways > $(B)/slabs_mpi.log 2>&1; then exit 1; fi && \
	grep -q "unknown option '--sideways'" $(B)/slabs_mpi.log && \
	if $(MPIRUN) -n 2 $(B)/slabs_mpi teapot 16 $(B)/no/such/folder.binvox > $(B)/slabs_mpi.log 2>&1; then exit 1; fi && \
	grep -q 'No such file or directory' $(B)/slabs_mpi.log && \
	if ls $(B)/slabs_?.binvox.* 2> /dev/null; then exit 1; fi && \
	echo 'mpi: 7 passed, 0 failed'
