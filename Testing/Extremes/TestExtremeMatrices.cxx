// Matrices at the extremes: scene and camera moved together, the law that errors obey, a million
// rotations, and matrices that are none.
#include "svoExtremes.h"

#include "svoIntersect.h"
#include "svoTestTracers.h"
#include "svoWorldSize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

using namespace svotest;

namespace
{
constexpr double Ulp = 2.220446049250313e-16; // 2^-52

/// The constant of the error law (Documentation/Numerics.md).
constexpr double LawConstant = 8.0;

const svo::Octree& object()
{
  static const svo::Octree octree = makeOctree(torus(60, 30), 10);
  return octree;
}

/// A scene: an object placed by `model` and an eye that looks at it; and the same scene after
/// `motion` has moved both. Motions are composed exactly and rounded once, as well as doubles can.
struct Pair
{
  glm::dmat4 model;
  svo::View view;
  glm::dmat4 movedModel;
  svo::View movedView;
  double law = 0.0; // kappa 2^-52 |eye| / voxel

  Pair(Chance& chance, double condition, double distance)
  {
    const glm::dmat3 linear = chance.linear(condition);
    this->model = affine(linear, glm::dvec3(0.0));
    const glm::dvec3 eye = chance.direction() * chance.between(2.5, 5.0);
    const glm::dmat4 worldToView = glm::lookAt(eye, 0.2 * chance.direction(), chance.direction());
    const glm::dmat4 projection = glm::perspective(0.6, 1.0, 0.1, 50.0);
    svo::makeView(worldToView, projection, 64, 64, this->view);
    const ExactMat4 motion(affine(chance.rotation(), distance * chance.direction()));
    this->movedModel = glm::dmat4(motion * ExactMat4(this->model));
    svo::makeView(glm::dmat4(ExactMat4(worldToView) * inverseAffine(motion)), projection, 64, 64,
      this->movedView);
    const double far =
      std::max(glm::length(glm::dvec3(motion * ExactVec4(eye, 1.0))), glm::length(eye));
    svo::Instance instance = instanceOf(object(), 1, this->model);
    this->law = condition * Ulp * far / svo::worldVoxel(instance);
  }
};

/// The point of the image where a point of the object is seen.
glm::dvec2 imagePoint(const Pair& pair, const glm::dvec3& local)
{
  const ExactVec4 clip = ExactMat4(pair.view.viewToClip) * ExactMat4(pair.view.worldToView) *
    ExactMat4(pair.model) * ExactVec4(local, 1.0);
  return { static_cast<double>((clip.x / clip.w + 1) / 2 * pair.view.width),
    static_cast<double>((clip.y / clip.w + 1) / 2 * pair.view.height) };
}

/// Distance in voxels between the local ray of a point of the image and the exact one, where that
/// is nearest to a point of the object that it was aimed at. The point that the local ray says is
/// taken back into the world, where the exact ray is known; only what is left goes through an
/// inverse, which need not be exact then.
double displacement(const Pair& pair, const svo::LocalView& moved, const glm::dvec3& local)
{
  const glm::dvec2 image = imagePoint(pair, local);
  const Exact x = image.x, y = image.y;
  const auto at = [&](
                    const glm::dvec3& constant, const glm::dvec3& alongX, const glm::dvec3& alongY)
  { return ExactVec3(constant) + x * ExactVec3(alongX) + y * ExactVec3(alongY); };
  const svo::Header& h = object().header();
  const ExactVec3 corner(h.origin[0], h.origin[1], h.origin[2]);
  const Exact edge = object().rootEdge();

  const ExactVec3 origin = at(moved.origin, moved.originX, moved.originY);
  const ExactVec3 direction = at(moved.direction, moved.directionX, moved.directionY);
  const ExactVec3 aim = Exact(1) + (ExactVec3(local) - corner) / edge;
  const Exact t = glm::dot(aim - origin, direction) / glm::dot(direction, direction);
  const ExactVec3 said = corner + (origin + t * direction - Exact(1)) * edge;

  const svo::View& v = pair.view;
  const ExactMat4 model(pair.model);
  const ExactVec3 d = at(v.direction, v.directionX, v.directionY);
  const ExactVec3 apart = ExactVec3(model * ExactVec4(said, Exact(1))) -
    at(v.origin, v.originX, v.originY) - (t + Exact(moved.base)) * d;
  const glm::mat<3, 3, Exact> inverse(inverseAffine(model));
  const ExactVec3 along = glm::normalize(inverse * d);
  const ExactVec3 off = inverse * apart;
  return static_cast<double>(glm::length(off - glm::dot(off, along) * along)) / h.voxelSize;
}

/// What a ray meets: in double, or in float as a block does.
FoundCell traceAs(bool floats, const svo::Ray& ray)
{
  const int level = object().level();
  return floats ? traceFloat(object(), ray, level) : traceDouble(object(), ray, level);
}

bool same(const FoundCell& a, const FoundCell& b)
{
  return a.hit == b.hit && (!a.hit || a.cell == b.cell);
}

svo::Frame frameOf(const svo::Scene& scene, const svo::View& view)
{
  svo::FrameSettings settings;
  settings.pixelError = 0.0;
  settings.shadowResolution = 128;
  return rendered(scene, view, settings);
}
}

// c kappa 2^-52 |eye| / voxel, from near to far beyond what the picture can bear.
TEST(ExtremeMatrices, LocalRaysObeyTheErrorLaw)
{
  Chance chance(11);
  double worst = 0.0;
  const long cases = scaled(40);
  for (int k = 0; k <= 12; k += 2)
  {
    for (int j = 0; j <= 9; j += 3)
    {
      double c = 0.0;
      for (long i = 0; i < cases; ++i)
      {
        const Pair pair(chance, std::pow(10.0, j), 2.8 * std::pow(10.0, k));
        const svo::LocalView moved = svo::makeLocalView(object(), pair.movedModel, pair.movedView);
        for (int p = 0; p < 16; ++p)
        {
          const glm::dvec3 local = 1.4 * chance.direction();
          const double off = displacement(pair, moved, local);
          c = std::max(c, off / pair.law);
          EXPECT_LE(off, LawConstant * pair.law)
            << "distance 1e" << k << " object sizes, condition 1e" << j << ", towards " << local.x
            << " " << local.y << " " << local.z << "\nmodel " << text(pair.model) << "\nmoved "
            << text(pair.movedModel);
        }
      }
      worst = std::max(worst, c);
      std::printf("distance 1e%d object sizes, condition 1e%d: c = %.3f\n", k, j, c);
    }
  }
  RecordProperty("c", std::to_string(worst));
}

struct Together
{
  const char* name;
  double condition;
  double distance; // object sizes
};

void PrintTo(const Together& t, std::ostream* out)
{
  *out << t.name;
}

class MovedTogether : public testing::TestWithParam<Together>
{
};

// The same voxel on every ray, but for rays that pass a voxel's border within rounding distance:
// those are counted, and each is shown to be one.
TEST_P(MovedTogether, TheSameVoxelsAreHit)
{
  const Together& t = GetParam();
  Chance chance(23);
  long rays = 0, hits = 0, ties = 0, floatTies = 0, rounded = 0;
  for (long i = 0; i < scaled(100); ++i)
  {
    const Pair pair(chance, t.condition, 2.8 * t.distance);
    const svo::LocalView still = svo::makeLocalView(object(), pair.model, pair.view);
    const svo::LocalView moved = svo::makeLocalView(object(), pair.movedModel, pair.movedView);
    const double law = 2.0 * LawConstant * pair.law * cellEdge(object(), object().level());
    for (int k = 0; k < 300; ++k, ++rays)
    {
      const glm::dvec3 local = 1.4 * chance.direction();
      const glm::dvec2 image = imagePoint(pair, local);
      const svo::Ray a = localRay(still, image);
      const FoundCell exact = traceAs(false, a);
      hits += exact.hit;
      // The other result, and how far the rays may be apart.
      const auto expectSame = [&](const FoundCell& other, double slack, long& count)
      {
        if (same(exact, other))
        {
          return;
        }
        ++count;
        EXPECT_TRUE((exact.hit && isTie(object(), a, exact.cell, slack)) ||
          (other.hit && isTie(object(), a, other.cell, slack)))
          << t.name << ", towards " << local.x << " " << local.y << " " << local.z << "\nmodel "
          << text(pair.model) << "\nmoved " << text(pair.movedModel);
      };
      const double slack = law + 4.0 * Ulp * (2.0 + glm::length(a.origin));
      expectSame(traceAs(false, localRay(moved, image)), slack, ties);
      const svo::Ray inFloats = blockRay(object(), still, image);
      expectSame(traceAs(true, inFloats), slack + floatSlack(inFloats), rounded);
      const svo::Ray movedInFloats = blockRay(object(), moved, image);
      expectSame(traceAs(true, movedInFloats), slack + floatSlack(movedInFloats), floatTies);
    }
  }
  std::printf(
    "%s: %ld of %ld rays hit. Ties: moved, in double %ld; not moved, in float %ld; moved, "
    "in float %ld\n",
    t.name, hits, rays, ties, rounded, floatTies);
  EXPECT_GT(hits, rays / 4);
  EXPECT_LE(ties, rays / 1000);
  EXPECT_LE(rounded, rays / 100);
  EXPECT_LE(floatTies, rays / 100);
}

INSTANTIATE_TEST_SUITE_P(ExtremeMatrices, MovedTogether,
  testing::Values(Together{ "nearby", 1.0, 1.0 }, Together{ "1e4 sizes away", 1.0, 1e4 },
    Together{ "1e8 sizes away", 1.0, 1e8 }, Together{ "condition 1e3", 1e3, 1.0 },
    Together{ "condition 1e6", 1e6, 1.0 }, Together{ "condition 1e3, 1e4 away", 1e3, 1e4 },
    Together{ "condition 1e6, 100 away", 1e6, 100.0 }),
  [](const auto& info) { return "Case" + std::to_string(info.index); });

// What every kind of matrix shows, pixel by pixel, against rays in double through the exact
// inverse.
TEST(ExtremeMatrices, EveryKindOfMatrixShowsTheObject)
{
  struct Kind
  {
    const char* name;
    glm::dmat3 linear;
    double size; // of what is seen, world
  };
  Chance chance(5);
  const glm::dmat3 one(1.0);
  const glm::dmat3 shear(1.0, 0.0, 0.0, 5.0, 1.0, 0.0, 0.0, -3.0, 1.0);
  const glm::dmat3 mirror(-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
  const Kind kinds[] = { { "as it is", one, 1.0 }, { "1e-25 times", 1e-25 * one, 1e-25 },
    { "1e-9 times", 1e-9 * one, 1e-9 }, { "1e9 times", 1e9 * one, 1e9 },
    { "1e25 times", 1e25 * one, 1e25 }, { "sheared", shear, 4.0 }, { "mirrored", mirror, 1.0 },
    { "mirrored thrice", -one, 1.0 },
    { "flat to 1e-3", glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, 1e-3), 1.0 },
    { "long by 1e3", glm::dmat3(1, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3), 1.0 },
    { "any of condition 1e2", chance.linear(1e2), 1.0 },
    { "any of condition 1e4", chance.linear(1e4), 1.0 } };
  for (const Kind& kind : kinds)
  {
    const glm::dmat4 model = affine(kind.linear, kind.size * glm::dvec3(0.3, -0.2, 0.1));
    const glm::dvec3 eye = kind.size * glm::dvec3(1.5, -4.0, 2.5);
    svo::View view;
    ASSERT_TRUE(svo::makeView(glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0, 0, 1)),
      glm::perspective(0.6, 1.0, 0.1 * kind.size, 50.0 * kind.size), 96, 96, view));
    svo::Scene scene;
    scene.instances = { instanceOf(object(), 1, model, svo::LeafGeometry::Voxel) };
    svo::FrameSettings settings;
    settings.shadowTechnique = svo::ShadowTechnique::None;
    settings.pixelError = 0.0;
    const svo::Frame frame = rendered(scene, view, settings);
    const svo::LocalView local = svo::makeLocalView(object(), model, view);
    long hits = 0, differ = 0;
    for (int p = 0; p < 96 * 96; ++p)
    {
      const svo::Ray ray = localRay(local, { p % 96 + 0.5, p / 96 + 0.5 });
      const FoundCell expected = traceDouble(object(), ray, object().level());
      hits += expected.hit;
      if (expected.hit != (frame.instance[p] == 0))
      {
        ++differ;
        const FoundCell found =
          traceAs(true, blockRay(object(), local, { p % 96 + 0.5, p / 96 + 0.5 }));
        EXPECT_TRUE(
          isTie(object(), ray, expected.hit ? expected.cell : found.cell, floatSlack(ray)))
          << kind.name << ", pixel " << p % 96 << ", " << p / 96;
      }
      EXPECT_FALSE(std::isnan(frame.depth[p]));
    }
    std::printf("%s: %ld pixels hit, %ld ties\n", kind.name, hits, differ);
    EXPECT_GT(hits, 3) << kind.name;
    EXPECT_LE(differ, 4) << kind.name;
  }
}

// M' = R M, a million times. What is drawn stays exact for the matrix that is given; the matrix
// itself is no rotation any more. The remedy, vtkMath::Orthogonalize3x3 or a Gram-Schmidt step as
// here every thousand steps, costs nothing.
TEST(ExtremeMatrices, AMillionRotationsDriftByAKnownAmount)
{
  const auto departure = [](const glm::dmat3& m) // from a rotation
  {
    const glm::dmat3 off = glm::transpose(m) * m - glm::dmat3(1.0);
    double largest = 0.0;
    for (int i = 0; i < 9; ++i)
    {
      largest = std::max(largest, std::abs(off[i / 3][i % 3]));
    }
    return largest;
  };
  Chance chance(7);
  const glm::dvec3 axis = chance.direction();
  const double angle = 2.0 * Pi / 1000.0; // a turn in a thousand steps
  const glm::dmat3 step = glm::mat3_cast(glm::angleAxis(angle, axis));
  glm::dmat3 plain(1.0), mended(1.0);
  for (int i = 1; i <= 1000000; ++i)
  {
    plain = step * plain;
    mended = step * mended;
    if (i % 1000 == 0)
    {
      mended[0] = glm::normalize(mended[0]);
      mended[1] = glm::normalize(mended[1] - glm::dot(mended[0], mended[1]) * mended[0]);
      mended[2] = glm::cross(mended[0], mended[1]);
    }
  }
  const auto turned = [](const glm::dmat3& m) // from where a whole number of turns ends
  {
    const glm::dmat3 off = m - glm::dmat3(1.0);
    return std::max({ glm::length(off[0]), glm::length(off[1]), glm::length(off[2]) });
  };
  std::printf("after 1e6 rotations: %.2g from a rotation, %.2g from the right one; mended every "
              "1000: %.2g and %.2g\n",
    departure(plain), turned(plain), departure(mended), turned(mended));
  EXPECT_LT(departure(plain), 1e6 * Ulp); // an ulp a step at most
  EXPECT_LT(turned(plain), 1e6 * Ulp);
  EXPECT_LT(departure(mended), 4.0 * Ulp);
  // At level 10 the drift is far below a voxel.
  EXPECT_LT(departure(plain) * (1 << 10), 1e-3);
}

// A matrix that places nothing anywhere draws nothing, and changes no bit of what others draw.
TEST(ExtremeMatrices, MatricesThatAreNoneChangeNothingElse)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  svo::Scene good;
  good.instances = { instanceOf(object(), 1),
    instanceOf(makeOctree(square(3.0), 7), 2, movedTo(0.0, 0.0, -1.0)) };
  good.lights = { lightOf(svo::Light::Kind::Directional, { 2, -1, 5 }) };
  const svo::View view = lookAt({ 1, -6, 4 }, 96, 80);
  const svo::Frame expected = frameOf(good, view);
  std::vector<std::pair<std::string, glm::dmat4>> bad;
  for (int i = 0; i < 16; ++i)
  {
    for (const double value : { nan, infinity, -infinity })
    {
      glm::dmat4 m(1.0);
      m[i / 4][i % 4] = value;
      bad.emplace_back("element " + std::to_string(i) + " is " + std::to_string(value), m);
    }
  }
  bad.emplace_back("zero", glm::dmat4(0.0));
  for (int c = 0; c < 3; ++c)
  {
    glm::dmat4 m(1.0);
    m[c] = glm::dvec4(0.0);
    bad.emplace_back("column " + std::to_string(c) + " is zero", m);
  }
  for (const auto& [name, matrix] : bad)
  {
    svo::Scene scene = good;
    scene.instances.push_back(instanceOf(object(), 9, matrix));
    const svo::Frame frame = frameOf(scene, view);
    int changed = 0;
    for (std::size_t p = 0; p < frame.instance.size(); ++p)
    {
      const bool same = frame.instance[p] == expected.instance[p] &&
        std::memcmp(&frame.depth[p], &expected.depth[p], sizeof(float)) == 0 &&
        std::equal(&frame.color[4 * p], &frame.color[4 * p] + 4, &expected.color[4 * p]);
      changed += !same;
      ASSERT_FALSE(std::isnan(frame.depth[p])) << name;
    }
    EXPECT_EQ(changed, 0) << name;
  }
}
