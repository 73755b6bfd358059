#include "svoSplats.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

namespace svo
{
namespace
{
// From VTK 9.4 on splats may be stretched, and an actor's matrix scales them; the edge of what is
// drawn of a splat has another name, and is a square's instead of a triangle's.
template <class Mapper, class = void>
struct Newer : std::false_type
{
  static double edge(Mapper* mapper) { return mapper->GetTriangleScale(); }
  static bool stretched(Mapper*) { return false; }
};
template <class Mapper>
struct Newer<Mapper, std::void_t<decltype(std::declval<Mapper>().GetAnisotropic())>>
  : std::true_type
{
  static double edge(Mapper* mapper) { return mapper->GetBoundScale(); }
  static bool stretched(Mapper* mapper) { return mapper->GetAnisotropic(); }
};
using Version = Newer<vtkPointGaussianMapper>;

/// A function as the mapper's table has it.
class Table
{
public:
  Table(vtkPiecewiseFunction* function, int size)
    : Values(static_cast<std::size_t>(std::max(size, 1)))
  {
    function->GetRange(this->Range);
    function->GetTable(
      this->Range[0], this->Range[1], static_cast<int>(this->Values.size()), this->Values.data());
  }

  double at(double x) const
  {
    const double place = (x - this->Range[0]) / (this->Range[1] - this->Range[0]) *
      static_cast<double>(this->Values.size() - 1);
    if (!(place >= 0.0)) // NaN, too
    {
      return this->Values.front();
    }
    if (place >= static_cast<double>(this->Values.size() - 1))
    {
      return this->Values.back();
    }
    const auto low = static_cast<std::size_t>(place);
    const double part = place - static_cast<double>(low);
    return (1.0 - part) * this->Values[low] + part * this->Values[low + 1];
  }

private:
  double Range[2];
  std::vector<float> Values;
};

/// An array of the points as the mapper looks it up: of a component, or the magnitude of all.
class PointNumbers
{
public:
  PointNumbers(vtkPolyData* input, const char* name, int component, vtkPiecewiseFunction* function,
    int tableSize)
    : Array(name ? input->GetPointData()->GetArray(name) : nullptr)
  {
    if (this->Array)
    {
      this->Component = this->Array->GetNumberOfComponents() == 1 ? 0 : component;
      this->Magnitude =
        this->Component < 0 || this->Component >= this->Array->GetNumberOfComponents();
    }
    if (name && function)
    {
      this->Mapped = std::make_unique<Table>(function, tableSize);
    }
  }

  explicit operator bool() const { return this->Array != nullptr; }

  /// Of a point; `otherwise`, if there is no array.
  double at(vtkIdType point, double otherwise) const
  {
    double value = otherwise;
    if (this->Array && point < this->Array->GetNumberOfTuples())
    {
      value = this->Magnitude
        ? vtkMath::Norm(this->Array->GetTuple(point), this->Array->GetNumberOfComponents())
        : this->Array->GetComponent(point, this->Component);
    }
    return this->Mapped ? this->Mapped->at(value) : value;
  }

private:
  vtkDataArray* Array;
  int Component = 0;
  bool Magnitude = false;
  std::unique_ptr<Table> Mapped;
};

/// Without white space, and without comments to the ends of lines.
std::string condensed(const char* code)
{
  std::string text;
  for (const char* c = code; *c; ++c)
  {
    if (c[0] == '/' && c[1] == '/')
    {
      while (c[1] && c[1] != '\n')
      {
        ++c;
      }
    }
    else if (!std::isspace(static_cast<unsigned char>(*c)))
    {
      text += *c;
    }
  }
  return text;
}

bool contains(const std::string& text, const char* what)
{
  return text.find(what) != std::string::npos;
}

/// The points that the mapper draws.
std::vector<vtkIdType> drawnPoints(vtkPolyData* input)
{
  std::vector<vtkIdType> points;
  if (input->GetNumberOfVerts() == 0)
  {
    points.resize(static_cast<std::size_t>(input->GetNumberOfPoints()));
    std::iota(points.begin(), points.end(), vtkIdType(0));
    return points;
  }
  auto cells = vtkSmartPointer<vtkCellArrayIterator>::Take(input->GetVerts()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* ids;
    cells->GetCurrentCell(count, ids);
    points.insert(points.end(), ids, ids + count);
  }
  return points;
}
}

bool isSplatMapper(vtkMapper* mapper)
{
  return std::strcmp(mapper->GetClassName(), "vtkOpenGLPointGaussianMapper") == 0;
}

std::uint64_t timeOfSplats(vtkMapper* mapper)
{
  if (!isSplatMapper(mapper))
  {
    return 0;
  }
  auto* splats = static_cast<vtkPointGaussianMapper*>(mapper);
  const auto timeOf = [](vtkObject* object) { return object ? object->GetMTime() : 0; };
  return std::max(timeOf(splats->GetScaleFunction()), timeOf(splats->GetScalarOpacityFunction()));
}

double discOf(const char* splatShader)
{
  const std::string code = condensed(splatShader ? splatShader : "");
  // "float d = dot(offset.xy, offset.xy); if (d > 1.0) { discard; }", or the root of it.
  const std::string square = "dot(offsetVCVSOutput.xy,offsetVCVSOutput.xy)";
  std::size_t from = std::string::npos;
  bool squared = false;
  std::string name;
  for (const std::string& distance : { square, "sqrt(" + square + ")",
         std::string("length(offsetVCVSOutput.xy)"), std::string("length(offsetVCVSOutput)") })
  {
    const std::size_t at = code.find('=' + distance + ';');
    const std::size_t type = at == std::string::npos ? at : code.rfind("float", at);
    if (type != std::string::npos)
    {
      name = code.substr(type + 5, at - type - 5);
      from = at;
      squared = distance == square;
    }
  }
  const std::string test = "if(" + name + '>';
  const std::size_t asked = name.empty() ? std::string::npos : code.find(test, from);
  if (asked == std::string::npos)
  {
    return 0.0;
  }
  const char* number = code.c_str() + asked + test.size();
  char* end = nullptr;
  const double limit = std::strtod(number, &end);
  const std::string rest = end;
  const bool discards = rest.rfind("){discard;}", 0) == 0 || rest.rfind("f){discard;}", 0) == 0 ||
    rest.rfind(")discard;", 0) == 0;
  // What discards once more has holes; who writes an opacity may have soft edges.
  if (!discards || !(limit > 0.0) || code.find("discard") != code.rfind("discard") ||
    contains(code, "opacity") || contains(code, "gl_Frag"))
  {
    return 0.0;
  }
  return squared ? std::sqrt(limit) : limit;
}

bool actorsScaleSplats()
{
  return Version::value;
}

const char* beyondSplats(vtkPointGaussianMapper* mapper)
{
  const char* code = mapper->GetSplatShaderCode();
  if (mapper->GetEmissive())
  {
    return "shines by itself";
  }
  if (mapper->GetScaleFactor() == 0.0)
  {
    return "shows its points as single pixels";
  }
  if (!code || !*code)
  {
    return "has splats that fade out";
  }
  if (Version::stretched(mapper))
  {
    return "has splats that are stretched";
  }
  return discOf(code) > 0.0 ? nullptr : "has a splat shader that draws no plain discs";
}

Splats splatsOf(vtkPointGaussianMapper* mapper, vtkPolyData* input, bool all)
{
  Splats result;
  result.shapes = std::make_shared<RoundShapes>();
  RoundShapes& shapes = *result.shapes;
  shapes.shape = RoundShapes::Shape::Ball;
  shapes.width = actorsScaleSplats() ? RoundShapes::Width::Local : RoundShapes::Width::World;
  // Beyond the edge nothing is drawn.
  const double disc = std::min(discOf(mapper->GetSplatShaderCode()), Version::edge(mapper));
  const double factor = mapper->GetScaleFactor() * disc;
  const PointNumbers sizes(input, mapper->GetScaleArray(), mapper->GetScaleArrayComponent(),
    mapper->GetScaleFunction(), mapper->GetScaleTableSize());
  const PointNumbers opacities(input, mapper->GetOpacityArray(), mapper->GetOpacityArrayComponent(),
    mapper->GetScalarOpacityFunction(), mapper->GetOpacityTableSize());
  vtkNew<vtkPolyDataMapper> own; // the mapper's colours are those of its last input
  own->vtkMapper::ShallowCopy(mapper);
  vtkUnsignedCharArray* colors = own->MapScalars(input, 1.0);
  const auto isOpaque = [&](vtkIdType point)
  {
    if (!colors)
    {
      return true; // VTK looks at opacities only where there are colours
    }
    return opacities ? opacities.at(point, 1.0) * 255.0 >= 255.0
                     : colors->GetNumberOfComponents() != 4 ||
        point >= colors->GetNumberOfTuples() || colors->GetComponent(point, 3) == 255.0;
  };
  for (const vtkIdType point : drawnPoints(input))
  {
    glm::dvec3 centre;
    input->GetPoint(point, &centre.x);
    const double radius = std::abs(sizes.at(point, 1.0) * factor);
    if (!std::isfinite(centre.x + centre.y + centre.z) || !std::isfinite(radius) || radius == 0.0)
    {
      continue;
    }
    if (!all && !isOpaque(point))
    {
      result.translucent = true;
      continue;
    }
    shapes.ends.push_back(centre);
    shapes.radii.push_back(radius);
  }
  return result;
}
}
