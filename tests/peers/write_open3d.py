"""Open3D's voxels of a mesh: python3 write_open3d.py MESH.obj OUT    writes OUT.open3d.npy, [x][y][z], and its origin

The origin that VoxelGrid reports is printed, for check_voxels --origin.
"""
import sys

import numpy
import open3d

mesh = open3d.io.read_triangle_mesh(sys.argv[1])
grid = open3d.geometry.VoxelGrid.create_from_triangle_mesh(mesh, 1.0)
index = numpy.array([v.grid_index for v in grid.get_voxels()])
dense = numpy.zeros(tuple(index.max(axis=0) + 1), dtype=bool)
dense[tuple(index.T)] = True
numpy.save(sys.argv[2] + ".open3d.npy", dense)
print("Open3D", open3d.__version__)
print("origin", ",".join("%.17g" % x for x in grid.origin))
