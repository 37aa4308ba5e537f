"""The meshes of the comparison, as OBJ files in a folder: python3 meshes.py FOLDER

A box on whole and half numbers tells how faces count, a tilted one and a sphere where voxels lie, an octahedron has
edges and corners on samples.
"""
import math
import os
import struct
import sys


def write(path, points, faces):
    with open(path, "w") as out:
        for p in points:
            out.write("v %.9g %.9g %.9g\n" % struct.unpack("3f", struct.pack("3f", *p)))     # floats, exactly
        for f in faces:
            out.write("f " + " ".join(str(i + 1) for i in f) + "\n")


def box(lo, hi):
    points = [(x, y, z) for z in (lo[2], hi[2]) for y in (lo[1], hi[1]) for x in (lo[0], hi[0])]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for q in quads for t in (q[:3], (q[0], q[2], q[3]))]


def octahedron(r):
    points = [(r, 0, 0), (-r, 0, 0), (0, r, 0), (0, -r, 0), (0, 0, r), (0, 0, -r)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    return points, faces


def sphere(r, n):
    points = [(0, 0, r)]
    for i in range(1, n):
        for j in range(2 * n):
            t, p = math.pi * i / n, math.pi * j / n
            points.append((r * math.sin(t) * math.cos(p), r * math.sin(t) * math.sin(p), r * math.cos(t)))
    points.append((0, 0, -r))
    faces = []
    for j in range(2 * n):
        k = (j + 1) % (2 * n)
        faces.append((0, 1 + j, 1 + k))
        for i in range(n - 2):
            a, b = 1 + i * 2 * n, 1 + (i + 1) * 2 * n
            faces += [(a + j, b + j, b + k), (a + j, b + k, a + k)]
        faces.append((1 + (n - 2) * 2 * n + j, len(points) - 1, 1 + (n - 2) * 2 * n + k))
    return points, faces


def turned(mesh):
    c, s = math.cos(0.6), math.sin(0.6)
    points = []
    for x, y, z in mesh[0]:
        x, y = c * x - s * y, s * x + c * y
        y, z = c * y - s * z, s * y + c * z
        points.append((x + 0.137, y - 0.211, z + 0.07))
    return points, mesh[1]


MESHES = {
    "box": box((-3, -3, -3), (3, 4, 2)),
    "halves": box((-2.5, -3.5, -2.5), (3.5, 2.5, 3.5)),
    "octahedron": octahedron(5),
    "tilted": turned(box((-3.1, -2.2, -4.1), (2.9, 3.3, 1.8))),
    "sphere": turned(sphere(5.3, 12)),
}

if __name__ == "__main__":
    os.makedirs(sys.argv[1], exist_ok=True)
    for name, mesh in MESHES.items():
        write(os.path.join(sys.argv[1], name + ".obj"), *mesh)
