// The picture of a renderer's sky, of its environment texture.
#ifndef svoSkyTexture_h
#define svoSkyTexture_h

#include "svoSkyPicture.h"

#include "vtkType.h"

#include <array>
#include <memory>
#include <string>
#include <tuple>

class vtkRenderer;

namespace svo
{
class SkyTexture
{
public:
  /// Null if there is none that can be read; then `why`, a sentence, says so. The same one as long
  /// as the texture, and the environment's axes, are the same.
  std::shared_ptr<const SkyPicture> of(vtkRenderer* renderer, std::string& why);

private:
  std::shared_ptr<const SkyPicture> Picture;
  /// Of it: the image, never dereferenced, its time, whether colours are those of screens, and
  /// axes.
  std::tuple<const void*, vtkMTimeType, bool, std::array<double, 6>> Source;
};
}

#endif
