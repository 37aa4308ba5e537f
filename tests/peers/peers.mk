# Other programs on our meshes and hard cases; outside CI, needs many packages of Debian's and npm's: see its README.

PEERS_CASES ?= 20000

.PHONY: peers peers-boxes peers-conventions

peers: peers-conventions peers-boxes ## other voxelizers' conventions, other libraries' box tests (not in CI)

peers-conventions: $(B)/check_voxels ## VTK, ITK, OpenVDB, Open3D, MRtrix, GDAL, PCL, OctoMap on our meshes
	bash tests/peers/conventions.sh $(B)

peers-boxes: ## GTS, CGAL, ODE, Bullet, FCL, OpenSceneGraph, Open3D, VTK, npm: false answers per million
	bash tests/peers/boxes.sh $(B) $(PEERS_CASES)
