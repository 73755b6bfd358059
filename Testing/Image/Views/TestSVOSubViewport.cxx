// A pass in a part of the window, not square, leaves the rest of the window alone.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

int TestSVOSubViewport(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  Stage whole(480, 400);
  whole.usePass(false);
  whole.renderer->SetBackground(0.5, 0.2, 0.2);
  whole.add(ball(2.0, 0.0, 0.0, 0.6), 0.4, 0.4, 0.8);
  whole.addSun(2.0, -1.5, 4.0);
  const Picture before = capture(whole.window);

  Stage part(whole, 0.21, 0.13, 0.87, 0.55);
  ShadowOracle oracle;
  oracle.add(part.addGround());
  oracle.add(part.add(ball(0.9, 0.3, 0.0, 1.3), 0.9, 0.6, 0.2));
  oracle.add(part.addSun(2.0, -1.5, 4.0));
  const Picture unshadowed = part.unshadowed();
  const Picture shadowed = part.shadowed();
  expectShadows(checks, oracle.judge(part.renderer, shadowed, unshadowed), "sub-viewport");

  int width;
  int height;
  int left;
  int low;
  part.renderer->GetTiledSizeAndOrigin(&width, &height, &left, &low);
  Mask outside(before.size(), 1);
  for (int y = low; y < low + height; ++y)
  {
    for (int x = left; x < left + width; ++x)
    {
      outside[static_cast<std::size_t>(y) * before.width + x] = 0;
    }
  }
  checks.expect(difference(before, shadowed, outside).largest == 0, "the rest of the window");
  checks.expect(matchesBaseline(part.window, argc, argv), "the baseline");
  return checks.exitCode();
}
