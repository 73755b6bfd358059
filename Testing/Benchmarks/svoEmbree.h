// Embree 3 and 4 by the same calls. Only where one of them was found: SVO_EMBREE is its major
// version.
#ifndef svoEmbree_h
#define svoEmbree_h

#if SVO_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace svobench
{
/// How rays are looked after; one object serves any number of them.
class EmbreeQuery
{
public:
  /// coherent: neighbouring rays go the same way.
  explicit EmbreeQuery(bool coherent)
  {
#if SVO_EMBREE >= 4
    rtcInitIntersectArguments(&this->Settings);
    rtcInitOccludedArguments(&this->Occlusion);
    if (coherent)
    {
      this->Settings.flags = RTC_RAY_QUERY_FLAG_COHERENT;
      this->Occlusion.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    }
#else
    rtcInitIntersectContext(&this->Settings);
    if (coherent)
    {
      this->Settings.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
#endif
  }

#if SVO_EMBREE >= 4
  void intersect(RTCScene scene, RTCRayHit& ray)
  {
    rtcIntersect1(scene, &ray, &this->Settings);
  }
  void intersect(RTCScene scene, const int* valid, RTCRayHit8& rays)
  {
    rtcIntersect8(valid, scene, &rays, &this->Settings);
  }
  void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays)
  {
    rtcIntersect16(valid, scene, &rays, &this->Settings);
  }
  /// tfar of a ray that meets something becomes minus infinity.
  void occlude(RTCScene scene, RTCRay& ray)
  {
    rtcOccluded1(scene, &ray, &this->Occlusion);
  }
  void occlude(RTCScene scene, const int* valid, RTCRay8& rays)
  {
    rtcOccluded8(valid, scene, &rays, &this->Occlusion);
  }
  void occlude(RTCScene scene, const int* valid, RTCRay16& rays)
  {
    rtcOccluded16(valid, scene, &rays, &this->Occlusion);
  }

private:
  RTCIntersectArguments Settings;
  RTCOccludedArguments Occlusion;
#else
  void intersect(RTCScene scene, RTCRayHit& ray)
  {
    rtcIntersect1(scene, &this->Settings, &ray);
  }
  void intersect(RTCScene scene, const int* valid, RTCRayHit8& rays)
  {
    rtcIntersect8(valid, scene, &this->Settings, &rays);
  }
  void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays)
  {
    rtcIntersect16(valid, scene, &this->Settings, &rays);
  }
  /// tfar of a ray that meets something becomes minus infinity.
  void occlude(RTCScene scene, RTCRay& ray)
  {
    rtcOccluded1(scene, &this->Settings, &ray);
  }
  void occlude(RTCScene scene, const int* valid, RTCRay8& rays)
  {
    rtcOccluded8(valid, scene, &this->Settings, &rays);
  }
  void occlude(RTCScene scene, const int* valid, RTCRay16& rays)
  {
    rtcOccluded16(valid, scene, &this->Settings, &rays);
  }

private:
  RTCIntersectContext Settings;
#endif
};
}

#endif
