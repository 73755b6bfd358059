// A screenshot larger than its window, taken in tiles, is the picture of a window of that size.
#include "svoTestStage.h"

#include "vtkImageData.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace
{
void fill(svotest::Stage& stage)
{
  stage.addGround();
  stage.add(svotest::ball(0.7, -0.6, -0.2, 0.9), 0.9, 0.5, 0.3);
  stage.add(svotest::ring(0.7, 0.9, 0.3, 0.9), 0.3, 0.6, 0.9);
  stage.addSun(2.0, -1.5, 4.0);
}
}

int TestSVOTiledScreenshot(int, char*[])
{
  using namespace svotest;
  Checks checks;
  Stage big(450, 360);
  fill(big);
  const Picture expected = big.shadowed();

  Stage small(150, 120);
  fill(small);
  small.shadowed();
  vtkNew<vtkWindowToImageFilter> screenshot;
  screenshot->SetInput(small.window);
  screenshot->SetScale(3);
  screenshot->SetInputBufferTypeToRGB();
  screenshot->ReadFrontBufferOff();
  screenshot->Update();
  vtkImageData* image = screenshot->GetOutput();
  const int* size = image->GetDimensions();
  checks.expect(size[0] == 450 && size[1] == 360, "three times the window's size");

  // Tiles may round a ray to the neighbouring pixel at an edge, nowhere else.
  std::size_t different = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const auto* rgb = static_cast<const unsigned char*>(image->GetScalarPointer()) + 3 * i;
    int largest = 0;
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max(largest, std::abs(rgb[c] - expected.rgb[3 * i + c]));
    }
    different += largest > 2;
  }
  std::cout << different << " of " << expected.size() << " pixels differ\n";
  checks.expect(different <= expected.size() / 500, "at most 0.2 % of the pixels differ");
  return checks.exitCode();
}
