"""OpenVDB's level set of a mesh, dense: python3 write_openvdb.py MESH.obj OUT    writes OUT.openvdb.npy, [x][y][z]

Samples at whole numbers from -8 to 8.
"""
import sys

import numpy
import pyopenvdb


def read_obj(path):
    points, faces = [], []
    for line in open(path):
        word = line.split()
        if word[0] == "v":
            points.append([float(x) for x in word[1:]])
        elif word[0] == "f":
            faces.append([int(i) - 1 for i in word[1:]])
    return numpy.array(points, dtype=numpy.float32), numpy.array(faces, dtype=numpy.uint32)


points, triangles = read_obj(sys.argv[1])
grid = pyopenvdb.FloatGrid.createLevelSetFromPolygons(
    points, triangles=triangles, transform=pyopenvdb.createLinearTransform(1.0), halfWidth=3.0)
dense = numpy.zeros((17, 17, 17), dtype=numpy.float32)
grid.copyToArray(dense, ijk=(-8, -8, -8))
numpy.save(sys.argv[2] + ".openvdb.npy", dense)
print("OpenVDB", ".".join(str(i) for i in pyopenvdb.LIBRARY_VERSION))
