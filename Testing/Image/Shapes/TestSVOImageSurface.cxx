// Isosurfaces of images beside those of flying edges, drawn by VTK's rasteriser: depth within a
// voxel, outlines within a pixel, the same shading and shadows whichever side has the larger
// values.
//
// The two are not the same surface: the octree has that of the trilinear field, flying edges puts
// triangles between that field's crossings of the edges of a cell. Where the two differ by more, a
// ray is marched through the trilinear field, which says whose fault it is.
#include "svoImageCases.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkImageToSVO.h"
#include "vtkMath.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace
{
using namespace svotest;

constexpr int Size = 500;

vtkSmartPointer<vtkAlgorithm> octreeOf(vtkImageData* image, double value, int level)
{
  auto filter = vtkSmartPointer<vtkImageToSVO>::New();
  filter->SetInputData(image);
  filter->SetValue(value);
  filter->SetMaximumLevel(level);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> trianglesOf(vtkImageData* image, double value)
{
  auto filter = vtkSmartPointer<vtkFlyingEdges3D>::New();
  filter->SetInputData(image);
  filter->SetValue(0, value);
  filter->ComputeScalarsOff();
  return filter;
}

struct Scene : Stage
{
  vtkActor* actor;
  Scene(vtkAlgorithm* source, bool ground)
    : Stage(Size, Size)
  {
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetPosition(2.0, -4.5, 2.5);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetClippingRange(2.0, 12.0);
    this->pass->SetPixelError(0.0);
    this->actor = this->add(source, 0.9, 0.6, 0.4);
    if (ground)
    {
      this->addGround(2.0)->SetPosition(0.0, 0.0, -1.3);
    }
    this->addSun(2.0, -1.5, 4.0);
  }
};

/// Distances from the eye plane; infinite where nothing was drawn.
std::vector<double> eyeDepths(const Picture& picture, vtkCamera* camera)
{
  const double* r = camera->GetClippingRange();
  std::vector<double> depths(picture.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    if (picture.depth[i] < 1.0f)
    {
      depths[i] = r[0] * r[1] / (r[1] - double(picture.depth[i]) * (r[1] - r[0]));
    }
  }
  return depths;
}

/// Whether the other picture has such a depth in the pixel or, if `beside`, between it and those
/// next to it.
bool fits(double depth, const std::vector<double>& other, int x, int y, bool beside, double voxel)
{
  const int reach = beside ? 1 : 0;
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (int j = std::max(y - reach, 0); j <= std::min(y + reach, Size - 1); ++j)
  {
    for (int i = std::max(x - reach, 0); i <= std::min(x + reach, Size - 1); ++i)
    {
      low = std::min(low, other[j * Size + i]);
      high = std::max(high, other[j * Size + i]);
    }
  }
  return std::isinf(depth) ? std::isinf(high) : low - voxel <= depth && depth <= high + voxel;
}

/// The ray through a pixel's middle, by distance from the eye plane.
struct PixelRay
{
  double eye[3], direction[3];
  PixelRay(vtkCamera* camera, int x, int y)
  {
    const double slope = std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
    const double u = slope * (2.0 * (x + 0.5) / Size - 1.0);
    const double v = slope * (2.0 * (y + 0.5) / Size - 1.0);
    double ahead[3], right[3], above[3];
    camera->GetPosition(this->eye);
    camera->GetDirectionOfProjection(ahead);
    vtkMath::Cross(ahead, camera->GetViewUp(), right);
    vtkMath::Normalize(right);
    vtkMath::Cross(right, ahead, above);
    for (int i = 0; i < 3; ++i)
    {
      this->direction[i] = ahead[i] + u * right[i] + v * above[i];
    }
  }
  double value(vtkImageData* image, double depth) const
  {
    double at[3];
    for (int i = 0; i < 3; ++i)
    {
      at[i] = this->eye[i] + depth * this->direction[i];
    }
    return trilinear(image, at);
  }
  /// Depth of the trilinear field's own surface.
  double marched(const ImageCase& c, double step) const
  {
    double before = std::numeric_limits<double>::quiet_NaN();
    for (double t = 2.0; t < 9.0; t += step)
    {
      const double here = this->value(c.image, t) - c.value;
      if (std::isfinite(before) && std::isfinite(here) && (before < 0.0) != (here < 0.0))
      {
        return t;
      }
      before = here;
    }
    return std::numeric_limits<double>::infinity();
  }
};

/// Pixels whose depth, or outline, is none of the other's.
struct Violations
{
  std::size_t drawn = 0;
  std::size_t exactly = 0;         // in the pixel itself: slopes and outlines are among them
  std::size_t withinPixel = 0;     // between the pixel and its neighbours
  std::size_t outline = 0;         // of those: one of the two has nothing in and around the pixel
  std::size_t beyond = 0;          // of those: the octree's is outside of the image
  std::size_t ours = 0, edges = 0; // of the rest: who is not where the trilinear surface is
  std::size_t neither = 0;         // of the rest: both are, where a ray grazes
};

Violations violations(
  const ImageCase& c, vtkCamera* camera, const Picture& raster, const Picture& traced, double voxel)
{
  Violations found;
  const std::vector<double> a = eyeDepths(raster, camera), b = eyeDepths(traced, camera);
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const double ra = a[y * Size + x], rb = b[y * Size + x];
      found.drawn += std::isfinite(ra) || std::isfinite(rb);
      found.exactly += !fits(ra, b, x, y, false, voxel);
      if (fits(ra, b, x, y, true, voxel) && fits(rb, a, x, y, true, voxel))
      {
        continue;
      }
      ++found.withinPixel;
      found.outline += std::isinf(ra) != std::isinf(rb);
      const PixelRay ray(camera, x, y);
      if (std::isfinite(rb) && std::isnan(ray.value(c.image, rb)))
      {
        ++found.beyond;
        continue;
      }
      const double truth = ray.marched(c, 0.02 * voxel);
      const std::vector<double> exact(std::size_t(Size) * Size, truth);
      const bool oursFit = fits(rb, exact, x, y, false, voxel);
      const bool edgesFit = fits(ra, exact, x, y, false, voxel);
      found.ours += !oursFit;
      found.edges += !edgesFit;
      found.neither += oursFit && edgesFit;
    }
  }
  return found;
}

void compareDepth(const ImageCase& c, Checks& checks)
{
  const auto triangles = trianglesOf(c.image, c.value);
  Scene mesh(triangles, false);
  mesh.usePass(false);
  const Picture raster = capture(mesh.window);
  std::size_t before = std::numeric_limits<std::size_t>::max(), drawn = 0, ours = 0;
  for (int deeper = 0; deeper <= 2; ++deeper)
  {
    const int level = levelOfSpacing(c.image) + deeper;
    const auto octree = octreeOf(c.image, c.value, level);
    Scene scene(octree, false);
    const Picture traced = scene.unshadowed();
    scene.expectTraced(checks, 1, c.name + " is traced", 1);
    const double voxel = longestEdge(c.image) / (1 << level);
    vtkCamera* camera = scene.renderer->GetActiveCamera();
    const Violations v = violations(c, camera, raster, traced, voxel);
    std::printf(
      "%-22s level %d: of %6zu pixels %5zu are a voxel off, %4zu with a pixel of room: %zu of "
      "outlines; %zu beyond the image; off the trilinear surface: ours %zu, flying edges %zu, "
      "neither %zu\n",
      c.name.c_str(), level, v.drawn, v.exactly, v.withinPixel, v.outline, v.beyond, v.ours,
      v.edges, v.neither);
    drawn = v.drawn;
    checks.expect(v.drawn > 20000, c.name + ": enough of it is seen");
    ours = v.withinPixel - v.edges;
    // A few hundredths of a percent are pixels where a ray grazes, whatever the level.
    checks.expect(ours < before || ours * 5000 <= v.drawn, c.name + ": the deeper the closer");
    checks.expect(v.beyond * 20000 <= v.drawn, c.name + ": nothing is beyond the image");
    checks.expect(v.outline * 500 <= v.drawn, c.name + ": outlines within a pixel on 99.8 %");
    before = ours;
  }
  checks.expect(ours * 1000 <= drawn, c.name + ": within a voxel and a pixel on 99.9 %");
}

std::size_t count(const Picture& a, const Picture& b, int most)
{
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    bool differs = false;
    for (int k = 0; k < 3; ++k)
    {
      differs = differs || std::abs(int(a.rgb[3 * i + k]) - int(b.rgb[3 * i + k])) > most;
    }
    pixels += differs;
  }
  return pixels;
}

/// The same surface with gradients to the inside: as bones in a scan have them.
void compareSigns(const ImageCase& c, Checks& checks)
{
  const auto opposite = negated(c.image);
  const int level = levelOfSpacing(c.image) + 2;
  const auto outwards = octreeOf(c.image, c.value, level);
  const auto inwards = octreeOf(opposite, -c.value, level);
  const auto triangles = trianglesOf(c.image, c.value);
  Scene first(outwards, true), second(inwards, true), mesh(triangles, true);
  for (const double error : { 0.0, 1.0 })
  {
    for (int shadows = 0; shadows < 3; ++shadows)
    {
      Picture p[3];
      Scene* scenes[3] = { &first, &second, &mesh };
      for (int i = 0; i < 3; ++i)
      {
        scenes[i]->pass->SetPixelError(error);
        p[i] = shadows == 0 ? scenes[i]->unshadowed()
          : shadows == 1    ? scenes[i]->shadowedByBuffers()
                            : scenes[i]->shadowedByRays();
      }
      const std::size_t signs = count(p[0], p[1], 8), look = count(p[0], p[2], 40);
      std::printf("%-22s pixel error %g, %s: %zu pixels change with the sign, %zu and %zu are "
                  "otherwise than the mesh's\n",
        c.name.c_str(), error,
        shadows == 0     ? "no shadows"
          : shadows == 1 ? "buffer"
                         : "rays",
        signs, look, count(p[1], p[2], 40));
      const std::string name = c.name + ", shadows " + std::to_string(shadows);
      checks.expect(signs * 2000 <= p[0].size(), name + ": whichever side is larger");
      checks.expect(look * 200 <= p[0].size(), name + ": it looks as the triangles do");
    }
  }
}
}

int TestSVOImageSurface(int, char*[])
{
  Checks checks;
  for (const ImageCase& c : imageCases())
  {
    compareDepth(c, checks);
  }
  compareSigns(distanceCase(), checks);
  compareSigns(scanCase(), checks);
  return checks.exitCode();
}
