// Shadows on surfaces that the rasteriser draws, through VTK's hook into its mappers' shaders.
#ifndef svoShadowReceivers_h
#define svoShadowReceivers_h

#include "svoMapGroups.h"
#include "svoScene.h"
#include "svoTexelBuffer.h"
#include "svoTracer.h"
#include "svoView.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

namespace svo
{
/// One renderer's shadow maps as textures, and the code that reads them.
class ShadowReceivers
{
public:
  /// Takes a frame's maps. Only those that are others than last time are sent to OpenGL. No
  /// maps: nothing receives. The bias that the settings have in voxels is added in
  /// those of the coarsest caster, as maps do not hold casters. `lights`: of the maps.
  /// Returns a message, empty if all is well: of more maps than OpenGL takes, those of the
  /// brightest lights are there.
  std::string update(vtkOpenGLRenderWindow* window, const std::vector<ShadowMap>& maps,
    const std::vector<Light>& lights, const View& eye, const FrameSettings& settings);

  /// Whether the frame has shadow catchers, surfaces of which the shadows alone are seen.
  void setCatchers(bool catchers) { this->Catchers = catchers; }

  /// True if shaders need nothing of this.
  bool idle() const { return this->Groups.empty() && !this->Catchers; }

  /// Bytes that OpenGL holds.
  std::size_t memory() const { return this->Maps ? this->Maps->size() * sizeof(float) : 0; }

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
  /// Where a map lies among Maps.
  struct Block
  {
    std::size_t first = 0; // its table: by tile of the map where its texels begin, in tiles
    std::size_t table = 0; // tiles of the map
    std::size_t tiles = 0; // that there is room for behind the table
    std::size_t stride = 0;
    std::weak_ptr<const ShadowTexels> sent; // what is there

    std::size_t texels() const
    {
      constexpr std::size_t InTile = ShadowTexels::InTile;
      return (this->first + this->table + InTile - 1) / InTile * InTile;
    }
  };
  bool fits(vtkOpenGLRenderWindow* window, const std::vector<const ShadowMap*>& maps) const;
  bool layOut(vtkOpenGLRenderWindow* window, const std::vector<const ShadowMap*>& maps);
  void send(const ShadowTexels& texels, const Block& block);

  vtkSmartPointer<TexelBuffer> Maps; // first of all a tile of texels in which nothing lies
  std::vector<Block> Blocks;         // by map
  std::vector<int> Tables;           // Block::first
  int Size = 0;                      // texels along an edge of a map
  float Intensity = 1.0f;
  float ManualBias = 0.0f; // world
  bool PlaneBias = true;
  bool Filter = false;
  bool Catchers = false;
};
}

#endif
