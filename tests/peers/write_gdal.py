"""GDAL's rasters of flat triangles: python3 write_gdal.py OUT    writes OUT.obj and OUT.gdal.mha, one layer of pixels

-at (all touched), pixels of 1 from -8 to 8; rows run downward in GDAL and are turned here.
"""
import struct
import sys

from osgeo import gdal, ogr

gdal.UseExceptions()
N = 16
TRIANGLES = [[(-6, -6), (-2, -6), (-2, -3)], [(0.5, 0.5), (5.25, 1.5), (2.5, 6.75)], [(-7, 1), (-3, 5), (-7, 5)],
             [(3, -6), (6.5, -6), (6.5, -2.5)]]

raster = gdal.GetDriverByName("MEM").Create("", N, N, 1, gdal.GDT_Byte)
raster.SetGeoTransform((-8, 1, 0, 8, 0, -1))
source = ogr.GetDriverByName("Memory").CreateDataSource("")       # a layer lives as long as its source
layer = source.CreateLayer("", None, ogr.wkbPolygon)
with open(sys.argv[1] + ".obj", "w") as out:
    for t, corners in enumerate(TRIANGLES):
        ring = ogr.Geometry(ogr.wkbLinearRing)
        for x, y in corners + corners[:1]:
            ring.AddPoint_2D(x, y)
        polygon = ogr.Geometry(ogr.wkbPolygon)
        polygon.AddGeometry(ring)
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetGeometry(polygon)
        layer.CreateFeature(feature)
        for x, y in corners:
            out.write("v %.9g %.9g 0\n" % (x, y))
        out.write("f %d %d %d\n" % (3 * t + 1, 3 * t + 2, 3 * t + 3))
gdal.RasterizeLayer(raster, [1], layer, burn_values=[1], options=["ALL_TOUCHED=TRUE"])
rows = [raster.GetRasterBand(1).ReadRaster(0, y, N, 1) for y in range(N)]
with open(sys.argv[1] + ".gdal.mha", "wb") as out:
    out.write(b"ObjectType = Image\nNDims = 3\nOffset = -7.5 -7.5 0\nElementSpacing = 1 1 1\nDimSize = %d %d 1\n" % (N, N))
    out.write(b"ElementType = MET_UCHAR\nElementDataFile = LOCAL\n")
    out.write(b"".join(reversed(rows)))
print("GDAL", gdal.VersionInfo("RELEASE_NAME"))
