// Samples and the directions that are made of them, against what they are said to be.
#include "svoSampleDirections.h"
#include "svoSampleSequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Edge = 64; // of the mask, pixels
constexpr int Pixels = Edge * Edge;
constexpr double Rounding = 6e-8; // of a float, relative
constexpr int Log = 16;           // of how many samples moments are taken

/// Of 2^Log points of a (0, 2)-sequence in base 2: Niederreiter, "Point sets and sequences with
/// small discrepancy", 1987. Of boxes at a corner of the square.
constexpr double Discrepancy = (0.5 * Log + 1.5) / (1 << Log);
/// Any box is four of these; and a mean of a function is off by its variation times as much, which
/// is 4 at most of those below: 1 along each diagonal of the square, across which they bend.
constexpr double Moment = 4.0 * Discrepancy;

const std::vector<unsigned> Streams = { 0, 1, 2, 7, 100, ~0u };

/// The ranks of a mask, 0..1, less their mean.
std::vector<double> ranks(unsigned stream, bool second)
{
  std::vector<double> all;
  for (int i = 0; i < Pixels; ++i)
  {
    const svo::SquarePoint at = svo::pixelRotation(i % Edge, i / Edge, stream);
    all.push_back((second ? at.v : at.u) / 4294967296.0 - 0.5);
  }
  return all;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
  double ab = 0.0, aa = 0.0;
  for (int i = 0; i < Pixels; ++i)
  {
    ab += a[i] * b[i];
    aa += a[i] * a[i]; // and b's, being another order of the same
  }
  return ab / aa;
}

/// Mean power of the frequencies of up to `most` periods an edge; of white noise 1.
double lowPower(const std::vector<double>& values, int most)
{
  double sum = 0.0, variance = 0.0;
  int frequencies = 0;
  for (const double v : values)
  {
    variance += v * v;
  }
  for (int fy = -most; fy <= most; ++fy)
  {
    for (int fx = -most; fx <= most; ++fx)
    {
      if ((fx == 0 && fy == 0) || fx * fx + fy * fy > most * most)
      {
        continue;
      }
      std::complex<double> wave = 0.0;
      for (int i = 0; i < Pixels; ++i)
      {
        wave += values[i] * std::polar(1.0, 2.0 * Pi * (fx * (i % Edge) + fy * (i / Edge)) / Edge);
      }
      sum += std::norm(wave) / variance;
      ++frequencies;
    }
  }
  return sum / frequencies;
}

std::uint64_t digest(std::uint64_t of, std::uint32_t more)
{
  for (int byte = 0; byte < 4; ++byte)
  {
    of = (of ^ (more >> 8 * byte & 255)) * 0x100000001b3ull; // FNV-1a
  }
  return of;
}

std::vector<glm::vec3> someAxes()
{
  std::vector<glm::vec3> axes = { { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 }, { 0, -1, 0 },
    glm::normalize(glm::vec3(1e-4f, 0, -1)), glm::normalize(glm::vec3(1, 1e-7f, -1e-7f)),
    { 1, 0, -0.0f } };
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20; ++i)
  {
    axes.push_back(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
  }
  return axes;
}

/// Of a direction: components of three floats, products of the basis' three floats each.
constexpr double UnitBound = 16 * Rounding;

void expectUnit(const glm::vec3& direction)
{
  ASSERT_NEAR(glm::length(glm::dvec3(direction)), 1.0, UnitBound);
}

svo::Light ballAt(const glm::dvec3& position, double radius)
{
  svo::Light light;
  light.kind = svo::Light::Kind::Point;
  light.position = position;
  light.size = radius;
  return light;
}

svo::Light discAlong(const glm::dvec3& direction, double angle)
{
  svo::Light light;
  light.direction = glm::normalize(direction);
  light.size = angle;
  return light;
}

/// Calls f(direction, length) for the first samples of a light.
template <class F>
void eachSample(const svo::Light& light, const glm::dvec3& point, F&& f, int count = 1 << Log)
{
  const svo::LightCone cone(light, point);
  for (int i = 0; i < count; ++i)
  {
    float length = -1.0f;
    const glm::vec3 direction = cone.direction(svo::sequencePoint(i), length);
    f(direction, length);
  }
}

/// Shares of values that lie below eighths of 1: they are spread evenly. Where rings of the disc
/// are squares of samples, each such share is the share of a box.
class Evenness
{
public:
  void add(double value)
  {
    for (int k = 1; k < 8; ++k)
    {
      this->Below[k] += value < k / 8.0;
    }
    ++this->Count;
  }
  void expect() const
  {
    for (int k = 1; k < 8; ++k)
    {
      EXPECT_NEAR(this->Below[k] / static_cast<double>(this->Count), k / 8.0, Moment) << k;
    }
  }

private:
  int Below[8] = {}, Count = 0;
};
}

TEST(SampleSequence, EachElementaryIntervalHasOnePoint)
{
  for (int log = 0; log <= 12; ++log)
  {
    const std::uint32_t count = 1u << log;
    for (std::uint32_t block = 0; block < 5; ++block)
    {
      for (int across = 0; across <= log; ++across)
      {
        std::vector<int> in(count);
        for (std::uint32_t i = 0; i < count; ++i)
        {
          const svo::SquarePoint at = svo::sequencePoint(block * count + i);
          const std::uint64_t u = std::uint64_t(at.u) >> (32 - across);
          const std::uint64_t v = std::uint64_t(at.v) >> (32 - (log - across));
          ++in[u << (log - across) | v];
        }
        ASSERT_EQ(std::vector<int>(count, 1), in) << log << " " << block << " " << across;
      }
    }
  }
}

TEST(SampleSequence, PositionsLieInTheSquare)
{
  for (const std::uint32_t u : { 0u, 1u, 255u, 1u << 31, ~0u })
  {
    const glm::vec2 at = svo::SquarePoint{ u, ~u }.position();
    EXPECT_GE(at.x, 0.0f);
    EXPECT_LT(at.x, 1.0f);
    EXPECT_NEAR(at.x, u / 4294967296.0, 1.0 / (1 << 24));
    EXPECT_LT(at.y, 1.0f);
  }
}

TEST(SampleSequence, RotationsAreAllDifferent)
{
  for (const unsigned stream : Streams)
  {
    std::set<std::uint32_t> first, second;
    for (int i = 0; i < Pixels; ++i)
    {
      const int x = i % Edge, y = i / Edge;
      const svo::SquarePoint at = svo::pixelRotation(x, y, stream);
      const svo::SquarePoint far = svo::pixelRotation(x + 3 * Edge, y + 50 * Edge, stream);
      ASSERT_TRUE(at.u == far.u && at.v == far.v);
      // In the middle of their share of the 2^32.
      ASSERT_EQ(1u << 19, at.u & 0xfffff);
      ASSERT_EQ(1u << 19, at.v & 0xfffff);
      first.insert(at.u);
      second.insert(at.v);
    }
    EXPECT_EQ(Pixels, static_cast<int>(first.size()));
    EXPECT_EQ(Pixels, static_cast<int>(second.size()));
  }
}

namespace
{
svo::View viewFrom(
  const glm::dvec3& eye, const glm::dvec3& at, double angle, double nearest, double farthest)
{
  svo::View view;
  EXPECT_TRUE(svo::makeView(glm::lookAt(eye, at, glm::dvec3(0.0, 0.0, 1.0)),
    glm::perspective(angle, 1.25, nearest, farthest), 320, 256, view));
  return view;
}
}

// A picture has the same samples wherever it is made, whatever its planes are, and others as soon
// as the eye goes, turns or zooms.
TEST(SampleSequence, EachViewHasItsOwnPartOfTheMask)
{
  for (const double scale : { 1.0, 1e-6, 1e7 })
  {
    const glm::dvec3 eye = scale * glm::dvec3(8.0, -3.7, 2.0),
                     at = scale * glm::dvec3(0.5, 0.1, 0.0);
    const glm::ivec2 shift = svo::noiseShift(viewFrom(eye, at, 0.5, 0.1 * scale, 100.0 * scale));
    EXPECT_EQ(shift, svo::noiseShift(viewFrom(eye, at, 0.5, 0.2 * scale, 50.0 * scale)));
    EXPECT_EQ(shift,
      svo::noiseShift(viewFrom(
        eye * (1.0 + 1e-14), at * (1.0 - 1e-14), 0.5 * (1.0 + 1e-15), 0.1 * scale, 100.0 * scale)));
    std::set<int> shifts;
    constexpr int Views = 300;
    for (int i = 0; i < Views; ++i)
    {
      const double step = 1e-5 * (i + 1) * scale;
      const glm::dvec3 aside(step, 0.5 * step, 0.0);
      for (const svo::View& view : { viewFrom(eye + aside, at + aside, 0.5, scale, 100.0 * scale),
             viewFrom(eye, at + aside, 0.5, scale, 100.0 * scale),
             viewFrom(eye + 1e-5 * (i + 1) * (at - eye), at, 0.5, scale, 100.0 * scale),
             viewFrom(eye, at, 0.5 + 1e-5 * (i + 1), scale, 100.0 * scale) })
      {
        const glm::ivec2 other = svo::noiseShift(view);
        ASSERT_TRUE(other.x >= 0 && other.x < Edge && other.y >= 0 && other.y < Edge);
        shifts.insert(Edge * other.y + other.x);
      }
    }
    // Of 1200 throws at 4096 places 1038 in the mean, give or take 11.
    EXPECT_GT(shifts.size(), 980u);
    EXPECT_LT(shifts.size(), 1100u);
  }
}

// Of 112 frequencies of white noise the mean is 1, give or take 0.13 (their powers come in equal
// pairs): a tenth is seven times as far off.
TEST(SampleSequence, RotationsAreBlueNoise)
{
  for (const unsigned stream : Streams)
  {
    for (const bool second : { false, true })
    {
      EXPECT_LT(lowPower(ranks(stream, second), 6), 0.1) << stream << " " << second;
    }
  }
  // The measure itself.
  std::vector<double> white = ranks(0, false);
  std::shuffle(white.begin(), white.end(), std::mt19937(3));
  EXPECT_NEAR(lowPower(white, 6), 1.0, 0.6);
}

// Of 4096 numbers that have nothing in common it is 0, give or take 1 / 64; of blue noise less.
TEST(SampleSequence, StreamsHaveNothingInCommon)
{
  std::vector<std::vector<double>> masks;
  for (const unsigned stream : Streams)
  {
    masks.push_back(ranks(stream, false));
    masks.push_back(ranks(stream, true));
  }
  for (std::size_t a = 0; a < masks.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      EXPECT_LT(std::abs(correlation(masks[a], masks[b])), 5.0 / Edge) << a << " " << b;
    }
  }
}

TEST(SampleSequence, HasTheSameBitsEverywhere)
{
  std::uint64_t found = 0xcbf29ce484222325ull;
  for (int i = 0; i < Pixels; ++i)
  {
    const svo::SquarePoint rotation = svo::pixelRotation(i % Edge, i / Edge, 1);
    const svo::SquarePoint sum = svo::sequencePoint(i) + rotation;
    for (const std::uint32_t word : { rotation.u, rotation.v, sum.u, sum.v })
    {
      found = digest(found, word);
    }
  }
  EXPECT_EQ(18056178627021323878ull, found);
}

TEST(SampleDirections, OverTheHemisphereByTheCosine)
{
  for (const glm::vec3& axis : someAxes())
  {
    const svo::Basis basis(axis);
    // Orthonormal.
    EXPECT_NEAR(glm::dot(basis.x, basis.y), 0.0, UnitBound);
    EXPECT_NEAR(glm::dot(basis.x, basis.z), 0.0, UnitBound);
    EXPECT_NEAR(glm::dot(basis.y, basis.z), 0.0, UnitBound);
    expectUnit(basis.x);
    expectUnit(basis.y);
    glm::dvec3 sum(0.0);
    double squares = 0.0, aside = 0.0;
    Evenness rings;
    for (int i = 0; i < 1 << Log; ++i)
    {
      const glm::dvec3 d(svo::cosineDirection(basis, svo::sequencePoint(i)));
      expectUnit(glm::vec3(d));
      const glm::dvec3 local(glm::dot(d, glm::dvec3(basis.x)), glm::dot(d, glm::dvec3(basis.y)),
        glm::dot(d, glm::dvec3(axis)));
      ASSERT_GE(local.z, -UnitBound);
      sum += local;
      squares += local.z * local.z;
      aside += local.x * local.x;
      rings.add(1.0 - local.z * local.z);
    }
    const double n = 1 << Log;
    EXPECT_NEAR(sum.z / n, 2.0 / 3.0, Moment);
    EXPECT_NEAR(sum.x / n, 0.0, Moment);
    EXPECT_NEAR(sum.y / n, 0.0, Moment);
    EXPECT_NEAR(squares / n, 0.5, Moment);
    EXPECT_NEAR(aside / n, 0.25, Moment);
    rings.expect();
  }
}

TEST(SampleDirections, OverABallBySolidAngle)
{
  const glm::dvec3 point(0.3, -0.4, 0.1), centre(2.0, 1.0, 3.0);
  const double distance = glm::distance(point, centre);
  for (const double share : { 0.001, 0.2, 0.9, 0.9999 })
  {
    const svo::Light light = ballAt(centre, share * distance);
    const double cosine = std::sqrt(1.0 - share * share), width = 1.0 - cosine;
    glm::dvec3 sum(0.0);
    Evenness rings;
    eachSample(light, point,
      [&](const glm::vec3& along, float length)
      {
        expectUnit(along);
        const glm::dvec3 d(along), axis = (centre - point) / distance;
        ASSERT_LE(glm::length(glm::cross(d, axis)), share + UnitBound);
        ASSERT_GE(glm::dot(d, axis), cosine - UnitBound);
        // On the ball, on its near side. The length's error where it grazes the ball is a root of
        // rounding; the square of the distance from the centre has no root in it.
        const glm::dvec3 off = point + double(length) * d - centre;
        ASSERT_NEAR(glm::dot(off, off), light.size * light.size, UnitBound * distance * distance);
        ASSERT_LE(length, distance * cosine + std::sqrt(UnitBound) * distance);
        sum += d;
        rings.add((glm::length(d - axis) * glm::length(d - axis)) / (2.0 * width));
      });
    // 1 - cosine is spread evenly from 0 to the ball's rim; sideways nothing is left.
    sum /= 1 << Log;
    const glm::dvec3 axis = (centre - point) / distance;
    EXPECT_NEAR(glm::dot(sum, axis), 1.0 - 0.5 * width, width * Moment + UnitBound);
    EXPECT_LE(glm::length(glm::cross(sum, axis)), share * Moment + UnitBound);
    if (share > 0.1) // else rounding is not small beside the rings
    {
      rings.expect();
    }
  }
}

TEST(SampleDirections, OverADiscAtInfinity)
{
  for (const double angle : { 0.533, 20.0, 90.0, 170.0 })
  {
    const svo::Light light = discAlong({ 1, 2, -2 }, angle);
    const glm::dvec3 axis = -light.direction;
    const double width = std::tan(0.5 * angle * Pi / 180.0);
    Evenness rings;
    glm::dvec3 sum(0.0);
    eachSample(light, { 1e3, 2e3, -1e3 },
      [&](const glm::vec3& along, float length)
      {
        expectUnit(along);
        ASSERT_TRUE(std::isinf(length) && length > 0.0f);
        const glm::dvec3 d(along);
        const double tangent = glm::length(glm::cross(d, axis)) / glm::dot(d, axis);
        ASSERT_GT(glm::dot(d, axis), 0.0);
        ASSERT_LE(tangent / width, 1.0 + UnitBound * (1.0 / width + width));
        rings.add(tangent * tangent / (width * width));
        sum += d / glm::dot(d, axis) - axis;
      });
    EXPECT_LE(glm::length(sum) / width / (1 << Log), Moment + UnitBound * (1.0 / width + width));
    rings.expect();
  }
}

TEST(SampleDirections, InsideOfABallLightComesFromTheHemisphere)
{
  const glm::dvec3 centre(1, 2, 3);
  for (const glm::dvec3& off :
    { glm::dvec3(0), glm::dvec3(0.5, 0, 0), glm::dvec3(0, -0.3, 0.9), glm::dvec3(1, 0, 0) })
  {
    svo::Light light = ballAt(centre, 1.0);
    light.direction = { 0, 0, -1 };
    const double distance = glm::length(off);
    const glm::dvec3 axis = distance > 0.0 ? -off / distance : glm::dvec3(0, 0, 1);
    double sum = 0.0;
    eachSample(light, centre + off,
      [&](const glm::vec3& along, float length)
      {
        expectUnit(along);
        ASSERT_GE(glm::dot(glm::dvec3(along), axis), -UnitBound);
        // The light begins at once; see above about roots.
        ASSERT_LE(std::abs(length), std::sqrt(UnitBound) * distance);
        sum += glm::dot(glm::dvec3(along), axis);
      });
    EXPECT_NEAR(sum / (1 << Log), 0.5, Moment); // of the whole hemisphere, evenly
  }
}

TEST(SampleDirections, AreUnitAndFiniteWhateverTheLight)
{
  const glm::dvec3 far(1e7, -1e7, 1e7);
  std::vector<std::pair<svo::Light, glm::dvec3>> cases;
  for (const double radius : { 1e-300, 1e-30, 1e-7, 1.0, 1e7, 1e30, 1e300 })
  {
    for (const glm::dvec3& point : { glm::dvec3(0), glm::dvec3(0, 0, 1e-12), glm::dvec3(1, 0, 0),
           glm::dvec3(3e-3, 4, -5), far, glm::dvec3(1e20, 0, 0) })
    {
      cases.emplace_back(ballAt({ 0, 0, 0 }, radius), point);
      cases.emplace_back(ballAt(far, radius), point + far);
      cases.emplace_back(ballAt(far, radius), glm::dvec3(0));
    }
  }
  for (const double angle : { 1e-300, 1e-9, 0.533, 90.0, 170.0 })
  {
    cases.emplace_back(discAlong({ 0, 0, -1 }, angle), far);
    cases.emplace_back(discAlong({ 0, 0, 1 }, angle), far);
    cases.emplace_back(discAlong({ 1e-9, 0, 1 }, angle), glm::dvec3(0));
  }
  for (const auto& [light, point] : cases)
  {
    eachSample(
      light, point,
      [&, &light = light](const glm::vec3& along, float length)
      {
        expectUnit(along);
        ASSERT_FALSE(std::isnan(length));
        ASSERT_EQ(light.atInfinity(), std::isinf(length));
      },
      257);
  }
}
