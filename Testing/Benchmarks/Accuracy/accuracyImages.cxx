#include "accuracyImages.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace accuracy
{
namespace
{
void write(const std::vector<glm::vec3>& pixels, int width, const std::string& path)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, static_cast<int>(pixels.size()) / width, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* out = static_cast<unsigned char*>(image->GetScalarPointer());
  for (const glm::vec3& p : pixels)
  {
    for (int c = 0; c < 3; ++c)
    {
      *out++ = static_cast<unsigned char>(std::clamp(255.0f * p[c] + 0.5f, 0.0f, 255.0f));
    }
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->Write();
}
}

void writeShadowDifference(const std::vector<Light>& shown, const std::vector<Light>& truth,
  const std::vector<TruePixel>& exact, int width, const std::string& path)
{
  std::vector<glm::vec3> pixels;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const float grey =
      !exact[i].hit ? 0.97f : 0.35f + 0.5f * (exact[i].dark ? 0.0f : std::max(exact[i].lit, 0.0f));
    const bool judged = truth[i] != Light::Unlit && shown[i] != Light::Unlit;
    pixels.push_back(!judged || truth[i] == shown[i] ? glm::vec3(grey)
        : shown[i] == Light::Dark                    ? glm::vec3(0.85f, 0.1f, 0.05f)
                                                     : glm::vec3(0.05f, 0.3f, 0.95f));
  }
  write(pixels, width, path);
}

void writeDepthDifference(const Picture& picture, const std::vector<TruePixel>& truth,
  const svo::View& view, double voxel, const std::string& path)
{
  std::vector<glm::vec3> pixels;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    if (picture.hit(i) != bool(truth[i].hit))
    {
      pixels.emplace_back(0.0f);
      continue;
    }
    if (!truth[i].hit)
    {
      pixels.emplace_back(0.88f);
      continue;
    }
    const double x = static_cast<double>(i % view.width) + 0.5;
    const double y = static_cast<double>(i / view.width) + 0.5;
    const double error = (linearDepth(view, picture.depth[i]) - truth[i].hit.t) *
      glm::length(view.rayDirection(x, y)) / voxel;
    const float share = static_cast<float>(std::clamp(0.5 * error, -1.0, 1.0));
    const glm::vec3 full =
      share < 0.0f ? glm::vec3(0.8f, 0.05f, 0.05f) : glm::vec3(0.05f, 0.2f, 0.9f);
    pixels.push_back(glm::mix(glm::vec3(1.0f), full, std::abs(share)));
  }
  write(pixels, view.width, path);
}
}
