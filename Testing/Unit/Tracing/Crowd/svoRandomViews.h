// Views of all kinds: perspective and parallel, off-centre and sheared, at any scale and place.
#ifndef svoRandomViews_h
#define svoRandomViews_h

#include "svoCrowdFixtures.h"
#include "svoFrustum.h"
#include "svoView.h"

#include <glm/gtc/matrix_transform.hpp>

namespace svotest
{
/// The frustum of a rectangle of the view's pixels.
inline svo::Frustum frustumOf(svo::View view, const svo::PixelRect& rect, double margin = 1.0)
{
  view.crop = rect;
  return svo::Frustum(view, margin);
}

/// True if a ball lies beyond a plane of the frustum.
inline bool outside(const svo::Frustum& frustum, const glm::dvec3& centre, double radius)
{
  const glm::dvec3 size = glm::abs(centre);
  const double reach = radius + 0x1p-49 * glm::max(glm::max(size.x, size.y), size.z);
  bool is = false;
  for (int i = 0; i < frustum.planes(); ++i)
  {
    const glm::dvec4 plane = frustum.plane(i);
    is = is || glm::dot(glm::dvec3(plane), centre) + plane.w < -reach;
  }
  return is;
}

/// Around `middle`, of things of about the size `scale`.
inline svo::View randomView(RandomBalls& random, double scale, const glm::dvec3& middle)
{
  const auto place = [&](double reach)
  {
    return glm::dvec3(
      random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach));
  };
  svo::View view;
  const int width = 1 + static_cast<int>(random.below(2000));
  const int height = 1 + static_cast<int>(random.below(1200));
  const glm::dmat4 worldToView = glm::lookAt(
    middle + scale * place(12.0), middle + scale * place(4.0), glm::dvec3(0.1, 0.2, 1.0));
  const double left = random.between(-1.0, 0.5), bottom = random.between(-1.0, 0.5);
  const double right = left + std::exp2(random.between(-9.0, 2.0));
  const double top = bottom + std::exp2(random.between(-9.0, 2.0));
  const double tNear = std::exp2(random.between(-10.0, 3.0));
  const double tFar = tNear * std::exp2(random.between(0.01, 40.0));
  glm::dmat4 projection;
  const std::uint32_t kind = random.below(5);
  if (kind < 2)
  {
    const double n = scale * tNear;
    projection = glm::frustum(n * left, n * right, n * bottom, n * top, n, scale * tFar);
    if (kind == 1)
    {
      projection =
        glm::perspective(random.between(0.01, 3.1), double(width) / height, n, scale * tFar);
    }
  }
  else
  {
    const double s = 8.0 * scale;
    projection = glm::ortho(s * left, s * right, s * bottom, s * top, -scale * tNear, scale * tFar);
    if (kind == 4)
    {
      projection[2][0] = random.between(-1.0, 1.0) / scale; // rays aslant
      projection[2][1] = random.between(-1.0, 1.0) / scale;
    }
  }
  if (random.below(6) == 0)
  {
    projection = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1)) * projection; // mirrored
  }
  if (!svo::makeView(worldToView, projection, width, height, view))
  {
    return randomView(random, scale, middle);
  }
  return view;
}

inline svo::PixelRect randomRect(RandomBalls& random, const svo::View& view)
{
  const int x = static_cast<int>(random.below(view.width));
  const int y = static_cast<int>(random.below(view.height));
  const svo::PixelRect tiles{ x & ~31, y & ~31, std::min((x & ~31) + 32, view.width),
    std::min((y & ~31) + 32, view.height) };
  return random.below(2) ? tiles : svo::PixelRect{ 0, 0, view.width, view.height };
}
}

#endif
