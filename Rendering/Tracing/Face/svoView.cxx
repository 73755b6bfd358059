#include "svoView.h"

#include "svoInverse.h"

#include <cmath>
#include <limits>

#include <glm/gtc/matrix_inverse.hpp>

namespace svo
{
double View::linearDepth(double windowDepth) const
{
  const double ndc = 2.0 * windowDepth - 1.0;
  const double t =
    (viewToClip[3][2] - ndc * viewToClip[3][3]) / (viewToClip[2][2] - ndc * viewToClip[2][3]);
  return parallel || t > 0.0 ? t : std::numeric_limits<double>::infinity();
}

bool makeView(
  const glm::dmat4& worldToView, const glm::dmat4& viewToClip, int width, int height, View& view)
{
  const glm::dmat4& p = viewToClip;
  if (!isFinite(worldToView) || !isFinite(p) || width < 1 || height < 1 || p[0][3] != 0.0 ||
    p[1][3] != 0.0)
  {
    return false;
  }
  // At depth t (view z = -t) the pixel with device coordinates (u, v) solves
  //   P00 X + P01 Y = u w - (P03 - t P02),  P10 X + P11 Y = v w - (P13 - t P12),  w = P33 - t P32,
  // so (X, Y) is affine in u, v and in t.
  const glm::dmat2 a(p[0][0], p[0][1], p[1][0], p[1][1]);
  const double determinant = glm::determinant(a);
  const double depthDeterminant = p[2][2] * p[3][3] - p[3][2] * p[2][3];
  if (!(std::abs(determinant) > 0.0) || !(std::abs(depthDeterminant) > 0.0))
  {
    return false;
  }
  const glm::dmat2 inverse = glm::inverse(a);
  // Constant term and t term, each as a function of (1, u, v).
  const double w0 = p[3][3];
  const double wt = -p[2][3];
  const glm::dvec2 o = inverse * glm::dvec2(-p[3][0], -p[3][1]);
  const glm::dvec2 ou = inverse * glm::dvec2(w0, 0.0);
  const glm::dvec2 ov = inverse * glm::dvec2(0.0, w0);
  const glm::dvec2 d = inverse * glm::dvec2(p[2][0], p[2][1]);
  const glm::dvec2 du = inverse * glm::dvec2(wt, 0.0);
  const glm::dvec2 dv = inverse * glm::dvec2(0.0, wt);

  const glm::dmat4 viewToWorld = glm::inverse(worldToView);
  const auto point = [&](glm::dvec2 v)
  { return glm::dvec3(viewToWorld * glm::dvec4(v, 0.0, 1.0)); };
  const auto vector = [&](glm::dvec2 v, double z)
  { return glm::dvec3(viewToWorld * glm::dvec4(v, z, 0.0)); };
  // u = 2 x / width - 1, v = 2 y / height - 1.
  const double su = 2.0 / width;
  const double sv = 2.0 / height;
  view.width = width;
  view.height = height;
  view.crop = { 0, 0, width, height };
  view.worldToView = worldToView;
  view.viewToClip = viewToClip;
  view.parallel = wt == 0.0;
  view.mirrored = determinant < 0.0;
  view.facetsFaceAxis = view.parallel;
  const glm::dvec2 none(0.0);
  view.plain = !view.mirrored && (view.parallel ? d == none : o == none && w0 == 0.0);
  view.eye = point(none);
  view.axis = vector(none, -1.0);
  view.origin = point(o - ou - ov);
  view.originX = vector(ou * su, 0.0);
  view.originY = vector(ov * sv, 0.0);
  view.direction = vector(d - du - dv, -1.0);
  view.directionX = vector(du * su, 0.0);
  view.directionY = vector(dv * sv, 0.0);
  // Window depths 0 and 1: z = -w and z = w.
  const auto depthAt = [&](double ndc)
  {
    // (P22 (-t) + P23) = ndc (P32 (-t) + P33)
    return (p[3][2] - ndc * p[3][3]) / (p[2][2] - ndc * p[2][3]);
  };
  view.tNear = depthAt(-1.0);
  view.tFar = depthAt(1.0);
  return std::isfinite(view.tNear) && !std::isnan(view.tFar) && view.tNear < view.tFar;
}

View cropped(const View& view)
{
  if (view.isWhole())
  {
    return view;
  }
  const PixelRect& crop = view.crop;
  glm::dmat4 toClip = view.viewToClip;
  const auto stretch = [&](int i, int from, int to, int size)
  {
    const double scale = static_cast<double>(size) / (to - from);
    const double middle = (static_cast<double>(from) + to) / size - 1.0; // clip space
    for (int column = 0; column < 4; ++column)
    {
      toClip[column][i] = scale * (toClip[column][i] - middle * toClip[column][3]);
    }
  };
  stretch(0, crop.x0, crop.x1, view.width);
  stretch(1, crop.y0, crop.y1, view.height);
  View result;
  makeView(view.worldToView, toClip, crop.x1 - crop.x0, crop.y1 - crop.y0, result);
  return result;
}

bool sameImage(const View& a, const View& b)
{
  return a.origin == b.origin && a.originX == b.originX && a.originY == b.originY &&
    a.direction == b.direction && a.directionX == b.directionX && a.directionY == b.directionY &&
    a.tNear == b.tNear && a.tFar == b.tFar && a.width == b.width && a.height == b.height;
}
}
