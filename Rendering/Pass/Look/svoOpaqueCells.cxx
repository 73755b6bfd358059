#include "svoOpaqueCells.h"

#include "svoCellAlpha.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace svo
{
namespace
{
/// True if all of these RGBA colours are opaque.
bool allOpaque(const unsigned char* colors, std::size_t count)
{
  unsigned char all = 255;
  for (std::size_t i = 0; i < count; ++i)
  {
    all &= colors[4 * i + 3];
  }
  return all == 255;
}

struct Counts
{
  vtkIdType opaque = 0, invisible = 0, all = 0;
  double alpha = 0.0; // the sum of visible ones' means
};

/// The cells whose ids begin at `base`, without those that are not opaque; or, with `places`, with
/// cells without an area in the place of those that are invisible.
vtkSmartPointer<vtkCellArray> sortCells(vtkCellArray* cells, vtkIdType base, vtkIdType points,
  const CellAlpha& alpha, bool places, Counts& counts)
{
  auto found = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    cells->GetCellAtId(i, ids);
    const vtkIdType* id = ids->GetPointer(0);
    const vtkIdType size = ids->GetNumberOfIds();
    bool kept =
      size >= 3 && std::all_of(id, id + size, [&](vtkIdType p) { return p >= 0 && p < points; });
    if (kept)
    {
      const CellAlpha::Range range = alpha.of(base + i, id, size);
      ++counts.all;
      counts.invisible += range.invisible;
      counts.opaque += range.opaque;
      counts.alpha += range.invisible ? 0.0 : range.mean;
      kept = places ? !range.invisible : range.opaque;
    }
    if (kept)
    {
      found->InsertNextCell(ids);
    }
    else if (places)
    {
      found->InsertNextCell({ 0, 0, 0 });
    }
  }
  return found;
}

/// Leaves are no cells of the mesh: either all of it is opaque, or nothing.
OpaqueAnswer sortLeaves(
  vtkPolyData* mesh, const Attributes& attributes, vtkUnsignedCharArray* colors)
{
  const auto count = static_cast<std::size_t>(colors->GetNumberOfTuples());
  const bool opaque = allOpaque(attributes.colors, count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += attributes.colors[4 * i + 3] / 255.0;
  }
  return { opaque ? mesh : nullptr, !opaque, opaque ? nullptr : mesh, !opaque,
    opaque ? 1.0 : sum / static_cast<double>(count) };
}

/// `visible`: what is visible is asked for.
OpaqueAnswer sort(vtkPolyData* mesh, const Attributes& attributes, bool visible)
{
  const std::size_t count = attributes.colorCoordinates ? 2 * attributes.colorTextureSize
    : attributes.colorAssociation == Association::Cell  ? mesh->GetNumberOfCells()
                                                        : mesh->GetNumberOfPoints();
  if (allOpaque(attributes.colorCoordinates ? attributes.colorTexture : attributes.colors, count))
  {
    return { mesh, false };
  }
  const CellAlpha alpha(attributes);
  const auto sorted = [&](bool places, Counts& counts)
  {
    auto cells = vtkSmartPointer<vtkPolyData>::New();
    const vtkIdType polys = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
    const vtkIdType strips = polys + mesh->GetNumberOfPolys();
    const vtkIdType points = mesh->GetNumberOfPoints();
    cells->SetPoints(mesh->GetPoints());
    cells->SetPolys(sortCells(mesh->GetPolys(), polys, points, alpha, places, counts));
    cells->SetStrips(sortCells(mesh->GetStrips(), strips, points, alpha, places, counts));
    return cells;
  };
  Counts counts;
  const auto opaque = sorted(false, counts);
  OpaqueAnswer answer;
  answer.mapped = answer.translucent = counts.opaque + counts.invisible < counts.all;
  if (counts.opaque == counts.all)
  {
    answer.mesh = mesh;
  }
  else if (counts.opaque > 0)
  {
    answer.mesh = opaque;
  }
  answer.alpha =
    answer.mapped ? counts.alpha / static_cast<double>(counts.all - counts.invisible) : 1.0;
  if (answer.translucent && visible)
  {
    answer.visible = mesh;
    if (counts.invisible > 0)
    {
      Counts again;
      answer.visible = sorted(true, again);
      answer.visible->SetVerts(mesh->GetVerts());
      answer.visible->SetLines(mesh->GetLines());
    }
  }
  return answer;
}
}

OpaqueAnswer opaqueCellsOf(const SurfacePart& part, const Attributes& attributes, bool visible,
  OpaqueCells& cells, KeepAlive& kept)
{
  vtkPolyData* mesh = part.mesh;
  vtkMapper* colors = part.colors;
  const bool whole = part.opacity >= 1.0;
  if (!whole && (part.opacity <= 0.0 || !visible))
  {
    return { nullptr, part.opacity > 0.0 };
  }
  if (!attributes.colors && !attributes.colorCoordinates)
  {
    return { whole ? mesh : nullptr, !whole, whole ? nullptr : mesh };
  }
  const std::array times{ mesh->GetMTime(), timeOf(colors->GetColorMapColors()),
    timeOf(colors->GetColorCoordinates()), timeOf(colors->GetColorTextureMap()) };
  const auto make = [&](OpaqueAnswer& answer)
  {
    answer = attributes.colorAssociation == Association::Leaf
      ? sortLeaves(mesh, attributes, colors->GetColorMapColors())
      : sort(mesh, attributes, visible);
  };
  const OpaqueAnswer& answer = cells.of({ mesh, colors }, { times, visible }, kept, make);
  if (whole)
  {
    return answer;
  }
  // Nothing of it is opaque.
  vtkPolyData* rest = answer.translucent ? answer.visible : answer.mesh;
  return { nullptr, rest != nullptr, rest, answer.mapped, answer.alpha };
}
}
