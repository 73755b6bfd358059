// Octrees as hyper tree grids: the same cells at every level, and what cannot be converted.
#include "vtkSVOToHyperTreeGrid.h"

#include "svoConversion.h"
#include "svoOctreeCells.h"
#include "svoSourceOctree.h"
#include "svoTestFields.h"
#include "vtkImplicitFunctionToSVO.h"

#include "vtkBitArray.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridNonOrientedGeometryCursor.h"
#include "vtkIdTypeArray.h"
#include "vtkSphere.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

namespace
{
using Cells = std::map<int, std::set<std::array<int, 3>>>; // occupied ones, by level

Cells cellsOf(const svo::Octree& octree, int deepest)
{
  Cells cells;
  for (int level = 0; level <= deepest; ++level)
  {
    svo::forEachCell(octree, level,
      [&](const svo::OctreeCell& c)
      {
        cells[level].insert({ c.cell.x, c.cell.y, c.cell.z });
        return true;
      });
  }
  return cells;
}

void collect(vtkHyperTreeGridNonOrientedGeometryCursor* cursor, vtkHyperTreeGrid* grid,
  const svo::Header& header, int depth, Cells& cells)
{
  const vtkIdType index = cursor->GetGlobalNodeIndex();
  const auto* levels = vtkUnsignedCharArray::SafeDownCast(grid->GetCellData()->GetArray("Level"));
  EXPECT_EQ(levels->GetValue(index), cursor->GetLevel());
  if (grid->HasMask() && grid->GetMask()->GetValue(index))
  {
    EXPECT_TRUE(cursor->IsLeaf());
    return;
  }
  const double edge = std::ldexp(header.voxelSize, depth - static_cast<int>(cursor->GetLevel()));
  std::array<int, 3> cell;
  for (int i = 0; i < 3; ++i)
  {
    cell[i] = static_cast<int>(std::lround((cursor->GetOrigin()[i] - header.origin[i]) / edge));
    EXPECT_NEAR(cursor->GetSize()[i], edge, 1e-9 * edge);
  }
  EXPECT_TRUE(cells[cursor->GetLevel()].insert(cell).second);
  for (unsigned char i = 0; !cursor->IsLeaf() && i < 8; ++i)
  {
    cursor->ToChild(i);
    collect(cursor, grid, header, depth, cells);
    cursor->ToParent();
  }
}

Cells cellsOf(vtkHyperTreeGrid* grid, const svo::Octree& octree)
{
  Cells cells;
  vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
  cursor->Initialize(grid, 0);
  collect(cursor, grid, octree.header(), octree.level(), cells);
  return cells;
}

struct GridOf
{
  vtkNew<vtkSVOToHyperTreeGrid> filter;
  svo::TestMessages messages{ filter };

  explicit GridOf(vtkPolyData* mesh, int level = -1)
  {
    this->filter->SetInputData(mesh);
    this->filter->SetLevel(level);
  }
  vtkHyperTreeGrid* output()
  {
    this->filter->Update();
    return this->filter->GetHyperTreeGridOutput();
  }
};
}

TEST(SVOToHyperTreeGrid, HasTheCellsOfEveryLevel)
{
  for (const int level : { 1, 2, 3, 4, 7 })
  {
    const Conversion mesh(sphere(), level);
    const svo::Octree octree = mesh.octree();
    for (const int deepest : { -1, 0, 1, level - 1, 20 })
    {
      GridOf grid(mesh.filter->GetOutput(), deepest);
      vtkHyperTreeGrid* output = grid.output();
      EXPECT_TRUE(grid.messages.all().empty()) << grid.messages.all();
      EXPECT_EQ(
        cellsOf(output, octree), cellsOf(octree, deepest < 0 ? level : std::min(deepest, level)))
        << level << " " << deepest;
    }
  }
}

TEST(SVOToHyperTreeGrid, NamesCellsOfMeshes)
{
  const Conversion mesh(sphere(), 5);
  GridOf grid(mesh.filter->GetOutput());
  const auto* ids = vtkIdTypeArray::SafeDownCast(grid.output()->GetCellData()->GetArray("CellId"));
  ASSERT_NE(ids, nullptr);
  std::set<vtkIdType> seen;
  for (vtkIdType i = 0; i < ids->GetNumberOfValues(); ++i)
  {
    const bool masked = grid.output()->GetMask()->GetValue(i);
    EXPECT_EQ(ids->GetValue(i) < 0, masked) << ids->GetValue(i);
    seen.insert(ids->GetValue(i));
  }
  EXPECT_GT(seen.size(), 200u);
  EXPECT_LT(*seen.rbegin(), mesh.filter->GetOutput()->GetNumberOfCells());
}

TEST(SVOToHyperTreeGrid, TakesOctreesOfPlanes)
{
  vtkNew<vtkSphere> function;
  vtkNew<vtkImplicitFunctionToSVO> source;
  source->SetImplicitFunction(function);
  source->SetMaximumLevel(6);
  source->Update();
  GridOf grid(source->GetOutput());
  const svo::Octree octree = octreeOf(source->GetOutput());
  EXPECT_EQ(cellsOf(grid.output(), octree), cellsOf(octree, 6));
  EXPECT_EQ(grid.output()->GetCellData()->GetArray("CellId"), nullptr);
}

// Of stretched voxels the boxes, and of turned ones a message.
TEST(SVOToHyperTreeGrid, StretchesWithTheFrame)
{
  svo::BuildOptions options = svotest::boxOfInterest(5);
  options.transform[0][0] = 3.0;
  options.transform[3] = glm::dvec4(10.0, 0.0, -2.0, 1.0);
  const svotest::SphereField sphere(0.8);
  const svo::FieldSource source(sphere, { 0.0, 0.0, 0.05 });
  vtkNew<vtkPolyData> hull;
  ASSERT_EQ(svo::buildSourceOctree(source, options, {}, hull).status, svo::BuildStatus::Built);
  GridOf grid(hull);
  // Since VTK 9.4 GetBounds() is of what is not masked.
  vtkHyperTreeGrid* output = grid.output();
  vtkDataArray* const along[3] = { output->GetXCoordinates(), output->GetYCoordinates(),
    output->GetZCoordinates() };
  const svo::Octree octree = octreeOf(hull);
  const svo::Header& h = octree.header();
  const double low = h.origin[0], high = low + std::ldexp(h.voxelSize, 5);
  const double expected[6] = { 10.0 + 3.0 * low, 10.0 + 3.0 * high, low, high, low - 2.0,
    high - 2.0 };
  for (int i = 0; i < 6; ++i)
  {
    vtkDataArray* coordinates = along[i / 2];
    const vtkIdType end = i % 2 == 0 ? 0 : coordinates->GetNumberOfTuples() - 1;
    EXPECT_NEAR(coordinates->GetComponent(end, 0), expected[i], 1e-12);
  }
  EXPECT_TRUE(grid.messages.all().empty()) << grid.messages.all();

  options.transform[1][0] = 0.1;
  ASSERT_EQ(svo::buildSourceOctree(source, options, {}, hull).status, svo::BuildStatus::Built);
  GridOf sheared(hull);
  EXPECT_EQ(sheared.output()->GetNumberOfNonEmptyTrees(), 0);
  ASSERT_EQ(sheared.messages.errors.size(), 1u);
  EXPECT_NE(sheared.messages.all().find("sheared"), std::string::npos);
}

TEST(SVOToHyperTreeGrid, SaysWhatItCannotConvert)
{
  GridOf grid(sphere());
  EXPECT_EQ(grid.output()->GetNumberOfNonEmptyTrees(), 0);
  EXPECT_EQ(grid.messages.errors.size(), 1u) << grid.messages.all();
}

TEST(SVOToHyperTreeGrid, CanBeAborted)
{
  const Conversion mesh(sphere(), 9);
  GridOf grid(mesh.filter->GetOutput());
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* filter, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(filter)->SetAbortExecute(true); });
  grid.filter->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_EQ(grid.output()->GetNumberOfNonEmptyTrees(), 0);
  EXPECT_TRUE(grid.messages.all().empty()) << grid.messages.all();
}
