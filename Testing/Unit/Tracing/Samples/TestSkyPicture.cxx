// A sky's picture: directions are drawn as often as light comes from them, and the mean of what
// they count is what arrives on a plane.
#include "svoSkyPicture.h"

#include "svoSampleSequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace
{
const double Pi = std::acos(-1.0);

/// Right, up, and front, which is right x up, as VTK has it; turned.
const glm::mat3 Axes(glm::vec3(0.0f, 0.6f, 0.8f), glm::vec3(1.0f, 0.0f, 0.0f),
  glm::cross(glm::vec3(0.0f, 0.6f, 0.8f), glm::vec3(1.0f, 0.0f, 0.0f)));

using Colors = std::function<glm::vec3(const glm::vec3&)>; // by unit direction along the axes

glm::dvec3 along(int columns, int rows, double x, double y)
{
  const double longitude = 2.0 * Pi * (x / columns - 0.5), latitude = Pi * (y / rows - 0.5);
  return { std::cos(latitude) * std::cos(longitude), std::sin(latitude),
    std::cos(latitude) * std::sin(longitude) };
}

std::vector<float> paint(int columns, int rows, const Colors& colors)
{
  std::vector<float> rgb;
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      const glm::vec3 color = colors(glm::vec3(along(columns, rows, x + 0.5, y + 0.5)));
      rgb.insert(rgb.end(), { color.r, color.g, color.b });
    }
  }
  return rgb;
}

svo::SkyPicture pictureOf(int columns, int rows, const Colors& colors)
{
  return svo::SkyPicture(columns, rows, paint(columns, rows, colors).data(), Axes);
}

/// What arrives on a plane, by the pixels' own light, each cut into `parts` squared.
glm::dvec3 arriving(int columns, int rows, const Colors& colors, const glm::vec3& normal, int parts)
{
  glm::dvec3 sum(0.0);
  for (int y = 0; y < rows * parts; ++y)
  {
    const double solid = 2.0 * Pi / (columns * parts) *
      (std::sin(Pi * ((y + 1.0) / (rows * parts) - 0.5)) -
        std::sin(Pi * (double(y) / (rows * parts) - 0.5)));
    for (int x = 0; x < columns * parts; ++x)
    {
      const glm::dvec3 at = along(columns, rows, (x + 0.5) / parts, (y + 0.5) / parts);
      const glm::dvec3 middle = along(columns, rows, x / parts + 0.5, y / parts + 0.5);
      const double cosine = glm::dot(glm::dmat3(Axes) * at, glm::dvec3(normal));
      sum += std::max(cosine, 0.0) / Pi * solid * glm::dvec3(colors(glm::vec3(middle)));
    }
  }
  return sum;
}

/// The mean of so many samples.
glm::dvec3 sampled(const svo::SkyPicture& picture, const glm::vec3& normal, int samples)
{
  glm::dvec3 sum(0.0);
  for (const svo::SquarePoint& point : svo::firstPoints(samples))
  {
    const glm::vec3 direction = picture.direction(point.position());
    EXPECT_NEAR(1.0f, glm::length(direction), 1e-5f);
    const glm::vec3 share = picture.share(direction, normal);
    EXPECT_LE(std::max({ share.r, share.g, share.b }), 1.0f + 1e-5f);
    sum += glm::dvec3(share);
  }
  return static_cast<double>(picture.brightest()) / samples * sum;
}

glm::vec3 gradient(const glm::vec3& at)
{
  return glm::vec3(0.5f, 0.4f, 0.3f) + at.y * glm::vec3(0.3f, 0.1f, -0.2f) +
    at.x * glm::vec3(0.1f, 0.0f, 0.2f);
}

/// A sun of a cell and a half, a thousand times as bright as the sky.
glm::vec3 sunny(const glm::vec3& at)
{
  const bool sun = glm::dot(at, glm::normalize(glm::vec3(1.0f, 2.0f, -0.5f))) > std::cos(0.04f);
  return sun ? glm::vec3(900.0f, 800.0f, 600.0f) : gradient(at);
}

const glm::vec3 Normals[] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 0.6f, 0.8f }, { 0, -1, 0 },
  glm::normalize(glm::vec3(1, -2, 0.5f)) };
}

TEST(SkyPicture, SamplesAreWhatArrives)
{
  struct Size
  {
    int columns, rows, parts;
    double bound; // where cells are means of pixels, light moves by half a cell
  };
  for (const Size& size : { Size{ 1, 1, 256, 0.005 }, Size{ 7, 3, 64, 0.005 },
         Size{ 128, 64, 4, 0.005 }, Size{ 512, 256, 1, 0.02 } })
  {
    for (const Colors& colors : { Colors(gradient), Colors(sunny) })
    {
      const svo::SkyPicture picture = pictureOf(size.columns, size.rows, colors);
      for (const glm::vec3& normal : Normals)
      {
        const glm::dvec3 found = sampled(picture, normal, 4096);
        const glm::dvec3 expected = arriving(size.columns, size.rows, colors, normal, size.parts);
        EXPECT_LT(glm::distance(found, expected), size.bound * picture.brightest())
          << size.columns << " columns";
      }
    }
  }
}

TEST(SkyPicture, OfOneColourIsThatColour)
{
  const glm::vec3 color(0.2f, 0.5f, 0.4f);
  const svo::SkyPicture picture = pictureOf(32, 16, [&](const glm::vec3&) { return color; });
  EXPECT_NEAR(4.0f * 0.5f, picture.brightest(), 1e-5f);
  for (const glm::vec3& normal : Normals)
  {
    EXPECT_LT(glm::distance(picture.over(normal), color), 2e-3f);
    EXPECT_LT(glm::distance(sampled(picture, normal, 1024), glm::dvec3(color)), 5e-3);
  }
}

TEST(SkyPicture, OpenPlanesHaveItAsWellAsItsBound)
{
  const auto expect = [](const Colors& colors, double bound)
  {
    const svo::SkyPicture picture = pictureOf(256, 128, colors);
    for (const glm::vec3& normal : Normals)
    {
      const glm::dvec3 expected = arriving(256, 128, colors, normal, 1);
      EXPECT_LT(
        glm::distance(glm::dvec3(picture.over(normal)), expected), bound * picture.brightest());
    }
  };
  expect(gradient, 0.003);
  expect(sunny, 0.1);
}

TEST(SkyPicture, BrightPlacesAreDrawnAsOftenAsTheirLight)
{
  // One cell of four, in each of two rows, has three quarters of the light.
  std::vector<float> rgb(3 * 8, 1.0f);
  rgb[0] = rgb[1] = rgb[2] = 21.0f; // of row 0, column 0: 21 of 21 + 7
  const svo::SkyPicture picture(4, 2, rgb.data(), glm::mat3(1.0f));
  int there = 0;
  for (const svo::SquarePoint& point : svo::firstPoints(1024))
  {
    const glm::vec3 d = picture.direction(point.position());
    there +=
      d.y < 0.0f && d.x < 0.0f && d.z < 0.0f; // below, left of the middle by a quarter and more
  }
  EXPECT_NEAR(768, there, 4);
}

TEST(SkyPicture, TheMiddleIsWhereVTKHasIt)
{
  // (VTK looks its textures up at atan2(z, x) and asin(y).)
  const svo::SkyPicture picture =
    pictureOf(64, 32, [](const glm::vec3& at) { return glm::vec3(at.x > 0.98f ? 1.0f : 0.0f); });
  for (const svo::SquarePoint& point : svo::firstPoints(64))
  {
    EXPECT_GT(glm::dot(picture.direction(point.position()), Axes[0]), 0.95f);
  }
}

TEST(SkyPicture, NothingAndNonsenseAreDark)
{
  const float inf = std::numeric_limits<float>::infinity();
  const svo::SkyPicture dark = pictureOf(8, 4, [](const glm::vec3&) { return glm::vec3(0.0f); });
  EXPECT_EQ(0.0f, dark.brightest());
  EXPECT_EQ(glm::vec3(0.0f), dark.over(Normals[0]));
  EXPECT_NEAR(1.0f, glm::length(dark.direction({ 0.3f, 0.7f })), 1e-5f);
  const svo::SkyPicture odd = pictureOf(8, 4,
    [&](const glm::vec3& at) { return glm::vec3(std::nanf(""), at.x > 0 ? inf : 1.0f, -3.0f); });
  EXPECT_TRUE(std::isfinite(odd.brightest()));
  for (const svo::SquarePoint& point : svo::firstPoints(64))
  {
    const glm::vec3 share = odd.share(odd.direction(point.position()), Normals[1]);
    EXPECT_TRUE(share.r == 0.0f && share.g >= 0.0f && share.g <= 1.0f && share.b == 0.0f);
  }
}
