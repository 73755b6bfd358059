#include "svoVDBColors.h"

#include "svoLeafValues.h"

#include "vtkDataArray.h"

#include <type_traits>

#include <glm/common.hpp>
#include <openvdb/openvdb.h>

namespace svo
{
namespace
{
template <class T>
double componentOf(T value, int)
{
  return static_cast<double>(value);
}

template <class T>
double componentOf(const openvdb::math::Vec3<T>& value, int c)
{
  return static_cast<double>(value[c]);
}
}

vtkSmartPointer<vtkDataArray> valuesAtLeaves(const openvdb::GridBase& grid,
  const SourceOctree& built, const ParallelFor& parallelFor,
  const std::function<bool(double)>& progress)
{
  using Known = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid,
    openvdb::Int64Grid, openvdb::Vec3SGrid, openvdb::Vec3DGrid, openvdb::Vec3IGrid>;
  vtkSmartPointer<vtkDataArray> values;
  const auto sample = [&](const auto& typed)
  {
    using GridT = std::decay_t<decltype(typed)>;
    using ValueT = typename GridT::ValueType;
    values = vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(std::is_same_v<ValueT, double> ? VTK_DOUBLE : VTK_FLOAT));
    const int components = std::is_arithmetic_v<ValueT> ? 1 : 3;
    values->SetNumberOfComponents(components);
    values->SetNumberOfTuples(static_cast<vtkIdType>(built.octree.header().voxelCount));
    const glm::dmat4 toLocal = built.octree.transform();
    const bool done = forEachLeaf(built.octree, parallelFor, progress,
      [&](std::size_t leaf, const glm::dvec3& own)
      {
        const glm::dvec3 local(toLocal * glm::dvec4(own, 1.0));
        const openvdb::Vec3d index = typed.worldToIndex({ local.x, local.y, local.z });
        constexpr double Farthest = 1 << 30; // far beyond it a grid has its background
        const glm::dvec3 at =
          glm::clamp(glm::dvec3(index.x(), index.y(), index.z()), -Farthest, Farthest);
        const glm::dvec3 low = glm::floor(at);
        const typename GridT::ConstUnsafeAccessor accessor(typed.tree()); // nobody changes the tree
        for (int c = 0; c < components; ++c)
        {
          double sum = 0.0;
          for (int i = 0; i < 8; ++i)
          {
            const glm::dvec3 upper(i & 1, i >> 1 & 1, i >> 2);
            const glm::dvec3 weight = glm::abs(at - low - 1.0 + upper), corner = low + upper;
            const auto value = accessor.getValue(openvdb::Coord(
              static_cast<int>(corner.x), static_cast<int>(corner.y), static_cast<int>(corner.z)));
            sum += weight.x * weight.y * weight.z * componentOf(value, c);
          }
          values->SetComponent(static_cast<vtkIdType>(leaf), c, sum);
        }
      });
    values = done ? values : nullptr;
  };
  grid.apply<Known>(sample);
  return values;
}
}
