// A scene with all that samples of light find: the stage of the tests of soft frames.
#ifndef svoSoftStage_h
#define svoSoftStage_h

#include "svoSoftScenes.h"

#include <cmath>
#include <vector>

namespace svotest
{
/// A ball and a ring over a ground, small ones around, some of which let light through, some of
/// which are smooth; under a ball of light, a disc and a spot, and ambient occlusion.
struct Stage
{
  svo::Scene scene = ballRingAndGround();
  svo::View view = lookAt({ 3, -6, 4 }, 72, 56);
  svo::FrameSettings settings = sampled(5);

  Stage()
  {
    static const Mesh mesh = sphere(10, 14);
    static const svo::Octree octree = makeOctree(mesh, 5);
    static const std::vector<float> normals = radialNormals(mesh);
    for (int i = 0; i < 24; ++i)
    {
      const double angle = 2.0 * Pi * i / 24;
      const glm::dmat4 place =
        movedTo(2.2 * std::cos(angle), 2.2 * std::sin(angle), 0.3 + 0.02 * i);
      svo::Instance instance = instanceOf(octree, 10 + i, glm::scale(place, glm::dvec3(0.25)));
      instance.opacity = i % 6 == 0 ? 0.5f : 1.0f;
      if (i % 2)
      {
        instance.body.own().attributes.normals = normals.data();
        instance.body.own().attributes.normalAssociation = svo::Association::Point;
      }
      this->scene.instances.push_back(instance);
    }
    this->scene.lights.push_back(lightOf(svo::Light::Kind::Spot, { -2, -2, 4 }));
    this->scene.lights[0].size = 0.7;
    this->scene.lights[1].size = 8.0;
    this->scene.lights[2].size = 0.4;
    this->scene.lights[2].id = 79;
    this->settings.ambientOcclusion = true;
    this->settings.ambientOcclusionStrength = 0.8;
    this->settings.filterLightSamples = true;
  }
};

inline svo::Frame shown(const Stage& stage)
{
  return rendered(stage.scene, stage.view, stage.settings);
}
}

#endif
