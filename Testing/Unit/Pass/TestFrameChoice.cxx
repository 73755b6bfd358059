// Who makes a frame's picture, and how shadows are found in it: all that can be asked for.
#include "svoFrameChoice.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
using svo::ShadowTechnique;

constexpr ShadowTechnique Techniques[] = { ShadowTechnique::None, ShadowTechnique::Buffer,
  ShadowTechnique::Rays, ShadowTechnique::Automatic, ShadowTechnique::Volumes };

/// One frame, and what was asked about OpenGL on the way.
struct Chosen
{
  svo::FrameSettings settings;
  svo::FrameChoice choice;
  std::vector<std::string> asked;
};

/// `prefers`: OpenGL; `raysToo`: with rays to lights, or volumes.
Chosen choose(
  ShadowTechnique technique, svo::FrameWishes wishes, bool planes, bool prefers, bool raysToo)
{
  Chosen chosen;
  chosen.settings.shadowTechnique = technique;
  wishes.prefersOpenGL = [&](bool rays, bool volumes)
  {
    chosen.asked.push_back(volumes ? "volumes" : rays ? "rays" : "maps");
    return prefers && (!rays || raysToo);
  };
  chosen.choice = svo::chooseFrame(chosen.settings, wishes, planes);
  return chosen;
}
}

TEST(FrameChoice, TheTracerIsAskedForNoneBuffersOrRaysAlone)
{
  for (const ShadowTechnique technique : Techniques)
  {
    for (int bits = 0; bits < 128; ++bits)
    {
      svo::FrameWishes wishes;
      wishes.automatic = bits & 1;
      wishes.openGL = bits & 2;
      wishes.sampled = bits & 4;
      wishes.severalProcesses = bits & 8;
      const Chosen chosen = choose(technique, wishes, bits & 16, bits & 32, bits & 64);
      const svo::FrameSettings& s = chosen.settings;
      SCOPED_TRACE(std::to_string(static_cast<int>(technique)) + " " + std::to_string(bits));
      // No shadows stay none, and rays stay rays, whoever makes them.
      EXPECT_EQ(technique == ShadowTechnique::None, s.shadowTechnique == ShadowTechnique::None);
      if (technique == ShadowTechnique::Rays || technique == ShadowTechnique::Volumes)
      {
        EXPECT_EQ(ShadowTechnique::Rays, s.shadowTechnique);
      }
      EXPECT_TRUE(s.shadowTechnique <= ShadowTechnique::Rays);
      EXPECT_EQ(chosen.choice.openGL && technique == ShadowTechnique::Volumes, s.shadowVolumes);
      EXPECT_LE(s.lightCode, chosen.choice.openGL);
      if (!wishes.automatic)
      {
        EXPECT_EQ(wishes.openGL, chosen.choice.openGL);
        EXPECT_TRUE(chosen.asked.empty());
        EXPECT_FALSE(chosen.choice.hangsOnPlanes);
      }
      // Samples are rays, so they take the other processes' casters, not their maps.
      if (wishes.sampled && wishes.severalProcesses)
      {
        EXPECT_NE(ShadowTechnique::Buffer, s.shadowTechnique);
      }
    }
  }
}

TEST(FrameChoice, AutomaticAsksForWhatItWouldTake)
{
  svo::FrameWishes wishes;
  wishes.automatic = true;
  const auto asked = [&](ShadowTechnique technique, bool raysToo)
  { return choose(technique, wishes, false, true, raysToo).asked; };
  using Words = std::vector<std::string>;
  EXPECT_EQ(Words{ "maps" }, asked(ShadowTechnique::Buffer, true));
  EXPECT_EQ(Words{ "rays" }, asked(ShadowTechnique::Rays, true));
  EXPECT_EQ(Words{ "volumes" }, asked(ShadowTechnique::Volumes, true));
  EXPECT_EQ((Words{ "maps", "rays" }), asked(ShadowTechnique::Automatic, true));
  wishes.sampled = true; // whose rays volumes do not replace
  EXPECT_EQ(Words{ "rays" }, asked(ShadowTechnique::Volumes, true));

  wishes.sampled = false;
  const auto technique = [&](bool raysToo)
  {
    return choose(ShadowTechnique::Automatic, wishes, false, true, raysToo)
      .settings.shadowTechnique;
  };
  EXPECT_EQ(ShadowTechnique::Rays, technique(true));
  EXPECT_EQ(ShadowTechnique::Buffer, technique(false));
}

TEST(FrameChoice, SurfacesWithoutTrianglesAreTheCPUsWhereThereIsAChoice)
{
  svo::FrameWishes wishes;
  wishes.automatic = true;
  for (const bool planes : { false, true })
  {
    const Chosen chosen = choose(ShadowTechnique::Buffer, wishes, planes, true, true);
    EXPECT_TRUE(chosen.choice.hangsOnPlanes);
    EXPECT_EQ(!planes, chosen.choice.openGL);
  }
  wishes.automatic = false;
  wishes.openGL = true;
  EXPECT_TRUE(choose(ShadowTechnique::Buffer, wishes, true, false, false).choice.openGL);
}

TEST(FrameChoice, ProcessesMergeTheCPUsMaps)
{
  svo::FrameWishes wishes;
  wishes.openGL = true;
  for (const bool several : { false, true })
  {
    wishes.severalProcesses = several;
    EXPECT_EQ(
      !several, choose(ShadowTechnique::Buffer, wishes, false, true, true).settings.lightCode);
    EXPECT_TRUE(choose(ShadowTechnique::Rays, wishes, false, true, true).settings.lightCode);
  }
}

TEST(FrameChoice, VolumesThatTheCPUCannotDrawSayWhatDoes)
{
  svo::FrameWishes wishes;
  EXPECT_NE(std::string::npos, svo::whyNoVolumes(wishes).find("SetBackendToAuto()"));
  wishes.automatic = true;
  EXPECT_NE(std::string::npos, svo::whyNoVolumes(wishes).find("SetBackendToOpenGL()"));
  for (bool svo::FrameWishes::*const hopeless :
    { &svo::FrameWishes::sampled, &svo::FrameWishes::severalProcesses })
  {
    svo::FrameWishes other = wishes;
    other.*hopeless = true;
    EXPECT_EQ(std::string::npos, svo::whyNoVolumes(other).find("SetBackend"));
  }
}
