// One ray and many triangles, a triangle a lane: whether it meets any of them.
//
// The decisions are those of meetTriangles() of svoLeafGeometry.h, bit for bit. The ray is not
// turned to keep the winding: that only changes the sign of both parts of a quotient.
#if defined(SVO_OCCLUSION_TRIANGLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_OCCLUSION_TRIANGLES_INL
#undef SVO_OCCLUSION_TRIANGLES_INL
#else
#define SVO_OCCLUSION_TRIANGLES_INL
#endif

#include "svoLaneProducts-inl.h"
#include "svoPacketLeaf-inl.h"
#include "svoPacketWalk-inl.h"

#include <algorithm>
#include <cstdint>

#if SVO_PACKET_LEAVES
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Lists of triangles, a vector's lanes of them at a time, with their corners side by side: to
/// fetch these takes longer than a test, and neighbouring rays ask for the same ones.
class FetchedTriangles
{
public:
  static constexpr int Width = hn::MaxLanes(DI());

  struct Part
  {
    HWY_ALIGN float corners[3][3][Width]; // axis, corner, triangle
  };

  FetchedTriangles() { std::fill_n(this->keys, Slots, 0u); }

  /// `count` triangles, at most a vector's lanes, of a list that begins at a word from the nodes.
  HWY_INLINE const Part& get(const WalkTarget& target, std::uint32_t word, int count)
  {
    const DU du;
    const std::uint32_t slot = slotOf(word);
    if (this->keys[slot] != word)
    {
      this->keys[slot] = word;
      // An id that stands in its node has a bit for that.
      const U ids = hn::And(hn::MaskedLoad(hn::FirstN(du, count), du, target.words + word),
        hn::Set(du, ~InlineTriangle));
      this->fetch(target, hn::BitCast(DI(), ids), this->parts[slot]);
    }
    return this->parts[slot];
  }

private:
  static constexpr std::uint32_t Slots = 64;
  static std::uint32_t slotOf(std::uint32_t word) { return word * 0x9e3779b1u >> 26; }

  HWY_NOINLINE static void fetch(const WalkTarget& target, I ids, Part& to)
  {
    const DF df;
    Vec3 v[3];
    gatherTriangle(target, ids, v[0], v[1], v[2]);
    for (int corner = 0; corner < 3; ++corner)
    {
      hn::Store(v[corner].x, df, to.corners[0][corner]);
      hn::Store(v[corner].y, df, to.corners[1][corner]);
      hn::Store(v[corner].z, df, to.corners[2][corner]);
    }
  }

  std::uint32_t keys[Slots]; // words, none is 0
  Part parts[Slots];
};

/// A ray made ready for triangles: ShearedRay of svoTriangle.h.
struct alignas(64) OcclusionRay
{
  float origin[3], shear[3]; // in the order of the shear
  float tMin, tMax;
  std::int32_t axis; // that it goes along most

  /// One of the first `count` triangles that it meets; -1 if there is none.
  HWY_INLINE int meets(const FetchedTriangles::Part& part, int count) const
  {
    const DF df;
    const F zero = hn::Zero(df);
    constexpr std::uint8_t Next[5] = { 0, 1, 2, 0, 1 };
    const auto& xs = part.corners[Next[this->axis + 1]];
    const auto& ys = part.corners[Next[this->axis + 2]];
    const auto& zs = part.corners[this->axis];
    const F originX = hn::Set(df, this->origin[0]), originY = hn::Set(df, this->origin[1]),
            originZ = hn::Set(df, this->origin[2]);
    const F shearX = hn::Set(df, this->shear[0]), shearY = hn::Set(df, this->shear[1]);
    F x[3], y[3], z[3];
    for (int k = 0; k < 3; ++k)
    {
      z[k] = hn::Sub(hn::Load(df, zs[k]), originZ);
      x[k] = hn::Sub(hn::Sub(hn::Load(df, xs[k]), originX), hn::Mul(shearX, z[k]));
      y[k] = hn::Sub(hn::Sub(hn::Load(df, ys[k]), originY), hn::Mul(shearY, z[k]));
    }
    const F u = differenceOfProducts(x[2], y[1], y[2], x[1]);
    const F v = differenceOfProducts(x[0], y[2], y[0], x[2]);
    const F w = differenceOfProducts(x[1], y[0], y[1], x[0]);
    const F determinant = hn::Add(hn::Add(u, v), w);
    const auto outside =
      hn::And(hn::Lt(hn::Min(hn::Min(u, v), w), zero), hn::Gt(hn::Max(hn::Max(u, v), w), zero));
    const auto inside =
      hn::And(hn::FirstN(df, count), hn::AndNot(outside, hn::Ne(determinant, zero)));
    if (hn::AllFalse(df, inside))
    {
      return -1;
    }
    const F height = hn::Add(hn::Add(hn::Mul(u, z[0]), hn::Mul(v, z[1])), hn::Mul(w, z[2]));
    const F t = hn::Div(hn::Mul(height, hn::Set(df, this->shear[2])), determinant);
    const auto within =
      hn::And(hn::Ge(t, hn::Set(df, this->tMin)), hn::Le(t, hn::Set(df, this->tMax)));
    return static_cast<int>(hn::FindFirstTrue(df, hn::And(inside, within)));
  }
};

/// Those of a packet's lanes.
HWY_INLINE void shear(const Packet& p, OcclusionRay* rays)
{
  const DF df;
  const DI di;
  constexpr int Width = hn::MaxLanes(DI());
  const F x = hn::Abs(p.dx), y = hn::Abs(p.dy), z = hn::Abs(p.dz);
  const auto xOverY = hn::Gt(x, y);
  const auto alongX = hn::And(xOverY, hn::Gt(x, z));
  const auto alongY = hn::AndNot(xOverY, hn::Gt(y, z));
  const auto choose = [&](F ifX, F ifY, F ifZ)
  { return hn::IfThenElse(alongX, ifX, hn::IfThenElse(alongY, ifY, ifZ)); };
  const F along = choose(p.dx, p.dy, p.dz);
  HWY_ALIGN float parts[8][Width];
  HWY_ALIGN std::int32_t axis[Width];
  hn::Store(choose(p.oy, p.oz, p.ox), df, parts[0]);
  hn::Store(choose(p.oz, p.ox, p.oy), df, parts[1]);
  hn::Store(choose(p.ox, p.oy, p.oz), df, parts[2]);
  hn::Store(hn::Div(choose(p.dy, p.dz, p.dx), along), df, parts[3]);
  hn::Store(hn::Div(choose(p.dz, p.dx, p.dy), along), df, parts[4]);
  hn::Store(hn::Div(hn::Set(df, 1.0f), along), df, parts[5]);
  hn::Store(p.tMin, df, parts[6]);
  hn::Store(p.tClip, df, parts[7]);
  hn::Store(hn::IfThenElse(hn::RebindMask(di, alongX), hn::Zero(di),
              hn::IfThenElse(hn::RebindMask(di, alongY), hn::Set(di, 1), hn::Set(di, 2))),
    di, axis);
  for (int i = 0; i < Width; ++i)
  {
    rays[i] = { { parts[0][i], parts[1][i], parts[2][i] },
      { parts[3][i], parts[4][i], parts[5][i] }, parts[6][i], parts[7][i], axis[i] };
  }
}
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
