#include "svoSkyTexture.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <cmath>
#include <vector>

namespace svo
{
namespace
{
vtkImageData* imageOf(vtkTexture* texture, std::string& why)
{
  if (!texture)
  {
    why = "The renderer has no environment texture (SetEnvironmentTexture)";
    return nullptr;
  }
  if (texture->GetInputAlgorithm())
  {
    texture->GetInputAlgorithm()->Update();
  }
  vtkImageData* const image = texture->GetCubeMap() ? nullptr : texture->GetInput();
  const vtkDataArray* const colors = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!colors || image->GetNumberOfPoints() < 1 || image->GetDimensions()[2] != 1)
  {
    why = "The renderer's environment texture is no equirectangular image";
    return nullptr;
  }
  return image;
}

/// Red, green and blue, linear.
std::vector<float> colorsOf(vtkImageData* image, bool curved)
{
  vtkDataArray* const colors = image->GetPointData()->GetScalars();
  const int type = colors->GetDataType();
  const double whole = type == VTK_UNSIGNED_CHAR ? 255.0
    : type == VTK_UNSIGNED_SHORT                 ? 65535.0
                                                 : 1.0;
  const int components = colors->GetNumberOfComponents();
  std::vector<float> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(colors->GetNumberOfTuples()));
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = colors->GetComponent(i, components < 3 ? 0 : c) / whole;
      rgb.push_back(static_cast<float>(curved ? std::pow(std::max(value, 0.0), 2.2) : value));
    }
  }
  return rgb;
}
}

std::shared_ptr<const SkyPicture> SkyTexture::of(vtkRenderer* renderer, std::string& why)
{
  vtkTexture* const texture = renderer->GetEnvironmentTexture();
  vtkImageData* const image = imageOf(texture, why);
  if (!image)
  {
    this->Picture = nullptr;
    return nullptr;
  }
  const bool curved = texture->GetUseSRGBColorSpace();
  const double *right = renderer->GetEnvironmentRight(), *up = renderer->GetEnvironmentUp();
  const decltype(this->Source) source(image, image->GetMTime(), curved,
    std::array<double, 6>{ right[0], right[1], right[2], up[0], up[1], up[2] });
  if (!this->Picture || this->Source != source)
  {
    this->Source = source;
    double front[3]; // as VTK's shaders have it
    vtkMath::Cross(right, up, front);
    const glm::mat3 world(glm::vec3(right[0], right[1], right[2]), glm::vec3(up[0], up[1], up[2]),
      glm::vec3(front[0], front[1], front[2]));
    const int* size = image->GetDimensions();
    this->Picture =
      std::make_shared<SkyPicture>(size[0], size[1], colorsOf(image, curved).data(), world);
  }
  return this->Picture;
}
}
