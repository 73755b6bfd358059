// The octree on its mesh: signature, field data, files, and meshes that changed under it.
#include "svoMeshOctree.h"
#include "svoMeshSignature.h"
#include "svoMeshTriangles.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkClipPolyData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationInformationVectorKey.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTransformFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersion.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <thread>

#include <gtest/gtest.h>

namespace
{
vtkSmartPointer<vtkPolyData> sphere(int precision = vtkAlgorithm::SINGLE_PRECISION)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(24);
  source->SetPhiResolution(16);
  source->SetCenter(0.1, 1.0 / 3.0, -7.7);
  source->SetOutputPointsPrecision(precision);
  source->Update();
  return source->GetOutput();
}

svo::Octree built(vtkPolyData* mesh, int level = 5)
{
  svo::MeshOctreeOptions options;
  options.level = level;
  svo::Octree octree;
  std::string message;
  EXPECT_EQ(svo::buildMeshOctree(mesh, options, octree, message), svo::BuildStatus::Built);
  EXPECT_EQ(message, "");
  return octree;
}

svo::Attached opened(vtkPolyData* mesh, svo::Octree& octree)
{
  std::string message;
  const svo::Attached state = svo::openAttachedOctree(mesh, octree, message);
  EXPECT_EQ(message.empty(), state != svo::Attached::Damaged);
  EXPECT_EQ(static_cast<bool>(octree), state == svo::Attached::Found);
  return state;
}

svo::Attached stateOf(vtkPolyData* mesh)
{
  svo::Octree octree;
  return opened(mesh, octree);
}

vtkSmartPointer<vtkPolyData> withOctree(vtkSmartPointer<vtkPolyData> mesh)
{
  svo::attachOctree(mesh, built(mesh));
  return mesh;
}

vtkSmartPointer<vtkPolyData> copyOf(vtkPolyData* mesh)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(mesh);
  return copy;
}
}

TEST(MeshSignature, DependsOnPointsAndCellsAndNothingElse)
{
  const auto mesh = sphere();
  const std::uint64_t signature = svo::meshSignature(mesh);
  EXPECT_NE(signature, 0u);
  EXPECT_EQ(svo::meshSignature(copyOf(mesh)), signature);

  const auto coloured = copyOf(mesh);
  vtkNew<vtkFloatArray> scalars;
  scalars->SetNumberOfValues(coloured->GetNumberOfPoints());
  scalars->FillValue(1.0f);
  coloured->GetPointData()->SetScalars(scalars);
  EXPECT_EQ(svo::meshSignature(coloured), signature);

  const auto moved = copyOf(mesh);
  double x[3];
  moved->GetPoint(100, x);
  moved->GetPoints()->SetPoint(100, x[0], x[1], std::nextafter(float(x[2]), 100.0f));
  moved->GetPoints()->Modified();
  EXPECT_NE(svo::meshSignature(moved), signature);

  const auto turned = copyOf(mesh);
  turned->BuildCells();
  turned->ReverseCell(17);
  turned->GetPolys()->Modified();
  EXPECT_NE(svo::meshSignature(turned), signature);

  const auto shifted = copyOf(mesh); // every cell id is one higher
  vtkNew<vtkCellArray> vertex;
  vertex->InsertNextCell({ 0 });
  shifted->SetVerts(vertex);
  EXPECT_NE(svo::meshSignature(shifted), signature);
}

TEST(MeshSignature, DoesNotDependOnTheIntegerWidthOfTheCells)
{
  const auto mesh = sphere();
  const auto narrow = copyOf(mesh);
  const auto wide = copyOf(mesh);
  ASSERT_TRUE(narrow->GetPolys()->ConvertTo32BitStorage());
  ASSERT_TRUE(wide->GetPolys()->ConvertTo64BitStorage());
  EXPECT_EQ(svo::meshSignature(narrow), svo::meshSignature(wide));
}

// From VTK 9.6 on, cells that all have one size may be stored without offsets, and ids as any
// array; vtkFlyingEdges3D and others make such meshes. Before, what it makes is stored as
// everything else.
TEST(MeshSignature, DoesNotDependOnHowAFilterStoresItsCells)
{
  vtkNew<vtkImageData> field; // distances from the middle of one of its faces
  field->SetDimensions(12, 12, 12);
  field->AllocateScalars(VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < field->GetNumberOfPoints(); ++i)
  {
    const double* p = field->GetPoint(i);
    field->GetPointData()->GetScalars()->SetTuple1(i, std::hypot(p[0], p[1] - 5.5, p[2] - 5.5));
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(field);
  contour->SetValue(0, 4.2);
  contour->Update();
  vtkPolyData* mesh = contour->GetOutput();
  ASSERT_GT(mesh->GetNumberOfPolys(), 100);
  const auto ordinary = copyOf(mesh);
  ASSERT_TRUE(ordinary->GetPolys()->ConvertTo64BitStorage());
  EXPECT_EQ(svo::meshSignature(mesh), svo::meshSignature(ordinary));

  const auto changed = copyOf(ordinary);
  changed->GetPolys()->ReplaceCellAtId(7, { 0, 1, 2 });
  changed->GetPolys()->Modified();
  EXPECT_NE(svo::meshSignature(mesh), svo::meshSignature(changed));

  const svo::MeshTriangles expected(ordinary);
  const svo::MeshTriangles triangles(mesh);
  EXPECT_EQ(expected.view().triangleCount, static_cast<std::size_t>(mesh->GetNumberOfPolys()));
  ASSERT_EQ(triangles.view().triangleCount, expected.view().triangleCount);
  for (std::size_t i = 0; i < expected.view().triangleCount; ++i)
  {
    ASSERT_EQ(triangles.view().triangles[i], expected.view().triangles[i]);
  }
}

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
TEST(MeshSignature, DoesNotDependOnWhetherOffsetsAreStored)
{
  const auto mesh = sphere();
  for (const auto convert : { &vtkCellArray::ConvertToFixedSize32BitStorage,
         &vtkCellArray::ConvertToFixedSize64BitStorage })
  {
    const auto fixed = copyOf(mesh);
    ASSERT_TRUE((fixed->GetPolys()->*convert)());
    ASSERT_TRUE(fixed->GetPolys()->IsStorageFixedSize());
    EXPECT_EQ(svo::meshSignature(fixed), svo::meshSignature(mesh));
    EXPECT_EQ(svo::MeshTriangles(fixed).view().triangleCount,
      svo::MeshTriangles(mesh).view().triangleCount);
    EXPECT_TRUE(fixed->GetPolys()->IsStorageFixedSize()) << "the mesh is left alone";
  }
}
#endif

TEST(MeshSignature, IsComputedOncePerChangeAndLeavesTheMeshAlone)
{
  const auto mesh = copyOf(sphere());
  const vtkMTimeType time = mesh->GetMTime();
  const std::uint64_t before = svo::numberOfHashedArrays();
  svo::meshSignature(mesh);
  EXPECT_EQ(svo::numberOfHashedArrays(), before + 2); // points and polygons
  svo::meshSignature(mesh);
  vtkNew<vtkPolyData> shallow;
  shallow->ShallowCopy(mesh);
  svo::copySignature(mesh, shallow);
  EXPECT_EQ(svo::meshSignature(shallow), svo::meshSignature(mesh));
  EXPECT_EQ(svo::numberOfHashedArrays(), before + 2);
  mesh->GetPoints()->Modified();
  svo::meshSignature(mesh);
  EXPECT_EQ(svo::numberOfHashedArrays(), before + 3);
  EXPECT_EQ(mesh->GetPolys()->GetMTime() > time, false);
}

TEST(MeshSignature, NoticesWhatIsWrittenInPlaceWhenTheMeshSaysSo)
{
  const auto mesh = copyOf(sphere());
  const std::uint64_t original = svo::meshSignature(mesh);
  mesh->GetPolys()->ReplaceCellAtId(7, { 0, 1, 2 });
  mesh->Modified();
  const std::uint64_t otherCells = svo::meshSignature(mesh);
  EXPECT_NE(otherCells, original);
  EXPECT_EQ(otherCells, svo::meshSignature(copyOf(mesh)));

  mesh->GetPoints()->SetPoint(100, 1.0, 2.0, 3.0);
  mesh->Modified();
  EXPECT_NE(svo::meshSignature(mesh), otherCells);
  EXPECT_EQ(svo::meshSignature(mesh), svo::meshSignature(copyOf(mesh)));

  // A copy that shares the arrays is younger than the edit.
  mesh->GetPolys()->ReplaceCellAtId(8, { 3, 1, 2 });
  vtkNew<vtkPolyData> shallow;
  shallow->ShallowCopy(mesh);
  EXPECT_EQ(svo::meshSignature(shallow), svo::meshSignature(copyOf(mesh)));
}

TEST(MeshSignature, CanBeAskedForFromManyThreads)
{
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  for (int i = 0; i < 8; ++i)
  {
    meshes.push_back(copyOf(sphere()));
  }
  std::vector<std::uint64_t> signatures(4 * meshes.size());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (std::size_t i = 0; i < meshes.size(); ++i)
        {
          signatures[t * meshes.size() + i] = svo::meshSignature(meshes[i]);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (std::uint64_t signature : signatures)
  {
    EXPECT_EQ(signature, signatures[0]);
  }
}

TEST(MeshOctree, IsSignedWithItsMesh)
{
  const auto mesh = sphere();
  const svo::Octree octree = built(mesh);
  EXPECT_EQ(octree.header().signature, svo::meshSignature(mesh));
  EXPECT_EQ(octree.header().pointCount, static_cast<std::uint64_t>(mesh->GetNumberOfPoints()));
  EXPECT_EQ(octree.header().cellCount, static_cast<std::uint64_t>(mesh->GetNumberOfCells()));
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(octree.header().meshBounds[i], mesh->GetBounds()[i]);
  }
}

TEST(MeshOctree, BoundsThatSayNothingAreNoPartOfIt)
{
  const auto mesh = sphere();
  svo::MeshOctreeOptions options;
  options.level = 3;
  options.modelBounds = { -9.0, 9.0, 5.0, -5.0, 1.0, -1.0 };
  svo::Octree octree;
  std::string message;
  ASSERT_EQ(svo::buildMeshOctree(mesh, options, octree, message), svo::BuildStatus::Built);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(octree.header().meshBounds[i], mesh->GetBounds()[i]);
  }
}

TEST(MeshOctree, IsOpenOnceAndOutlivesTheMesh)
{
  svo::Octree octree;
  {
    auto mesh = sphere();
    const svo::Octree original = built(mesh);
    svo::attachOctree(mesh, original);
    ASSERT_EQ(opened(mesh, octree), svo::Attached::Found);
    EXPECT_EQ(octree.key(), original.key());
    EXPECT_EQ(octree.surface(), original.surface());
    vtkNew<vtkPolyData> shallow;
    shallow->ShallowCopy(mesh);
    svo::Octree again;
    ASSERT_EQ(opened(shallow, again), svo::Attached::Found);
    EXPECT_EQ(again.key(), original.key());
  }
  EXPECT_GT(octree.header().voxelCount, 0u);
  EXPECT_TRUE(octree.occupied(glm::ivec3(0), 0));
}

TEST(MeshOctree, TheRangeOfItsBytesIsKnown)
{
  const auto mesh = sphere();
  svo::attachOctree(mesh, built(mesh, 6));
  auto* array =
    vtkUnsignedCharArray::SafeDownCast(mesh->GetFieldData()->GetArray(svo::OctreeArrayName));
  EXPECT_TRUE(array->GetInformation()->Has(vtkAbstractArray::PER_COMPONENT()));
  EXPECT_TRUE(array->GetInformation()->Has(vtkAbstractArray::PER_FINITE_COMPONENT()));
  const auto bytes =
    std::minmax_element(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
  double range[2], finite[2];
  array->GetRange(range);
  array->GetFiniteRange(finite);
  EXPECT_LE(range[0], *bytes.first);
  EXPECT_GE(range[1], *bytes.second);
  EXPECT_EQ(finite[0], range[0]);
  EXPECT_EQ(finite[1], range[1]);
}

TEST(MeshOctree, ReplacesAnotherOneAndCanBeTakenOff)
{
  const auto mesh = sphere();
  svo::attachOctree(mesh, built(mesh, 3));
  svo::attachOctree(mesh, built(mesh, 4));
  EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 1);
  svo::Octree octree;
  ASSERT_EQ(opened(mesh, octree), svo::Attached::Found);
  EXPECT_EQ(octree.level(), 4);
  svo::detachOctree(mesh);
  EXPECT_EQ(stateOf(mesh), svo::Attached::None);
}

TEST(MeshOctree, SurvivesAFileInEveryDataModeAndPrecision)
{
  const std::string path = testing::TempDir() + "vtkSVO-TestMeshOctree.vtp";
  for (int precision : { vtkAlgorithm::SINGLE_PRECISION, vtkAlgorithm::DOUBLE_PRECISION })
  {
    for (int mode : { vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended })
    {
      const auto mesh = withOctree(sphere(precision));
      svo::Octree before;
      ASSERT_EQ(opened(mesh, before), svo::Attached::Found);
      vtkNew<vtkXMLPolyDataWriter> writer;
      writer->SetInputData(mesh);
      writer->SetFileName(path.c_str());
      writer->SetDataMode(mode);
      ASSERT_EQ(writer->Write(), 1);
      vtkNew<vtkXMLPolyDataReader> reader;
      reader->SetFileName(path.c_str());
      reader->Update();
      svo::Octree after;
      ASSERT_EQ(opened(reader->GetOutput(), after), svo::Attached::Found)
        << "mode " << mode << ", precision " << precision;
      ASSERT_EQ(after.header().nodeCount, before.header().nodeCount);
      EXPECT_EQ(std::memcmp(&after.header(), &before.header(),
                  sizeof(svo::Header) + before.header().nodeCount * sizeof(svo::Node)),
        0);
      EXPECT_NE(after.surface(), nullptr);
    }
  }
  std::remove(path.c_str());
}

TEST(MeshOctree, IsForeignDownstreamOfAClipOrATransform)
{
  const auto mesh = withOctree(sphere());
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(mesh->GetCenter());
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(mesh);
  clip->SetClipFunction(plane);
  clip->Update();
  ASSERT_TRUE(clip->GetOutput()->GetFieldData()->HasArray(svo::OctreeArrayName));
  EXPECT_EQ(stateOf(clip->GetOutput()), svo::Attached::Foreign);

  vtkNew<vtkTransform> transform;
  transform->Translate(0.0, 0.0, 1e-3);
  vtkNew<vtkTransformFilter> move;
  move->SetInputData(mesh);
  move->SetTransform(transform);
  move->Update();
  EXPECT_EQ(stateOf(move->GetPolyDataOutput()), svo::Attached::Foreign);
  EXPECT_EQ(stateOf(mesh), svo::Attached::Found);
}

TEST(MeshOctree, IsForeignOnceThePointsWereEdited)
{
  const auto mesh = withOctree(copyOf(sphere()));
  ASSERT_EQ(stateOf(mesh), svo::Attached::Found);
  mesh->GetPoints()->SetPoint(3, 0.0, 0.0, 0.0);
  mesh->GetPoints()->Modified();
  EXPECT_EQ(stateOf(mesh), svo::Attached::Foreign);
}

TEST(MeshOctree, DamagedBytesAreRefusedWithAMessage)
{
  const auto mesh = withOctree(sphere());
  auto* original = vtkUnsignedCharArray::SafeDownCast(
    mesh->GetFieldData()->GetAbstractArray(svo::OctreeArrayName));
  ASSERT_NE(original, nullptr);
  const auto damaged = [&](auto&& damage)
  {
    const auto copy = copyOf(mesh);
    auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
    bytes->DeepCopy(original);
    damage(bytes.Get());
    copy->GetFieldData()->AddArray(bytes);
    return stateOf(copy);
  };
  EXPECT_EQ(damaged([](vtkUnsignedCharArray*) {}), svo::Attached::Found);
  EXPECT_EQ(damaged(
              [](vtkUnsignedCharArray* a)
              {
                a->Resize(a->GetNumberOfValues() - 4);
                a->SetNumberOfValues(a->GetNumberOfValues() - 4);
              }),
    svo::Attached::Damaged);
  EXPECT_EQ(
    damaged([](vtkUnsignedCharArray* a) { a->SetNumberOfValues(100); }), svo::Attached::Damaged);
  EXPECT_EQ(damaged([](vtkUnsignedCharArray* a) { a->SetValue(0, 'V'); }), svo::Attached::Damaged);
  EXPECT_EQ(damaged([](vtkUnsignedCharArray* a)
              { a->SetValue(sizeof(svo::Header) + 8, 250); }), // the root's first child
    svo::Attached::Damaged);
}

TEST(MeshOctree, AnArrayOfAnotherTypeIsNotAnOctree)
{
  const auto mesh = sphere();
  vtkNew<vtkFloatArray> array;
  array->SetName(svo::OctreeArrayName);
  array->SetNumberOfValues(1000);
  array->FillValue(0.0f);
  mesh->GetFieldData()->AddArray(array);
  EXPECT_EQ(stateOf(mesh), svo::Attached::Damaged);
}

TEST(MeshOctree, MisalignedBytesAreCopied)
{
  const auto mesh = withOctree(sphere());
  auto* original = vtkUnsignedCharArray::SafeDownCast(
    mesh->GetFieldData()->GetAbstractArray(svo::OctreeArrayName));
  const auto size = static_cast<std::size_t>(original->GetNumberOfValues());
  std::vector<std::uint64_t> storage(size / 8 + 2);
  auto* odd = reinterpret_cast<unsigned char*>(storage.data()) + 3;
  std::memcpy(odd, original->GetPointer(0), size);
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(svo::OctreeArrayName);
  array->SetArray(odd, static_cast<vtkIdType>(size), 1);
  mesh->GetFieldData()->AddArray(array);
  EXPECT_EQ(stateOf(mesh), svo::Attached::Found);
}

TEST(MeshOctree, PointsThatAreNotFiniteAreDroppedAndCounted)
{
  const auto mesh = copyOf(sphere());
  mesh->GetPoints()->SetPoint(50, std::nan(""), 0.0, 0.0);
  mesh->GetPoints()->SetPoint(200, 0.0, HUGE_VAL, 0.0);
  mesh->GetPoints()->Modified();
  svo::MeshOctreeOptions options;
  options.level = 5;
  svo::Octree octree;
  std::string message;
  ASSERT_EQ(svo::buildMeshOctree(mesh, options, octree, message), svo::BuildStatus::Built);
  EXPECT_NE(message.find("12 of the mesh's 672 triangles"), std::string::npos) << message;
  svo::attachOctree(mesh, octree);
  EXPECT_EQ(stateOf(mesh), svo::Attached::Found);
}
