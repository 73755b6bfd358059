#include "svoSurfaceLook.h"

#include "svoCompositeBlocks.h"
#include "svoGlyphCopies.h"
#include "svoImpostors.h"
#include "svoMeshOctree.h"
#include "svoSplats.h"
#include "svoTubes.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkMapper.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkShaderProperty.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersion.h"

#include <algorithm>
#include <string>
#include <utility>

#include <glm/gtc/type_ptr.hpp>

namespace svo
{
namespace
{
/// What of a plain actor with a plain mapper cannot be reproduced, whatever the mesh.
Reason beyondTracing(vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  vtkSelection* selection = actor->GetMapper()->GetSelection();
  const std::pair<bool, Reason> reasons[] = {
    { property->GetInterpolation() == VTK_PBR, "has a physically based material" },
    { property->GetEdgeVisibility() || property->GetVertexVisibility(),
      "shows its edges or vertices" },
    { property->GetFrontfaceCulling() || property->GetBackfaceCulling(), "has culled faces" },
    { actor->GetBackfaceProperty() != nullptr, "has a backface property" },
    { actor->GetTexture() || property->GetNumberOfTextures() > 0, "has a texture" },
    { hasCustomShaders(actor), "has shaders of its own" },
    { selection && selection->GetNumberOfNodes() > 0, "shows a selection" },
  };
  for (const auto& [holds, reason] : reasons)
  {
    if (holds)
    {
      return reason;
    }
  }
  return actor->HasTranslucentPolygonalGeometry() ? IsTranslucent : nullptr;
}

/// An array that the look borrows.
void keep(vtkDataArray* array, Attributes& attributes, KeepAlive& kept)
{
  // Times are never given twice.
  attributes.version = std::max<std::uint64_t>(attributes.version, array->GetMTime());
  kept.add(array);
}

void normalsOf(
  vtkPolyData* mesh, bool flat, Attributes& attributes, FloatArrays& floats, KeepAlive& kept)
{
  vtkDataArray* normals = flat ? nullptr : mesh->GetPointData()->GetNormals();
  attributes.normalAssociation = Association::Point;
  if (!normals)
  {
    normals = mesh->GetCellData()->GetNormals();
    attributes.normalAssociation = Association::Cell;
  }
  const vtkIdType needed = attributes.normalAssociation == Association::Point
    ? mesh->GetNumberOfPoints()
    : mesh->GetNumberOfCells();
  if (!normals || normals->GetNumberOfComponents() != 3 || normals->GetNumberOfTuples() < needed)
  {
    attributes.normalAssociation = Association::None;
    return;
  }
  attributes.normals = floatsOf(normals, floats, kept);
  keep(normals, attributes, kept);
}

/// True if VTK's mapper looks the mapped colours up by cell.
bool colorsAreOfCells(vtkMapper* mapper, vtkPolyData* mesh)
{
  const int mode = mapper->GetScalarMode();
  return (mode == VTK_SCALAR_MODE_USE_CELL_DATA || mode == VTK_SCALAR_MODE_USE_CELL_FIELD_DATA ||
           mode == VTK_SCALAR_MODE_USE_FIELD_DATA || !mesh->GetPointData()->GetScalars()) &&
    mode != VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
}

/// Scalars that are interpolated before they are mapped.
bool coordinateColors(vtkMapper* mapper, vtkPolyData* mesh, Attributes& attributes, KeepAlive& kept)
{
  auto* coordinates = vtkFloatArray::SafeDownCast(mapper->GetColorCoordinates());
  vtkImageData* texture = mapper->GetColorTextureMap();
  auto* texels =
    texture ? vtkUnsignedCharArray::SafeDownCast(texture->GetPointData()->GetScalars()) : nullptr;
  if (!coordinates || coordinates->GetNumberOfComponents() != 2 || !texels ||
    texels->GetNumberOfComponents() != 4 || texture->GetDimensions()[1] != 2 ||
    coordinates->GetNumberOfTuples() < mesh->GetNumberOfPoints())
  {
    return false;
  }
  attributes.colorAssociation = Association::Point;
  attributes.colorCoordinates = coordinates->GetPointer(0);
  attributes.colorTexture = texels->GetPointer(0);
  attributes.colorTextureSize = texture->GetDimensions()[0];
  keep(coordinates, attributes, kept);
  keep(texels, attributes, kept);
  return true;
}

/// The one colour of tuple `tuple` for all of the part. False if there is no such tuple.
bool colorOfTuple(vtkUnsignedCharArray* colors, vtkIdType tuple, SurfacePart& part)
{
  if (tuple >= colors->GetNumberOfTuples())
  {
    return false;
  }
  const unsigned char* c = colors->GetPointer(4 * tuple);
  part.overridesColor = true;
  part.color = glm::vec3(c[0], c[1], c[2]) / 255.0f;
  part.opacity *= c[3] / 255.0;
  return true;
}

/// Colours of the octree's leaves.
bool leafColors(vtkPolyData* leaves, vtkMapper* mapper, Attributes& attributes, KeepAlive& kept)
{
  vtkUnsignedCharArray* colors = mapper->MapScalars(leaves, 1.0);
  if (!colors || colors->GetNumberOfComponents() != 4 ||
    colors->GetNumberOfTuples() != leaves->GetCellData()->GetScalars()->GetNumberOfTuples())
  {
    return false;
  }
  attributes.colorAssociation = Association::Leaf;
  attributes.colors = colors->GetPointer(0);
  keep(colors, attributes, kept);
  return true;
}

bool scalarColors(SurfacePart& part, LeafMeshes& leaves, Attributes& attributes, KeepAlive& kept)
{
  vtkMapper* mapper = part.colors;
  if (!mapper->GetScalarVisibility() || part.overridesColor)
  {
    return true;
  }
  if (const LeafMesh* ofLeaves = leafMeshOf(part.mesh, mapper, leaves, kept))
  {
    part.colors = ofLeaves->colors;
    return leafColors(ofLeaves->mesh, ofLeaves->colors, attributes, kept);
  }
  vtkUnsignedCharArray* colors = mapper->MapScalars(part.mesh, 1.0);
  if (!colors)
  {
    return !mapper->GetColorCoordinates() || coordinateColors(mapper, part.mesh, attributes, kept);
  }
  if (colors->GetNumberOfComponents() != 4 || colors->GetNumberOfTuples() == 0)
  {
    return false;
  }
  if (mapper->GetScalarMode() == VTK_SCALAR_MODE_USE_FIELD_DATA &&
    mapper->GetFieldDataTupleId() > -1)
  {
    return colorOfTuple(colors, mapper->GetFieldDataTupleId(), part);
  }
  const bool cells = colorsAreOfCells(mapper, part.mesh);
  if (colors->GetNumberOfTuples() <
    (cells ? part.mesh->GetNumberOfCells() : part.mesh->GetNumberOfPoints()))
  {
    return false;
  }
  attributes.colorAssociation = cells ? Association::Cell : Association::Point;
  attributes.colors = colors->GetPointer(0);
  keep(colors, attributes, kept);
  return true;
}
}

bool drawsRoundShapes(vtkMapper* mapper)
{
  return isSplatMapper(mapper) || isImpostorMapper(mapper);
}

bool isPlainMapper(vtkMapper* mapper)
{
  const std::string name = mapper->GetClassName();
  return name == "vtkOpenGLPolyDataMapper" || name == "vtkDataSetMapper" ||
    isCompositeMapper(mapper) || isGlyphMapper(mapper) || drawsRoundShapes(mapper);
}

bool hasCustomShaders(vtkActor* actor)
{
  // GetShaderProperty() makes one where there is none. Its time is what tells a mapper that several
  // actors share to build its shader anew when the next of them is drawn.
  struct Known : vtkProp
  {
    static vtkShaderProperty* of(vtkProp* prop) { return prop->*&Known::ShaderProperty; }
  };
  vtkShaderProperty* shaders = Known::of(actor);
  return shaders &&
    (shaders->GetNumberOfShaderReplacements() > 0 || shaders->HasVertexShaderCode() ||
      shaders->HasFragmentShaderCode() || shaders->HasGeometryShaderCode());
}

bool isPlainActor(vtkActor* actor)
{
  const std::string name = actor->GetClassName();
  return name == "vtkOpenGLActor" || name == "vtkFollower" || name == "vtkLODActor" ||
    name == "vtkQuadricLODActor" || name == "vtkPVLODActor";
}

bool showsLights(vtkActor* actor)
{
  if (actor->GetMapper() && isSplatMapper(actor->GetMapper()))
  {
    return false; // whatever the property says
  }
  const auto reflects = [&](vtkProperty* property)
  {
    // Physically based surfaces reflect light whatever their coefficients are.
    return property && property->GetLighting() &&
      (property->GetInterpolation() == VTK_PBR || property->GetDiffuse() != 0.0 ||
        property->GetSpecular() != 0.0 || hasCustomShaders(actor));
  };
  return reflects(actor->GetProperty()) || reflects(actor->GetBackfaceProperty());
}

bool reachesBeyondBounds(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  const RoundLook round = roundLookOf(actor->GetProperty());
  // A follower turns with the camera of whoever draws it.
  return !isPlainActor(actor) || actor->IsA("vtkFollower") || !isPlainMapper(mapper) ||
    isGlyphMapper(mapper) || drawsRoundShapes(mapper) || round.any() || round.edges ||
    hasCustomShaders(actor);
}

bool isUnknownSurface(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  vtkProperty* property = actor->GetProperty();
  return !isPlainMapper(mapper) && property->GetRepresentation() == VTK_SURFACE &&
    property->GetOpacity() >= 1.0 &&
    // What these draw (points and lines, labels) has no surface.
    !mapper->IsA("vtkGraphMapper") && !mapper->IsA("vtkLabeledContourMapper");
}

Treatment treatmentOf(vtkActor* actor, bool castsWhole)
{
  vtkMapper* mapper = actor->GetMapper();
  vtkPlaneCollection* planes = mapper->GetClippingPlanes();
  Treatment treatment;
  if (!isPlainMapper(mapper))
  {
    treatment.castsNone = "has a mapper of a class that is not known here";
  }
  else if (actor->GetProperty()->GetRepresentation() != VTK_SURFACE && !drawsRoundShapes(mapper))
  {
    treatment.rasterized = ShowsNoPolygons;
    const bool round = !isGlyphMapper(mapper) && roundLookOf(actor->GetProperty()).any();
    treatment.castsNone = round ? nullptr : treatment.rasterized;
  }
  if (!treatment.castsNone && planes && planes->GetNumberOfItems() > 0)
  {
    treatment.rasterized = treatment.rasterized ? treatment.rasterized : HasClippingPlanes;
    treatment.castsNone = castsWhole ? nullptr : HasClippingPlanes;
  }
  auto* streamed = vtkPolyDataMapper::SafeDownCast(mapper);
  if (!treatment.castsNone && streamed && streamed->GetNumberOfSubPieces() > 1)
  {
    treatment.castsNone = "is drawn piece by piece by its mapper";
  }
  if (!treatment.rasterized)
  {
    treatment.rasterized = treatment.castsNone ? treatment.castsNone : beyondTracing(actor);
  }
  return treatment;
}

vtkTexture* textureOf(vtkActor* actor)
{
  return actor->GetTexture() ? actor->GetTexture() : actor->GetProperty()->GetTexture("albedoTex");
}

TextureAlpha alphaOf(vtkTexture* texture)
{
  if (!texture)
  {
    return TextureAlpha::Opaque;
  }
  if (texture->IsTranslucent())
  {
    return TextureAlpha::Translucent;
  }
  vtkImageData* image = texture->GetInput();
  vtkDataArray* texels = image ? image->GetPointData()->GetScalars() : nullptr;
  const int alpha = texels ? texels->GetNumberOfComponents() - 1 : 0;
  // Of all texels VTK has seen that they are opaque or invisible.
  return alpha % 2 == 1 && texels->GetNumberOfTuples() > 0 && texels->GetRange(alpha)[0] <= 0.0
    ? TextureAlpha::CutOut
    : TextureAlpha::Opaque;
}

bool hasOpaqueTable(const SurfacePart& part)
{
  // Of transfer functions VTK does not ask for the colour of NaN.
  return part.overridesColor || !part.colors->GetScalarVisibility() ||
    (vtkLookupTable::SafeDownCast(part.colors->GetLookupTable()) &&
      !part.colors->HasTranslucentPolygonalGeometry());
}

Reason mapColors(SurfacePart& part, LeafMeshes& leaves, Attributes& attributes, KeepAlive& kept)
{
  if (!scalarColors(part, leaves, attributes, kept))
  {
    return "has colours that do not belong to its cells or points";
  }
  const bool ofMesh = attributes.colorCoordinates ||
    (attributes.colors && attributes.colorAssociation != Association::Leaf);
  return ofMesh && carriesPlanes(part.mesh)
    ? "is coloured by an array that the voxels of its octree have no values of"
    : nullptr;
}

Reason lookOf(const SurfacePart& part, vtkProperty* property, bool lights, Material& material,
  Attributes& attributes, FloatArrays& floats, KeepAlive& kept)
{
  vtkPolyData* mesh = part.mesh;
  if (part.texture)
  {
    return "has a texture";
  }
  if (mesh->GetNumberOfVerts() > 0 || mesh->GetNumberOfLines() > 0)
  {
    return "has lines or vertices";
  }
  material.ambientColor = glm::make_vec3(property->GetAmbientColor());
  material.diffuseColor = glm::make_vec3(property->GetDiffuseColor());
  material.specularColor = glm::make_vec3(property->GetSpecularColor());
  material.ambient = static_cast<float>(property->GetAmbient());
  material.diffuse = static_cast<float>(property->GetDiffuse());
  material.specular = static_cast<float>(property->GetSpecular());
  material.specularPower = static_cast<float>(property->GetSpecularPower());
  material.lighting = lights && property->GetLighting();
  if (part.overridesColor)
  {
    material.ambientColor = material.diffuseColor = part.color;
  }
  const bool flat = property->GetInterpolation() == VTK_FLAT;
  normalsOf(mesh, flat, attributes, floats, kept);
  material.flatPlanes = flat;
  material.flat = attributes.normalAssociation == Association::None;
  return nullptr;
}

MeshPoints pointsOf(vtkPolyData* mesh, KeepAlive& kept)
{
  MeshPoints points;
  vtkDataArray* array = mesh->GetPoints() ? mesh->GetPoints()->GetData() : nullptr;
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    points.floats = floats->GetPointer(0);
  }
  else if (auto* doubles = vtkDoubleArray::FastDownCast(array))
  {
    points.doubles = doubles->GetPointer(0);
  }
  if (points)
  {
    points.count = static_cast<std::size_t>(array->GetNumberOfTuples());
    kept.add(array);
  }
  return points;
}

DepthOffset coincidentOffset(vtkMapper* mapper)
{
  // VTK's fragment shader adds the units over 65000, and up to version 9.1 ignores the factor.
  constexpr double Unit = 1.0 / 65000.0;
  switch (vtkMapper::GetResolveCoincidentTopology())
  {
    case VTK_RESOLVE_SHIFT_ZBUFFER:
      return { static_cast<float>(4.0 * vtkMapper::GetResolveCoincidentTopologyZShift() * Unit),
        0.0f };
    case VTK_RESOLVE_POLYGON_OFFSET:
    {
      double factor, units;
      mapper->GetCoincidentTopologyPolygonOffsetParameters(factor, units);
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
      factor = 0.0;
#endif
      return { static_cast<float>(units * Unit), static_cast<float>(factor) };
    }
    default:
      return {};
  }
}
}
