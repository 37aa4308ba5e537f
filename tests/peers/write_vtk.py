"""VTK's voxelizers on a mesh: python3 write_vtk.py MESH.obj OUT    writes OUT.modeller.vti, .stencil.vti, .stencil0.mha

Samples at whole numbers from -8 to 8. The modeller places its own: (max - min) / (n - 1) apart.
"""
import sys

import vtk

N = 17


def points_of(image):
    """The stencil as bytes at points, 1 inside."""
    image.GetPointData().GetScalars().SetName("set")
    return image


def stencil(mesh, tolerance):
    cut = vtk.vtkPolyDataToImageStencil()
    cut.SetInputData(mesh)
    cut.SetOutputOrigin(-8, -8, -8)
    cut.SetOutputSpacing(1, 1, 1)
    cut.SetOutputWholeExtent(0, N - 1, 0, N - 1, 0, N - 1)
    if tolerance is not None:
        cut.SetTolerance(tolerance)
    to_image = vtk.vtkImageStencilToImage()
    to_image.SetInputConnection(cut.GetOutputPort())
    to_image.SetInsideValue(1)
    to_image.SetOutsideValue(0)
    to_image.SetOutputScalarTypeToUnsignedChar()
    to_image.Update()
    return points_of(to_image.GetOutput())


def main():
    reader = vtk.vtkOBJReader()
    reader.SetFileName(sys.argv[1])
    reader.Update()
    mesh = reader.GetOutput()

    modeller = vtk.vtkVoxelModeller()
    modeller.SetInputData(mesh)
    modeller.SetSampleDimensions(N, N, N)
    modeller.SetModelBounds(-8, 8, -8, 8, -8, 8)
    modeller.SetScalarTypeToUnsignedChar()
    modeller.SetMaximumDistance(0.2)
    modeller.Update()

    for image, name in ((modeller.GetOutput(), "modeller"), (stencil(mesh, None), "stencil")):
        writer = vtk.vtkXMLImageDataWriter()
        writer.SetFileName(sys.argv[2] + "." + name + ".vti")
        writer.SetInputData(image)
        writer.Write()
    writer = vtk.vtkMetaImageWriter()
    writer.SetFileName(sys.argv[2] + ".stencil0.mha")
    writer.SetInputData(stencil(mesh, 0))
    writer.SetCompression(True)
    writer.Write()
    print("VTK", vtk.vtkVersion.GetVTKVersion())


main()
