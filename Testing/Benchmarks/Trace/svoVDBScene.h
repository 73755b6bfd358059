// The voxels of an octree's last level in NanoVDB, where it was found (SVO_NANOVDB), and rays that
// are marched to the first of them.
#ifndef svoVDBScene_h
#define svoVDBScene_h

#include "svoOctree.h"
#include "svoRay.h"

#include <vector>

#ifdef SVO_NANOVDB
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/Ray.h>
#endif

namespace svobench
{
#ifdef SVO_NANOVDB
class VDBScene
{
public:
  explicit VDBScene(const svo::Octree& octree)
    : RootCells(static_cast<float>(1u << (2 * octree.header().depthCount)))
  {
    nanovdb::GridBuilder<float> builder(0.0f);
    auto voxels = builder.getAccessor();
    fill(octree, glm::ivec3(0), 0, voxels);
    this->Grid = builder.getHandle<>();
  }

  bool available() const { return true; }
  std::size_t bytes() const { return this->Grid.size(); }

  /// Rays in octree coordinates. Of what is met t is told, and a primitive that means nothing.
  void trace(const std::vector<svo::RayBlock>& blocks, std::vector<svo::HitBlock>& hits) const
  {
    using Ray = nanovdb::Ray<float>;
    const auto* grid = this->Grid.grid<float>();
    auto voxels = grid->getAccessor();
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      const svo::RayBlock& block = blocks[b];
      for (int i = 0; i < svo::RayBlock::Size; ++i)
      {
        const nanovdb::Vec3f origin((block.originX[i] - 1.0f) * this->RootCells,
          (block.originY[i] - 1.0f) * this->RootCells, (block.originZ[i] - 1.0f) * this->RootCells);
        const nanovdb::Vec3f direction(block.directionX[i] * this->RootCells,
          block.directionY[i] * this->RootCells, block.directionZ[i] * this->RootCells);
        Ray ray(origin, direction, block.tMin[i], block.tMax[i]);
        const bool hit = march(ray, voxels, hits[b].t[i]);
        hits[b].primitive[i] = hit ? 0 : svo::NoPrimitive;
      }
    }
  }

private:
  template <class Voxels>
  static void fill(const svo::Octree& octree, glm::ivec3 cell, int level, Voxels& voxels)
  {
    if (!octree.occupied(cell, level))
    {
      return;
    }
    if (level == octree.level())
    {
      voxels.setValue(nanovdb::Coord(cell.x, cell.y, cell.z), 1.0f);
      return;
    }
    for (int i = 0; i < 8; ++i)
    {
      fill(octree, 2 * cell + glm::ivec3(i & 1, i >> 1 & 1, i >> 2), level + 1, voxels);
    }
  }

  /// As nanovdb::ZeroCrossing() does it, but for the first active voxel.
  template <class Ray, class Voxels>
  bool march(Ray& ray, Voxels& voxels, float& t) const
  {
    if (!ray.clip(voxels.root().bbox()))
    {
      return false;
    }
    // A little beyond the border that was met, so that the cell behind it is looked at: rays begin
    // within two cubes, and origin + t direction is rounded three times.
    const float beyond = 0x1p-20f * this->RootCells / ray.dir().length();
    nanovdb::Coord cell = nanovdb::RoundDown<nanovdb::Coord>(ray(ray.t0() + beyond));
    nanovdb::HDDA<Ray, nanovdb::Coord> walk(ray, static_cast<int>(voxels.getDim(cell, ray)));
    do
    {
      cell = nanovdb::RoundDown<nanovdb::Coord>(ray(walk.time() + beyond));
      walk.update(ray, static_cast<int>(voxels.getDim(cell, ray)));
      if (walk.dim() == 1 && voxels.isActive(cell))
      {
        t = walk.time();
        return true;
      }
    } while (walk.step());
    return false;
  }

  float RootCells; // voxels along the edge of the octree's cube
  nanovdb::GridHandle<> Grid;
};
#else
class VDBScene
{
public:
  explicit VDBScene(const svo::Octree&) {}
  bool available() const { return false; }
  void trace(const std::vector<svo::RayBlock>&, std::vector<svo::HitBlock>&) const {}
};
#endif
}

#endif
