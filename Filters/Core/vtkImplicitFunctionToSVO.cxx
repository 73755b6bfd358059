#include "vtkImplicitFunctionToSVO.h"

#include "svoAbort.h"
#include "svoFieldSource.h"
#include "svoSMPParallel.h"
#include "svoSourceOctree.h"

#include "vtkAbstractTransform.h"
#include "vtkImplicitFunction.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

vtkStandardNewMacro(vtkImplicitFunctionToSVO);
vtkCxxSetObjectMacro(vtkImplicitFunctionToSVO, ImplicitFunction, vtkImplicitFunction);

namespace
{
class FunctionField : public svo::ScalarField
{
public:
  explicit FunctionField(vtkImplicitFunction* function)
    : Function(function)
  {
    if (vtkAbstractTransform* transform = function->GetTransform())
    {
      transform->Update(); // before several threads find that it has to be
    }
  }
  double value(const glm::dvec3& at) const override { return this->Function->FunctionValue(&at.x); }
  glm::dvec3 gradient(const glm::dvec3& at) const override
  {
    glm::dvec3 g;
    this->Function->FunctionGradient(&at.x, &g.x);
    return g;
  }

private:
  vtkImplicitFunction* Function;
};
}

//------------------------------------------------------------------------------
vtkImplicitFunctionToSVO::vtkImplicitFunctionToSVO()
{
  this->SetNumberOfInputPorts(0);
}

vtkImplicitFunctionToSVO::~vtkImplicitFunctionToSVO()
{
  this->SetImplicitFunction(nullptr);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkImplicitFunctionToSVO::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->ImplicitFunction ? std::max(time, this->ImplicitFunction->GetMTime()) : time;
}

//------------------------------------------------------------------------------
int vtkImplicitFunctionToSVO::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = this->Begin(outputVector);
  if (!this->ImplicitFunction)
  {
    vtkErrorMacro("The octree is not built: there is no implicit function.");
    return 1;
  }
  constexpr std::size_t Kibi = 1024;
  const double* b = this->ModelBounds;
  const svo::BuildOptions options{ this->MaximumLevel, svo::LeafGeometry::Plane,
    { b[0], b[2], b[4] }, { b[1], b[3], b[5] }, glm::dmat4(1.0), this->MemoryLimit * Kibi,
    this->Parallel ? svo::smpParallelFor() : svo::serialFor,
    [this](double progress) { return svo::goesOn(this, progress); } };
  const double extent = std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] });
  // The octree's cube is a trifle larger than the box.
  const double coarsest = std::ldexp(extent, -this->MinimumLevel - 1) * 1.1;
  const FunctionField field(this->ImplicitFunction);
  const svo::FieldSource source(field, { this->Value, this->GradientBound, coarsest });
  const double start = vtkTimerLog::GetUniversalTime();
  const svo::SourceOctree built = svo::buildSourceOctree(
    source, options, { static_cast<std::size_t>(this->MaximumNumberOfQuads) }, output);
  this->NoteBuilt(built, start, output);
  if (!built.message.empty())
  {
    vtkErrorMacro("The octree is not built: " << built.message << ".");
  }
  else if (built.status == svo::BuildStatus::Built && built.voxels == 0)
  {
    vtkWarningMacro("No surface was found: the function does not take the value "
      << this->Value << " in the box of ModelBounds.");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkImplicitFunctionToSVO::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ImplicitFunction: " << this->ImplicitFunction << "\n";
  os << indent << "Value: " << this->Value << "\n";
  os << indent << "ModelBounds: (" << this->ModelBounds[0] << ", " << this->ModelBounds[1] << ", "
     << this->ModelBounds[2] << ", " << this->ModelBounds[3] << ", " << this->ModelBounds[4] << ", "
     << this->ModelBounds[5] << ")\n";
  os << indent << "MaximumLevel: " << this->MaximumLevel << "\n";
  os << indent << "GradientBound: " << this->GradientBound << "\n";
  os << indent << "MinimumLevel: " << this->MinimumLevel << "\n";
  os << indent << "Parallel: " << (this->Parallel ? "On\n" : "Off\n");
}
