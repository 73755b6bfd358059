// Copies of the unit ball and the unit rod, and which splat shaders draw discs.
#include "svoMeshOctree.h"
#include "svoPlacedShapes.h"
#include "svoSplats.h"
#include "svoUnitShapes.h"

#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

using namespace svo;

TEST(RoundShapes, UnitShapesAreInsideOfTheTrueOnes)
{
  UnitShapes units;
  for (const RoundShapes::Shape shape : { RoundShapes::Shape::Ball, RoundShapes::Shape::Rod })
  {
    RoundShapes shapes;
    shapes.shape = shape;
    vtkPolyData* mesh = units.of(shapes);
    EXPECT_EQ(mesh, units.of(shapes)) << "made once";
    double most = 0.0;
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      glm::dvec3 p;
      mesh->GetPoint(i, &p.x);
      most =
        std::max(most, shape == RoundShapes::Shape::Ball ? glm::length(p) : std::hypot(p.x, p.y));
    }
    EXPECT_NEAR(most, 1.0, 1e-12);
    EXPECT_EQ(mesh->GetBounds()[4], shape == RoundShapes::Shape::Ball ? -1.0 : 0.0);
    EXPECT_EQ(mesh->GetBounds()[5], 1.0);
    Octree octree;
    std::string message;
    EXPECT_EQ(openAttachedOctree(mesh, octree, message), Attached::Found);
    EXPECT_EQ(message, "");
  }
}

TEST(RoundShapes, FacetsByPixels)
{
  RoundShapes shapes;
  EXPECT_EQ(UnitShapes::facetsOf(shapes), 64) << "of any length";
  shapes.width = RoundShapes::Width::Pixels;
  const std::pair<double, int> wanted[] = { { 0.5, 8 }, { 1.3, 8 }, { 1.5, 16 }, { 5.0, 16 },
    { 6.0, 32 }, { 50.0, 64 }, { 5000.0, 64 } };
  for (const auto& [radius, facets] : wanted)
  {
    shapes.radius = radius;
    EXPECT_EQ(UnitShapes::facetsOf(shapes), facets) << radius;
  }
}

TEST(RoundShapes, ThousandsOfBallsHaveFewerFacets)
{
  RoundShapes balls;
  for (const auto& [count, facets] : { std::pair<std::size_t, int>{ 1, 64 }, { 1000, 64 },
         { 3000, 32 }, { 20000, 16 }, { 1000000, 16 } })
  {
    balls.ends.assign(count, glm::dvec3(0.0));
    EXPECT_EQ(UnitShapes::facetsOf(balls), facets) << count;
  }
  balls.width = RoundShapes::Width::Pixels;
  EXPECT_EQ(UnitShapes::facetsOf(balls), 8) << "never more than pixels ask for";
  RoundShapes rods;
  rods.shape = RoundShapes::Shape::Rod;
  rods.ends.assign(2 * 10000, glm::dvec3(0.0));
  EXPECT_EQ(UnitShapes::facetsOf(rods), 64) << "a rod has few triangles";
}

TEST(RoundShapes, MatricesTakeTheUnitShapesThere)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-10.0, 10.0);
  RoundShapes rods;
  rods.shape = RoundShapes::Shape::Rod;
  for (int i = 0; i < 1000; ++i)
  {
    rods.ends.emplace_back(anywhere(random), anywhere(random), anywhere(random));
    rods.ends.push_back(rods.ends.back() +
      glm::dvec3(i % 3 == 0 ? 0.0 : anywhere(random), i % 5 == 0 ? 0.0 : anywhere(random),
        anywhere(random)));
    rods.radii.push_back(std::exp(anywhere(random)));
  }
  GlyphSet copies;
  placeShapes(rods, glm::dmat4(1.0), View(), copies);
  ASSERT_EQ(copies.copies.size(), 1000u);
  for (std::size_t i = 0; i < 1000; ++i)
  {
    const glm::dmat4 m(copies.copies[i].place);
    const glm::dvec3 from = rods.ends[2 * i], to = rods.ends[2 * i + 1];
    const glm::dvec3 axis = glm::normalize(to - from);
    for (double angle = 0.0; angle < 6.0; angle += 1.0)
    {
      for (const double height : { 0.0, 0.25, 1.0 })
      {
        const glm::dvec3 p =
          glm::dvec3(m * glm::dvec4(std::cos(angle), std::sin(angle), height, 1.0)) - from;
        const double along = glm::dot(p, axis);
        EXPECT_NEAR(along, height * glm::distance(from, to), 1e-9 * (rods.radii[i] + 10.0));
        EXPECT_NEAR(glm::length(p - along * axis) / rods.radii[i], 1.0, 1e-9);
      }
    }
  }
}

TEST(RoundShapes, DiscsOfShaders)
{
  const std::string square = "float dist = dot(offsetVCVSOutput.xy,offsetVCVSOutput.xy);\n";
  // ParaView's presets.
  EXPECT_EQ(discOf(("//VTK::Color::Impl\n" + square +
              "if (dist > 1.0) {\n  discard;\n} else {\n  float scale = (1.0 - dist);\n"
              "  ambientColor *= scale;\n  diffuseColor *= scale;\n}\n")
                     .c_str()),
    1.0);
  EXPECT_EQ(discOf((square +
              "if (dist > 1.0) {\n  discard;\n} else if (dist > 0.8) {\n"
              "  ambientColor = vec3(0.0, 0.0, 0.0);\n  diffuseColor = vec3(0.0);\n}\n")
                     .c_str()),
    1.0);
  EXPECT_EQ(discOf((square + "if (dist > 1.0) {\n  discard;\n};\n").c_str()), 1.0);
  EXPECT_EQ(discOf("//VTK::Color::Impl\n"), 0.0) << "a triangle";
  EXPECT_EQ(
    discOf("if (abs(offsetVCVSOutput.x) > 2.2 || abs(offsetVCVSOutput.y) > 2.2) { discard; }\n"
           "if (abs(offsetVCVSOutput.x) < 1.5 && abs(offsetVCVSOutput.y) < 1.5) { discard; }"),
    0.0)
    << "the outline of a square";
  // Others.
  EXPECT_EQ(discOf((square + "if (dist > 4.0) discard;").c_str()), 2.0);
  EXPECT_EQ(discOf("float r = length(offsetVCVSOutput); if (r > 0.5f) { discard; }"), 0.5);
  EXPECT_EQ(
    discOf("float r=sqrt(dot(offsetVCVSOutput.xy,offsetVCVSOutput.xy));if(r>.25){discard;}"), 0.25);
  EXPECT_EQ(
    discOf((square + "if (dist > 9.0) { discard; }\nopacity = opacity*exp(-0.5*dist);").c_str()),
    0.0)
    << "soft";
  EXPECT_EQ(
    discOf((square + "if (dist > 1.0) { discard; }\nif (dist < 0.5) { discard; }").c_str()), 0.0)
    << "a ring";
  EXPECT_EQ(discOf((square + "if (dist < 1.0) { discard; }").c_str()), 0.0) << "a hole";
  EXPECT_EQ(discOf((square + "// if (dist > 1.0) { discard; }").c_str()), 0.0) << "a comment";
  EXPECT_EQ(discOf((square + "if (dist > x) { discard; }").c_str()), 0.0);
  EXPECT_EQ(discOf((square + "if (dist > 1.0 + x) { discard; }").c_str()), 0.0);
  EXPECT_EQ(discOf((square + "if (dist >").c_str()), 0.0);
  EXPECT_EQ(discOf(""), 0.0);
  EXPECT_EQ(discOf(nullptr), 0.0);
}
