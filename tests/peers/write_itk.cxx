// ITK's solid of a mesh: write_itk MESH.obj OUT    writes OUT.itk.mha and, compressed, OUT.itk.nrrd
// Samples at whole numbers from -8 to 8.
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkMesh.h>
#include <itkMetaImageIOFactory.h>
#include <itkNrrdImageIOFactory.h>
#include <itkTriangleCell.h>
#include <itkTriangleMeshToBinaryImageFilter.h>
#include <itkVersion.h>

#include <fstream>
#include <iostream>
#include <sstream>

int main(int, char **argv)
{
    typedef itk::Mesh<double, 3> Mesh;
    typedef itk::Image<unsigned char, 3> Image;
    typedef itk::TriangleMeshToBinaryImageFilter<Mesh, Image> Filter;
    itk::MetaImageIOFactory::RegisterOneFactory();
    itk::NrrdImageIOFactory::RegisterOneFactory();
    Mesh::Pointer mesh = Mesh::New();
    std::ifstream in(argv[1]);
    std::string line;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        char kind;
        words >> kind;
        if (kind == 'v') {
            Mesh::PointType p;
            words >> p[0] >> p[1] >> p[2];
            mesh->SetPoint(mesh->GetNumberOfPoints(), p);
        } else {
            Mesh::CellAutoPointer cell;
            cell.TakeOwnership(new itk::TriangleCell<Mesh::CellType>);
            for (unsigned i = 0; i < 3; i++) {
                unsigned long vertex;
                words >> vertex;
                cell->SetPointId(i, vertex - 1);
            }
            mesh->SetCell(mesh->GetNumberOfCells(), cell);
        }
    }
    Filter::Pointer filter = Filter::New();
    Filter::SizeType size;
    Filter::PointType origin;
    size.Fill(17);
    origin.Fill(-8);
    filter->SetInput(mesh);
    filter->SetSize(size);
    filter->SetOrigin(origin);
    filter->SetSpacing(itk::Vector<double, 3>(1.0).GetDataPointer());
    filter->SetInsideValue(1);
    filter->SetOutsideValue(0);
    filter->Update();      // its output has no size before
    const char *const ends[] = {".itk.mha", ".itk.nrrd"};
    for (int i = 0; i < 2; i++) {
        itk::ImageFileWriter<Image>::Pointer writer = itk::ImageFileWriter<Image>::New();
        writer->SetInput(filter->GetOutput());
        writer->SetFileName(std::string(argv[2]) + ends[i]);
        writer->SetUseCompression(i == 1);
        writer->Update();
    }
    std::cout << "ITK " << itk::Version::GetITKVersion() << "\n";
    return 0;
}
