// What VTK's rasteriser would show of a surface, and whether the tracer can show the same.
#ifndef svoSurfaceLook_h
#define svoSurfaceLook_h

#include "svoFloatArrays.h"
#include "svoScene.h"

#include "vtkSmartPointer.h"

#include <vector>

#include <glm/vec3.hpp>

class vtkActor;
class vtkMapper;
class vtkObjectBase;
class vtkPolyData;
class vtkProperty;

namespace svo
{
/// What to do with a visible actor.
enum class Treatment
{
  Trace,
  RasterizeAndCast, // its look cannot be reproduced, its silhouette can
  Rasterize         // not even that (lines, followers, glyphs, clipped surfaces)
};

/// True for classes whose drawing is known to the letter. A subclass may draw anything: followers,
/// axes and sky boxes are actors too.
bool isPlainActor(vtkActor* actor);

/// True for a mapper that should draw a mesh's triangles, but whose class is not known here: it is
/// rasterised, and whoever chose it should hear of that.
bool isUnknownSurfaceMapper(vtkMapper* mapper);

/// What a plain actor, its property and its mapper's settings allow, whatever the mesh.
Treatment treatmentOf(vtkActor* actor);

/// One mesh of an actor: all there is of a plain mapper, one block of a composite one.
struct SurfacePart
{
  vtkPolyData* mesh = nullptr;
  vtkMapper* colors = nullptr; // maps the scalars of `mesh`
  unsigned int block = 0;      // flat index
  bool overridesColor = false; // the block's colour, instead of scalars and the property's colour
  glm::vec3 color{ 1.0f };
  double opacity = 1.0;  // of the property or the block, scalars not considered
  bool textured = false; // the block has a texture of its own
};

/// Material and attributes of a part. False if the look is beyond the tracer. Arrays that the
/// attributes point into are kept in `floats` and `kept`.
bool lookOf(const SurfacePart& part, vtkProperty* property, bool lights, Material& material,
  Attributes& attributes, FloatArrays& floats, std::vector<vtkSmartPointer<vtkObjectBase>>& kept);

/// VTK's offset of coincident polygons for this mapper, as its shaders apply it: the amount added
/// to window depth.
double coincidentDepthOffset(vtkMapper* mapper);
}

#endif
