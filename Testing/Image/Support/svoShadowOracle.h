// What exact rays through the meshes say about each pixel: the judge of the shadows in a picture.
#ifndef svoShadowOracle_h
#define svoShadowOracle_h

#include "svoTestPicture.h"

#include "vtkSmartPointer.h"

#include <array>
#include <vector>

class vtkActor;
class vtkLight;
class vtkMatrix4x4;
class vtkPolyData;
class vtkRenderer;
class vtkStaticCellLocator;

namespace svotest
{
/// How a shadowed picture stands against the judgement. Only pixels that are clear count: no edge
/// and no shadow edge within the margin, no light that grazes the surface.
struct ShadowScore
{
  std::size_t lit = 0;       // every light reaches them
  std::size_t litWrong = 0;  // ... and yet they differ from the unshadowed picture
  std::size_t dark = 0;      // some light that should reach them does not
  std::size_t darkWrong = 0; // ... and yet they are not darker
  double wrongShare() const;
};

class ShadowOracle
{
public:
  /// Solids are added one by one; a mesh is taken with the matrix it has now.
  void add(vtkActor* actor, bool casts = true, bool receives = true);
  void add(vtkPolyData* mesh, vtkMatrix4x4* matrix, bool casts = true, bool receives = true);
  /// Lights that cast, as they stand now. Headlights and camera lights: after a render.
  void add(vtkLight* light);

  /// Compares two pictures of the renderer's window, with and without shadows. `margin` is in
  /// pixels: the shadow's edge may be wrong by so much.
  ShadowScore judge(vtkRenderer* renderer, const Picture& shadowed, const Picture& unshadowed,
    int margin = 3) const;

private:
  struct Solid
  {
    vtkSmartPointer<vtkPolyData> mesh;
    vtkSmartPointer<vtkStaticCellLocator> locator;
    vtkSmartPointer<vtkMatrix4x4> toWorld;
    vtkSmartPointer<vtkMatrix4x4> toLocal;
    bool casts;
    bool receives;
  };
  struct Lamp
  {
    bool directional;
    std::array<double, 3> position;
    std::array<double, 3> direction; // unit, the way the light shines
    double coneCosine;               // -1: no cone
  };
  struct Hit
  {
    int solid = -1;
    double t = 2.0;
    std::array<double, 3> point{};
    std::array<double, 3> normal{}; // unit, towards the ray's origin
  };
  enum class Verdict
  {
    Unclear,
    Background,
    Lit,
    Dark
  };

  Hit firstHit(const double from[3], const double to[3]) const;
  bool blocked(const double from[3], const double to[3]) const;
  Verdict verdict(const double from[3], const double to[3], double sceneSize, int& solid) const;

  std::vector<Solid> solids;
  std::vector<Lamp> lamps;
};

/// The usual expectation: enough clear pixels of both kinds, at most `share` of them wrong.
void expectShadows(
  Checks& checks, const ShadowScore& score, const char* scene, double share = 0.002);
}

#endif
