// The offset by which VTK resolves coincident topology, added to window depths (0..1) before they
// are compared.
#ifndef svoDepthOffset_h
#define svoDepthOffset_h

namespace svo
{
struct DepthOffset
{
  float units = 0.0f; // of window depth
  /// Of the facet's slope: how much its window depth changes from pixel to pixel (svoDepthSlope.h).
  float factor = 0.0f;

  bool none() const { return this->units == 0.0f && this->factor == 0.0f; }
  bool operator==(const DepthOffset& other) const
  {
    return this->units == other.units && this->factor == other.factor;
  }
  bool operator!=(const DepthOffset& other) const { return !(*this == other); }
};
}

#endif
