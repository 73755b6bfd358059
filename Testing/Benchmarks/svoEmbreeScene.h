// The same rays through Embree, where it was found (SVO_EMBREE).
#ifndef svoEmbreeScene_h
#define svoEmbreeScene_h

#include "svoBenchmarkMesh.h"
#include "svoRay.h"
#include "svoView.h"

#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#ifdef SVO_EMBREE
#include "svoEmbree.h"
#endif

namespace svobench
{
#ifdef SVO_EMBREE
/// For rtcNewDevice(), behind other settings: of the sets that useInstructionSet() knows.
inline std::string embreeIsa(const std::string& name)
{
  return name == "AVX-512" ? ",isa=avx512"
    : name == "AVX2"       ? ",isa=avx2"
    : name == "SSE4"       ? ",isa=sse4.2"
                           : "";
}

/// A scene of one mesh, committed.
inline RTCScene makeEmbreeScene(RTCDevice device, const Mesh& mesh, RTCSceneFlags flags,
  RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM)
{
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, flags);
  rtcSetSceneBuildQuality(scene, quality);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      points[3 * i + a] = static_cast<float>(mesh.points[i][a]);
    }
  }
  auto* ids = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
    RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      ids[3 * i + a] = mesh.triangles[i][a];
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

/// For its time, on one thread.
inline void buildWithEmbree(const Mesh& mesh, RTCBuildQuality quality)
{
  RTCDevice device = rtcNewDevice("threads=1");
  rtcReleaseScene(makeEmbreeScene(device, mesh, RTC_SCENE_FLAG_NONE, quality));
  rtcReleaseDevice(device);
}

class EmbreeScene
{
public:
  /// One mesh, or instances of it where there are matrices. instructionSet: of those that
  /// useInstructionSet() knows; Embree has no scalar one.
  explicit EmbreeScene(const Mesh& mesh, const std::string& instructionSet = "",
    const std::vector<glm::dmat4>& instances = {})
    : Device(rtcNewDevice(("threads=1" + embreeIsa(instructionSet)).c_str()))
    , Fast(this->makeScene(mesh, RTC_SCENE_FLAG_NONE, instances))
    , Robust(this->makeScene(mesh, RTC_SCENE_FLAG_ROBUST, instances))
    , Available(instructionSet != "scalar")
  {
  }
  ~EmbreeScene()
  {
    rtcReleaseScene(this->Fast);
    rtcReleaseScene(this->Robust);
    rtcReleaseDevice(this->Device);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  bool available() const { return this->Available; }

  /// All tiles of a view; t is linear depth minus base. width: rays at a time, 0 for robust mode.
  std::vector<svo::HitBlock> trace(const svo::View& view, double base, int width) const
  {
    const int tiles = (view.width + 7) / 8 * ((view.height + 7) / 8);
    std::vector<svo::HitBlock> hits(tiles);
    this->time(view, base, width, hits);
    return hits;
  }

  void time(const svo::View& view, double base, int width, std::vector<svo::HitBlock>& hits) const
  {
    const int columns = (view.width + 7) / 8;
    const glm::vec3 direction(view.direction), dx(view.directionX), dy(view.directionY);
    for (std::size_t b = 0; b < hits.size(); ++b)
    {
      const float x0 = 8.0f * (b % columns) + 0.5f, y0 = 8.0f * (b / columns) + 0.5f;
      const auto ray = [&](int i) { return direction + (x0 + i % 8) * dx + (y0 + i / 8) * dy; };
      if (width == 8)
      {
        this->packets<RTCRayHit8, 8>(view, base, ray, hits[b]);
      }
      else if (width == 16)
      {
        this->packets<RTCRayHit16, 16>(view, base, ray, hits[b]);
      }
      else
      {
        this->single(width == 0 ? this->Robust : this->Fast, view, base, ray, hits[b]);
      }
    }
  }

private:
  RTCScene makeScene(
    const Mesh& mesh, RTCSceneFlags flags, const std::vector<glm::dmat4>& instances) const
  {
    RTCScene scene = makeEmbreeScene(this->Device, mesh, flags);
    if (instances.empty())
    {
      return scene;
    }
    RTCScene all = rtcNewScene(this->Device);
    rtcSetSceneFlags(all, flags);
    for (const glm::dmat4& toWorld : instances)
    {
      const glm::mat4 matrix(toWorld);
      RTCGeometry geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(geometry, scene);
      rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &matrix[0][0]);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(all, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcReleaseScene(scene); // the instances hold it
    rtcCommitScene(all);
    return all;
  }

  template <class Directions>
  void single(
    RTCScene scene, const svo::View& view, double base, Directions&& ray, svo::HitBlock& hits) const
  {
    EmbreeQuery query(true);
    for (int i = 0; i < 64; ++i)
    {
      const glm::vec3 d = ray(i);
      RTCRayHit r{};
      r.ray.org_x = static_cast<float>(view.origin.x);
      r.ray.org_y = static_cast<float>(view.origin.y);
      r.ray.org_z = static_cast<float>(view.origin.z);
      r.ray.dir_x = d.x;
      r.ray.dir_y = d.y;
      r.ray.dir_z = d.z;
      r.ray.tnear = static_cast<float>(view.tNear);
      r.ray.tfar = static_cast<float>(view.tFar);
      r.ray.mask = ~0u;
      r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.intersect(scene, r);
      hits.t[i] = static_cast<float>(r.ray.tfar - base);
      hits.primitive[i] = r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? svo::NoPrimitive : r.hit.primID;
    }
  }

  template <class Packet, int N, class Directions>
  void packets(const svo::View& view, double base, Directions&& ray, svo::HitBlock& hits) const
  {
    EmbreeQuery query(true);
    alignas(64) int valid[N];
    std::fill_n(valid, N, -1);
    for (int first = 0; first < 64; first += N)
    {
      alignas(64) Packet r{};
      for (int i = 0; i < N; ++i)
      {
        const glm::vec3 d = ray(first + i);
        r.ray.org_x[i] = static_cast<float>(view.origin.x);
        r.ray.org_y[i] = static_cast<float>(view.origin.y);
        r.ray.org_z[i] = static_cast<float>(view.origin.z);
        r.ray.dir_x[i] = d.x;
        r.ray.dir_y[i] = d.y;
        r.ray.dir_z[i] = d.z;
        r.ray.tnear[i] = static_cast<float>(view.tNear);
        r.ray.tfar[i] = static_cast<float>(view.tFar);
        r.ray.mask[i] = ~0u;
        r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      }
      query.intersect(this->Fast, valid, r);
      for (int i = 0; i < N; ++i)
      {
        hits.t[first + i] = static_cast<float>(r.ray.tfar[i] - base);
        hits.primitive[first + i] =
          r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? svo::NoPrimitive : r.hit.primID[i];
      }
    }
  }

  RTCDevice Device;
  RTCScene Fast;
  RTCScene Robust;
  bool Available;
};
#else
class EmbreeScene
{
public:
  explicit EmbreeScene(const Mesh&, const std::string& = "", const std::vector<glm::dmat4>& = {}) {}
  bool available() const { return false; }
  std::vector<svo::HitBlock> trace(const svo::View&, double, int) const { return {}; }
  void time(const svo::View&, double, int, std::vector<svo::HitBlock>&) const {}
};
#endif
}

#endif
