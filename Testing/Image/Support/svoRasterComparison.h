// The traced picture of a mesh against VTK's own raster of it, at level 10, pixel by pixel.
#ifndef svoRasterComparison_h
#define svoRasterComparison_h

#include "svoTestPicture.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>

namespace svotest
{
/// About 2 wide and around the origin, where the camera and the lights expect it; with point
/// normals, as Gouraud shading interpolates them.
struct NamedMesh
{
  std::string name;
  vtkSmartPointer<vtkPolyData> data;
};

/**
 * Depth of triangle leaves within 0.05 voxel on 99.9 % of the pixels that both cover, of plane
 * leaves within 2 voxels on 99 %. The window is large: a rasteriser moves vertices to the next
 * 1/256 of a pixel, which on steep faces is a depth.
 *
 * `silhouettesToo`: whether plane leaves are judged on all pixels or on those at least 2 pixels
 * from silhouettes. A plane may reach a voxel beyond the surface, so where one part of a mesh ends
 * in front of another, depth is off by the distance of the two; figures of both kinds are printed.
 */
void compareDepthWithRaster(const NamedMesh& mesh, bool silhouettesToo, Checks& checks);

/**
 * Colours without shadows of every kind of shading, scalars and light: a mean absolute difference
 * of at most 2 grey levels of 255 and 8 at p99, on pixels at least 2 pixels from silhouettes.
 */
void compareColorsWithRaster(const NamedMesh& mesh, Checks& checks);
}

#endif
