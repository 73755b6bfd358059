// The look that VTK's rasteriser would give a surface, and whether the tracer can show the same.
#ifndef svoSurfaceLook_h
#define svoSurfaceLook_h

#include "svoFloatArrays.h"
#include "svoKeepAlive.h"
#include "svoLeafMeshes.h"
#include "svoScene.h"

#include <glm/vec3.hpp>

class vtkActor;
class vtkMapper;
class vtkPolyData;
class vtkProperty;
class vtkTexture;

namespace svo
{
/// Why a surface is not traced, or does not cast, for users: the end of a sentence that begins with
/// "it". Nullptr: it is traced, or casts.
using Reason = const char*;

/// Reasons of what shows no surface, or is no data. Arrays, since they are compared by their
/// address.
inline constexpr char ShowsNoPolygons[] = "is shown as wireframe or points";
inline constexpr char HasNoPolygons[] = "has lines or vertices, none of them as tubes or spheres";
inline constexpr char IsTranslucent[] = "is translucent";
inline constexpr char IsDrawnByOpenGL[] = "is drawn by OpenGL";
inline constexpr char HasClippingPlanes[] = "has clipping planes on its mapper";
inline constexpr char MayDrawAnything[] = "is of a class that may draw anything";

/// Whether a visible actor is traced, rasterised or left out of shadows.
struct Treatment
{
  Reason rasterized = nullptr; // its look cannot be reproduced
  Reason castsNone = nullptr;  // nor its silhouette (lines, clipped surfaces)
};

/// True for classes whose drawing is known to the letter. A subclass may draw anything: axes and
/// sky boxes are actors too.
bool isPlainActor(vtkActor* actor);

/// The same of mappers.
bool isPlainMapper(vtkMapper* mapper);

/// True for mappers that draw splats, spheres and sticks (svoSplats.h, svoImpostors.h), which are
/// never traced. No representation changes what they draw.
bool drawsRoundShapes(vtkMapper* mapper);

bool hasCustomShaders(vtkActor* actor);

/// True for opaque surfaces whose mapper's class is not known here: they are rasterised and cast
/// nothing, and the pass gives a message that names the class.
bool isUnknownSurface(vtkActor* actor);

/// The treatment that a plain actor, its property and its mapper's settings allow, for any mesh and
/// any opacity. `castsWhole`: somebody said that all of it casts, what is clipped away, too.
Treatment treatmentOf(vtkActor* actor, bool castsWhole);

/// True if lights change what the actor looks like. What only shines by itself, as the outlines and
/// selections that applications keep in their views do, shows no shadow.
bool showsLights(vtkActor* actor);

/// True if it may draw something beyond its bounds: shapes around points and lines, what shaders
/// make of it, glyphs that are turned, and whatever is not known here.
bool reachesBeyondBounds(vtkActor* actor);

/// The texture that colours an actor; nullptr if there is none.
vtkTexture* textureOf(vtkActor* actor);

/// How a texture, which may be none, lets light through.
enum class TextureAlpha
{
  Opaque,
  CutOut,     // opaque in places, or invisible
  Translucent // VTK draws its surface among translucent ones
};
TextureAlpha alphaOf(vtkTexture* texture);

/// One mesh of an actor: all there is of a plain mapper, one block of a composite one.
struct SurfacePart
{
  vtkPolyData* mesh = nullptr;
  vtkMapper* colors = nullptr; // maps the scalars of `mesh`
  unsigned int block = 0;      // flat index
  bool overridesColor = false; // the block's colour, instead of scalars and the property's colour
  glm::vec3 color{ 1.0f };
  double opacity = 1.0; // of the property or the block, colours of points and cells apart
  vtkTexture* texture = nullptr;
};

/// True if the part's lookup table, or the array of its colours, lets no light through whatever is
/// looked up. False says nothing: then its colours have to be mapped.
bool hasOpaqueTable(const SurfacePart& part);

/// Maps the part's scalars; one colour for all of it becomes the part's own. Colours of points,
/// cells and leaves lie in arrays that are added to `kept`.
Reason mapColors(SurfacePart& part, LeafMeshes& leaves, Attributes& attributes, KeepAlive& kept);

/// Material and normals of a part. Arrays of normals are kept in `floats` and `kept`.
Reason lookOf(const SurfacePart& part, vtkProperty* property, bool lights, Material& material,
  Attributes& attributes, FloatArrays& floats, KeepAlive& kept);

/// The part's points as they are, kept in `kept`; unknown if they are neither floats nor doubles.
MeshPoints pointsOf(vtkPolyData* mesh, KeepAlive& kept);

/// VTK's offset of coincident polygons for this mapper, as its shaders apply it.
DepthOffset coincidentOffset(vtkMapper* mapper);
}

#endif
