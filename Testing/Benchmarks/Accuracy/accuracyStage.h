// A scene that is drawn in several ways: by the tracer, by VTK, and by exact rays.
#ifndef accuracyStage_h
#define accuracyStage_h

#include "accuracyMesh.h"

#include "svoOctree.h"
#include "svoScene.h"
#include "svoView.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace accuracy
{
/// A mesh as every method needs it; objects share it.
struct Shape
{
  explicit Shape(const Mesh& mesh)
    : mesh(mesh)
    , data(toPolyData(mesh))
    , closed(isClosed(mesh))
  {
  }
  Mesh mesh;
  vtkSmartPointer<vtkPolyData> data;
  bool closed;
};

struct Object
{
  std::shared_ptr<const Shape> shape;
  glm::dmat4 toWorld{ 1.0 };
};

/// A perspective camera; the clipping planes should be tight, for the depth of a picture has 24
/// bits between them.
struct Camera
{
  glm::dvec3 eye{ 0.0, -1.0, 0.0 };
  glm::dvec3 focus{ 0.0 };
  double angle = 30.0; // vertical, degrees
  double near = 0.1, far = 10.0;
  int width = 512, height = 512;

  svo::View view() const;
};

struct Stage
{
  std::string name;
  std::vector<Object> objects;
  std::vector<svo::Light> lights;
  Camera camera;
  int subject = 0; // the object whose voxels errors are measured in
};

/// Turns the camera's clipping planes in on the objects' corners.
void fitClippingPlanes(Stage& stage);
/// Moves the camera along its axis until the object's points just fill the window.
void fillWindow(Stage& stage, const Object& object);

/// Octrees by mesh and level, each built once, with what that took.
class OctreeShelf
{
public:
  struct Entry
  {
    svo::Octree octree;
    double buildSeconds = 0.0; // processor time
  };
  /// Throws std::runtime_error if there is no memory for it.
  const Entry& get(const Shape& shape, int level);
  /// Forgets octrees of other levels.
  void keepLevel(int level);

private:
  std::map<std::pair<const Shape*, int>, Entry> Entries;
};

/// The tracer's scene: white, matt, flat facets, no ambient light.
svo::Scene sceneOf(const Stage& stage, OctreeShelf& shelf, int level, svo::LeafGeometry leaves);

/// Processor time of all threads, seconds.
double processorSeconds();
}

#endif
