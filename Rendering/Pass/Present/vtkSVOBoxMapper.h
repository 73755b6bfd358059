/**
 * @class vtkSVOBoxMapper
 * @brief draws what lies in a box, by VTK's own shaders with svo::EyeCode in them
 *
 * The input is the box, as triangles that are wound to the left outside. Of these the farther ones
 * are drawn, each fragment of which follows its line of sight back to the eye; so the eye may be
 * inside of the box. Colours, lights and whatever passes add are VTK's.
 */
#ifndef vtkSVOBoxMapper_h
#define vtkSVOBoxMapper_h

#include "svoBorrowedTextures.h"
#include "svoEyeCode.h"

#include "vtkOpenGLPolyDataMapper.h"

#include <string>

class vtkSVOBoxMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkSVOBoxMapper* New();
  vtkTypeMacro(vtkSVOBoxMapper, vtkOpenGLPolyDataMapper);

  /// What to draw until the next call: one of `code`'s surfaces, with the textures of `code`.
  void SetSurface(const svo::EyeCode& code, std::size_t surface, svo::BorrowedTextures& textures);

protected:
  vtkSVOBoxMapper() = default;
  ~vtkSVOBoxMapper() override = default;

  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor) override;

private:
  vtkSVOBoxMapper(const vtkSVOBoxMapper&) = delete;
  void operator=(const vtkSVOBoxMapper&) = delete;

  const svo::EyeCode* Code = nullptr;
  std::size_t Surface = 0;
  svo::BorrowedTextures* Textures = nullptr;
  std::string Constants; // that the shaders were made with
};

#endif
