// Digests of frames: of the same commit's on any machine, and of two commits' that should draw the
// same, each line is the same; `--every 7` draws every seventh only. With `--write <file>` the
// frames go to a file, with `--against <file>` those of a file are compared with. The paper's
// scenes, every leaf geometry, technique, level of detail and look; colour, depth, instance,
// primitive, normals, shadow maps and silhouettes of each.
#include "experiments.h"
#include "framePictures.h"
#include "meshes.h"
#include "objects.h"
#include "scenes.h"

#include "svoCPUTracer.h"
#include "svoMeshOctree.h"
#include "svoSMPParallel.h"
#include "svoScene.h"
#include "svoSilhouettes.h"
#include "svoView.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

namespace
{
/// FNV-1a, 64 bits.
class Digest
{
public:
  template <class T>
  Digest& add(const T* values, std::size_t count)
  {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values);
    for (std::size_t i = 0; i < count * sizeof(T); ++i)
    {
      this->Value = (this->Value ^ bytes[i]) * 1099511628211ull;
    }
    return *this;
  }
  template <class T>
  Digest& add(const std::vector<T>& values)
  {
    return this->add(values.data(), values.size());
  }
  unsigned long long value() const { return this->Value; }

private:
  std::uint64_t Value = 14695981039346656037ull;
};

/// Arrays of a mesh that say nothing true, but all looks can be made of them.
struct Arrays
{
  std::vector<float> pointNormals, cellNormals, coordinates;
  std::vector<unsigned char> pointColors, cellColors;
};

std::vector<float> someNormals(std::size_t count, const std::vector<glm::dvec3>& along)
{
  std::vector<float> normals;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 bent(0.1 * (i % 7), 0.1 * (i % 5), 0.1 * (i % 3));
    const glm::vec3 normal(glm::normalize(along[i % along.size()] + bent));
    normals.insert(normals.end(), { normal.x, normal.y, normal.z });
  }
  return normals;
}

std::vector<unsigned char> someColors(std::size_t count)
{
  std::vector<unsigned char> colors(4 * count, 255);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      colors[4 * i + c] = static_cast<unsigned char>(40 + 31 * (i + 5 * c) % 200);
    }
  }
  return colors;
}

Arrays arraysOf(vtkPolyData* mesh)
{
  const std::size_t points = mesh->GetNumberOfPoints(), cells = mesh->GetNumberOfCells();
  const glm::dvec3 center(mesh->GetCenter()[0], mesh->GetCenter()[1], mesh->GetCenter()[2]);
  std::vector<glm::dvec3> outwards(1, glm::dvec3(0, 0, 1));
  outwards.resize(points);
  for (std::size_t i = 0; i < points; ++i)
  {
    const double* x = mesh->GetPoint(static_cast<vtkIdType>(i));
    outwards[i] = glm::normalize(glm::dvec3(x[0], x[1], x[2]) - center + glm::dvec3(1e-6));
  }
  Arrays arrays;
  arrays.pointNormals = someNormals(points, outwards);
  arrays.cellNormals = someNormals(cells, { glm::dvec3(0, 0, 1) });
  arrays.pointColors = someColors(points);
  arrays.cellColors = someColors(cells);
  for (std::size_t i = 0; i < points; ++i)
  {
    arrays.coordinates.push_back(0.05f * (i % 19));
    arrays.coordinates.push_back(i % 23 ? 0.25f : 0.75f);
  }
  return arrays;
}

const std::vector<unsigned char> Table = someColors(16);

/// Several looks, one after the other.
void giveLook(svo::Instance& instance, const Arrays& arrays, int look)
{
  svo::Attributes& attributes = instance.body.own().attributes;
  instance.material = svo::Material();
  attributes = svo::Attributes();
  instance.material.specular = look % 2 ? 0.4f : 0.0f;
  instance.material.specularPower = 12.5f;
  instance.material.flat = look % 6 == 0;
  if (look % 3 == 1)
  {
    attributes.normals = arrays.pointNormals.data();
    attributes.normalAssociation = svo::Association::Point;
  }
  else if (look % 3 == 2)
  {
    attributes.normals = arrays.cellNormals.data();
    attributes.normalAssociation = svo::Association::Cell;
  }
  if (look % 4 == 1)
  {
    attributes.colors = arrays.pointColors.data();
    attributes.colorAssociation = svo::Association::Point;
  }
  else if (look % 4 == 2)
  {
    attributes.colors = arrays.cellColors.data();
    attributes.colorAssociation = svo::Association::Cell;
  }
  else if (look % 4 == 3)
  {
    attributes.colorCoordinates = arrays.coordinates.data();
    attributes.colorTexture = Table.data();
    attributes.colorTextureSize = 8;
  }
}

struct Lamp
{
  const char* name;
  std::vector<svo::Light> lights;
};

std::vector<Lamp> lamps(const double* at)
{
  svo::Light point;
  point.kind = svo::Light::Kind::Point;
  point.position = { at[0], at[1], at[2] };
  point.direction = -glm::normalize(point.position);
  point.id = 1;
  svo::Light spot = point;
  spot.kind = svo::Light::Kind::Spot;
  spot.coneAngle = 35.0;
  spot.exponent = 2.0;
  spot.attenuation = { 1.0f, 0.02f, 0.01f };
  svo::Light sun = point;
  sun.kind = svo::Light::Kind::Directional;
  svo::Light weak = sun;
  weak.direction = glm::normalize(glm::dvec3(0.5, 1.0, -0.4));
  weak.color = { 0.4f, 0.3f, 0.2f };
  weak.id = 2;
  svo::Light head = sun;
  head.headlight = true;
  head.castShadow = false;
  head.id = 3;
  return { { "point", { point } }, { "spot", { spot } }, { "sun", { sun } },
    { "three", { sun, weak, head } } };
}

struct Variant
{
  std::string name;
  svo::FrameSettings settings;
};

std::vector<Variant> ways()
{
  using Technique = svo::ShadowTechnique;
  std::vector<Variant> all;
  const auto add = [&](const char* name, Technique technique) -> svo::FrameSettings&
  {
    all.push_back({ name, svo::FrameSettings() });
    all.back().settings.shadowTechnique = technique;
    all.back().settings.shadowResolution = 512;
    return all.back().settings;
  };
  add("none", Technique::None);
  add("buffer", Technique::Buffer).writeNormals = true;
  add("rays", Technique::Rays);
  add("plain bias", Technique::Buffer).automaticBias = false;
  add("bias", Technique::Buffer).bias = 1.5;
  add("filtered", Technique::Buffer).filterShadows = true;
  svo::FrameSettings& smooth = add("anti-aliased", Technique::Buffer);
  smooth.antiAliasing = smooth.filterShadows = smooth.writeLight = true;
  add("anti-aliased rays", Technique::Rays).antiAliasing = true;
  svo::FrameSettings& whole = add("whole", Technique::Buffer);
  whole.wholeShadowBuffers = true;
  whole.shadowIntensity = 0.6;
  return all;
}

void print(const std::string& name, svo::Tracer& tracer, const svo::Scene& scene,
  const svo::View& view, const svo::FrameSettings& settings, FramePictures& pictures)
{
  tracer.render(scene, view, settings, svo::smpParallelFor());
  const svo::Frame& frame = tracer.frame();
  pictures.take(name, frame);
  if (pictures.compares())
  {
    return;
  }
  Digest maps, parts;
  for (const svo::ShadowMap& map : tracer.shadowMaps())
  {
    std::vector<float> depths;
    for (int i = 0; i < map.view.width * map.view.height; ++i)
    {
      depths.push_back(map.texels->depthAt(i % map.view.width, i / map.view.width));
    }
    maps.add(depths).add(&map.base, 1).add(&map.worldBias, 1).add(&map.view.worldToView, 1);
  }
  const std::vector<glm::vec2> samples = { { 0.375f, 0.125f }, { 0.875f, 0.375f },
    { 0.125f, 0.625f }, { 0.625f, 0.875f } };
  svo::Silhouettes silhouettes;
  tracer.divideEdges(scene, view, samples, svo::smpParallelFor(), silhouettes);
  for (const svo::PixelPart& part : silhouettes.parts)
  {
    parts.add(&part.samples, 1).add(&part.x, 1).add(&part.y, 1).add(&part.depth, 1);
    parts.add(part.color, 4);
  }
  std::printf("%s: %016llx %016llx %016llx %016llx %016llx %016llx %016llx %016llx\n", name.c_str(),
    Digest().add(frame.color).value(), Digest().add(frame.depth).value(),
    Digest().add(frame.instance).value(), Digest().add(frame.primitive).value(),
    Digest().add(frame.normals).value(), Digest().add(frame.light).value(), maps.value(),
    parts.value());
}

struct Program
{
  paper::Objects objects;
  std::map<vtkPolyData*, Arrays> arrays;
  std::map<std::pair<vtkPolyData*, int>, svo::Octree> octrees;

  svo::Scene sceneOf(paper::Scene& paperScene, int level, svo::LeafGeometry leaves, int look);
  void run(const paper::Experiment& experiment);

  FramePictures pictures;
  int every = 1; // frames from one that is drawn to the next
};

svo::Scene Program::sceneOf(paper::Scene& paperScene, int level, svo::LeafGeometry leaves, int look)
{
  svo::Scene scene;
  vtkActorCollection* actors = paperScene.renderer()->GetActors();
  actors->InitTraversal();
  while (vtkActor* actor = actors->GetNextActor())
  {
    auto* mesh = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
    svo::Octree& octree = this->octrees[{ mesh, level }];
    if (!octree)
    {
      svo::MeshOctreeOptions options;
      options.level = level;
      std::string message;
      svo::buildMeshOctree(mesh, options, octree, message);
      this->arrays[mesh] = arraysOf(mesh);
    }
    svo::Instance instance;
    instance.body.own().octree = octree;
    instance.body.own().leafGeometry = leaves;
    instance.id = scene.instances.size() + 1;
    instance.localToWorld = glm::transpose(glm::make_mat4(actor->GetMatrix()->GetData()));
    giveLook(instance, this->arrays[mesh], look++);
    scene.instances.push_back(instance);
  }
  return scene;
}

void Program::run(const paper::Experiment& experiment)
{
  using Leaf = svo::LeafGeometry;
  paper::Scene paperScene(experiment, this->objects);
  const std::pair<const char*, Leaf> leaves[] = { { "automatic", Leaf::Automatic },
    { "voxel", Leaf::Voxel }, { "plane", Leaf::Plane }, { "triangle", Leaf::Triangle } };
  svo::View view;
  const paper::Viewpoint& from = experiment.views.front();
  const glm::dvec3 eye(from.position[0], from.position[1], from.position[2]);
  const glm::dvec3 focus(from.focalPoint[0], from.focalPoint[1], from.focalPoint[2]);
  svo::makeView(glm::lookAt(eye, focus, glm::dvec3(0, 0, 1)),
    glm::perspective(glm::radians(from.viewAngle), 16.0 / 9.0, 0.05, 60.0), 320, 180, view);
  int turn = 0;
  for (const int level : { 5, 9 })
  {
    for (const auto& [leafName, leaf] : leaves)
    {
      for (const Lamp& lamp : lamps(experiment.light))
      {
        for (const double pixelError : { 1.0, 0.0, 4.0 })
        {
          svo::CPUTracer tracer; // keeps layers from way to way
          for (const Variant& way : ways())
          {
            if (++turn % this->every != 0)
            {
              continue;
            }
            svo::Scene scene = this->sceneOf(paperScene, level, leaf, turn);
            scene.lights = lamp.lights;
            svo::FrameSettings settings = way.settings;
            settings.pixelError = pixelError;
            print(experiment.name + ", level " + std::to_string(level) + ", " + leafName + ", " +
                lamp.name + ", error " + std::to_string(static_cast<int>(pixelError)) + ", " +
                way.name,
              tracer, scene, view, settings, this->pictures);
          }
        }
      }
    }
  }
}
}

int main(int argc, char* argv[])
{
  paper::Meshes meshes;
  std::string error;
  Program program;
  int next = 1;
  bool good = true;
  for (; argc > next + 1 && argv[next][0] == '-'; next += 2)
  {
    const std::string option = argv[next];
    const char* value = argv[next + 1];
    program.every = option == "--every" ? std::max(std::atoi(value), 1) : program.every;
    good = good &&
      (option == "--write"        ? program.pictures.write(value)
          : option == "--against" ? program.pictures.compareWith(value)
                                  : option == "--every");
  }
  if (good && argc == next)
  {
    meshes = paper::standInMeshes();
  }
  else if (!good || argc != next + 2 ||
    !paper::readMeshes(argv[next], argv[next + 1], meshes, error))
  {
    std::fprintf(stderr,
      "%s\nFrameDigests [--every <frames>] [--write <file>] [--against <file>] "
      "[mesh of A, animated mesh of B]\n",
      error.c_str());
    return 1;
  }
  meshes.b.resize(1);
  if (!paper::buildOctrees(
        meshes, 1, [](double) {}, program.objects, error))
  {
    std::fprintf(stderr, "%s\n", error.c_str());
    return 1;
  }
  for (const paper::Experiment& experiment : paper::experiments())
  {
    program.run(experiment);
  }
  if (program.pictures.compares())
  {
    program.pictures.report();
  }
  return 0;
}
