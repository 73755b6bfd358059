// In a window with multisampling, silhouettes of traced surfaces are as smooth as those of VTK's
// own raster, where they lie in front of the background, of each other and of a rasterised surface.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace
{
using namespace svoTest;

void fill(Stage& stage)
{
  stage.addGround(1.6);
  stage.add(ball(0.7, -0.6, -0.2, 0.9), 0.9, 0.5, 0.3);
  stage.add(ring(0.7, 0.6, 0.4, 0.9), 0.3, 0.6, 0.9);
  // Edges on: the rasteriser's.
  stage.add(box(0.9, 0.0, 1.3, 1.3), 0.5, 0.9, 0.4)->GetProperty()->EdgeVisibilityOn();
  stage.addSun(2.0, -1.5, 4.0);
  stage.pass->SetShadowTechniqueToNone();
  stage.pass->SetPixelError(0.0);
}

/// Pixels where the two pictures differ by more than `levels` in a channel.
std::size_t different(const Picture& a, const Picture& b, int levels)
{
  std::size_t count = 0;
  for (std::size_t pixel = 0; pixel < a.size(); ++pixel)
  {
    int largest = 0;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c)
    {
      largest = std::max(largest, std::abs(int(a.rgb[c]) - int(b.rgb[c])));
    }
    count += largest > levels;
  }
  return count;
}
}

int TestSVOMultiSamples(int argc, char* argv[])
{
  Checks checks;
  Stage stage;
  fill(stage);
  stage.window->SetMultiSamples(4);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = capture(stage.window);
  checks.expect(stage.pass->GetNumberOfTracedActors() == 3, "all but the box are traced");
  const bool same = matchesBaseline(stage.window, argc, argv);

  // The same without multisampling, for what an aliased edge is.
  Stage plain;
  fill(plain);
  plain.usePass(false);
  const Picture aliased = capture(plain.window);
  const std::size_t edges = different(raster, aliased, 16);
  const std::size_t wrong = different(raster, traced, 16);
  std::cout << edges << " pixels are smoothed by multisampling; " << wrong
            << " of the traced picture differ from the raster\n";
  checks.expect(edges > 500, "multisampling smooths edges");
  checks.expect(wrong < edges / 10, "nine smoothed pixels of ten are so in the traced picture");

  // Kept layers and a second frame change nothing.
  checks.expect(different(traced, capture(stage.window), 0) == 0, "two frames are equal");
  return same ? checks.exitCode() : EXIT_FAILURE;
}
