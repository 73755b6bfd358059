#include "svoMapsBeside.h"

#include "svoOpenGL.h"
#include "svoOpenGLTracer.h"
#include "svoTracer.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>

namespace svotest
{
MapsBeside MapsBeside::Last;

namespace
{
/// OpenGL's tracer, and beside it the CPU's, whose maps it compares with its own.
class Beside : public svo::Tracer
{
public:
  std::vector<svo::NeededLevels> neededLevels(const svo::Scene& scene, const svo::View& view,
    const svo::FrameSettings& settings) const override
  {
    return this->Drawn->neededLevels(scene, view, settings);
  }
  void render(const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings,
    const svo::ParallelFor& parallelFor) override
  {
    this->Drawn->render(scene, view, settings, parallelFor);
    if (this->Drawn->mapTexture() == 0) // the CPU has made them
    {
      return;
    }
    svo::FrameSettings whole = settings;
    whole.lightCode = false;
    whole.receiverMaps = whole.wholeShadowBuffers = true;
    whole.pixelError = 0.0; // OpenGL stops at no nodes
    this->Traced->render(scene, view, whole, parallelFor);
    this->compare(this->Drawn->shadowMaps(), this->Traced->shadowMaps());
  }
  svo::Frame& frame() override { return this->Drawn->frame(); }
  bool shareShadows(const svo::Scene&, const svo::View&, const svo::FrameSettings&,
    const svo::ParallelFor&, svo::Processes&) override
  {
    return false;
  }
  void divideEdges(const svo::Scene&, const svo::View&, const std::vector<glm::vec2>&,
    const svo::ParallelFor&, svo::Silhouettes&) const override
  {
  }
  const svo::FrameStatistics& statistics() const override { return this->Drawn->statistics(); }
  const svo::LightCode& lightCode() const override { return this->Drawn->lightCode(); }
  const svo::EyeCode& eyeCode() const override { return this->Drawn->eyeCode(); }
  const std::vector<svo::ShadowMap>& shadowMaps() const override
  {
    return this->Drawn->shadowMaps();
  }
  unsigned int mapTexture() const override { return this->Drawn->mapTexture(); }
  void releaseLayers() override {}
  void releaseGraphicsResources() override { this->Drawn->releaseGraphicsResources(); }

private:
  void compare(const std::vector<svo::ShadowMap>& drawn, const std::vector<svo::ShadowMap>& traced)
  {
    MapsBeside::Last = MapsBeside();
    MapsBeside::Last.maps = drawn.size();
    MapsBeside::Last.same = drawn.size() == traced.size() && !drawn.empty();
    if (!MapsBeside::Last.same)
    {
      return;
    }
    const int size = drawn[0].view.width;
    const auto texels = static_cast<std::size_t>(size) * size;
    GLint bound = 0, layers = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &bound);
    glBindTexture(GL_TEXTURE_2D_ARRAY, this->Drawn->mapTexture());
    glGetTexLevelParameteriv(GL_TEXTURE_2D_ARRAY, 0, GL_TEXTURE_DEPTH, &layers);
    std::vector<float> numbers(2 * texels * layers);
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RG, GL_FLOAT, numbers.data());
    glBindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(bound));
    for (std::size_t m = 0; m < drawn.size(); ++m)
    {
      const svo::ShadowMap& map = drawn[m];
      MapsBeside::Last.same = MapsBeside::Last.same && svo::sameRays(map.view, traced[m].view) &&
        map.light == traced[m].light && map.group == traced[m].group;
      MapsBeside::Last.texels += texels;
      for (std::size_t i = 0; i < texels; ++i)
      {
        const int x = static_cast<int>(i % size), y = static_cast<int>(i / size);
        const float* found = map.layer < 0 ? nullptr : &numbers[2 * (texels * map.layer + i)];
        const float expected = traced[m].texels->depthAt(x, y);
        const bool holds = found && found[0] < 1e30f;
        if (holds != std::isfinite(expected))
        {
          ++MapsBeside::Last.edges;
        }
        else if (holds)
        {
          ++MapsBeside::Last.held;
          const double away =
            std::abs(static_cast<double>(found[0]) - expected) / edgeAt(map, expected);
          MapsBeside::Last.worst = std::max(MapsBeside::Last.worst, away);
          MapsBeside::Last.depths += away > MostMoved;
          MapsBeside::Last.shares +=
            map.group > 0 && std::abs(found[1] - traced[m].texels->shareAt(x, y)) > 0.02f;
        }
      }
    }
  }
  static double edgeAt(const svo::ShadowMap& map, double depth)
  {
    return glm::length(map.view.originX + (map.base + depth) * map.view.directionX);
  }
  /// OpenGL rounds corners to a 256th of a texel at least, along and across; times a slope of 16.
  static constexpr double MostMoved = 16.0 / 256;

  std::unique_ptr<svo::Tracer> Drawn = svo::makeOpenGLTracer(svo::makeCPUTracer());
  std::unique_ptr<svo::Tracer> Traced = svo::makeCPUTracer();
};

class PassBeside : public vtkSVORenderPass
{
public:
  static PassBeside* New() { VTK_STANDARD_NEW_BODY(PassBeside); }

protected:
  std::unique_ptr<svo::Tracer> MakeTracer() const override { return std::make_unique<Beside>(); }
};
}

vtkSmartPointer<vtkSVORenderPass> makePassBeside()
{
  return vtkSmartPointer<PassBeside>::New();
}
}
