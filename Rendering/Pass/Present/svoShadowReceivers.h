// Shadows on surfaces that the rasteriser draws, through VTK's hook into its mappers' shaders.
#ifndef svoShadowReceivers_h
#define svoShadowReceivers_h

#include "svoMapGroups.h"
#include "svoMapTextures.h"
#include "svoScene.h"
#include "svoTracer.h"
#include "svoView.h"

#include <memory>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace svo
{
/// One renderer's shadow maps as textures, and the code that reads them.
class ShadowReceivers
{
public:
  /// Takes a frame's maps. Only those that are others than last time are sent to OpenGL. No
  /// maps: nothing receives. The bias that the settings have in voxels is added in
  /// those of the coarsest caster, as maps do not hold casters. `lights`: of the maps. `texture`:
  /// Tracer::mapTexture().
  /// Returns a message, empty if all is well: of more maps than OpenGL takes, those of the
  /// brightest lights are there.
  std::string update(vtkOpenGLRenderWindow* window, const std::vector<ShadowMap>& maps,
    const std::vector<Light>& lights, const View& eye, const FrameSettings& settings,
    unsigned int texture = 0);

  /// Whether the frame has shadow catchers, surfaces of which the shadows alone are seen.
  void setCatchers(bool catchers) { this->Catchers = catchers; }

  /// True if shaders need nothing of this.
  bool idle() const { return this->Groups.empty() && !this->Catchers; }

  /// Bytes that OpenGL holds.
  std::size_t memory() const { return this->Maps.memory(); }

  void activate();
  void deactivate();
  void release();

  /// Which lights' colours the shaders must weigh; equal strings mean equal shaders.
  std::string signature() const;

  /// Two steps around VTK's own replacements: marks first, then code.
  static void markShader(std::string& fragmentShader);
  void completeShader(
    std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const;
  void setUniforms(vtkShaderProgram* program, bool receives, bool catches) const;

  /// What completeShader() puts before a fragment shader's main(): constants, uniforms, functions.
  std::string declarations() const;

private:
  bool empty() const { return this->Groups.empty(); }
  bool translucent() const
  {
    return this->FirstTranslucent < static_cast<int>(this->Errors.size());
  }

  std::vector<MapGroup> Groups; // those of opaque casters, then all others
  std::vector<int> First;       // map of each of them; then the number of all maps
  int FirstTranslucent = 0;     // map; the number of all maps if there is none
  std::vector<float> Rows;      // 16 floats a map, row by row
  std::vector<float> Errors;
  std::size_t Capacity = 0; // maps that the shaders have room for
  MapTextures Maps;
  int Size = 0; // texels along an edge of a map
  float Intensity = 1.0f;
  float ManualBias = 0.0f; // world
  bool PlaneBias = true;
  bool Filter = false;
  bool Catchers = false;
};
}

#endif
