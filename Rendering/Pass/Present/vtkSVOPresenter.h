/**
 * @class vtkSVOPresenter
 * @brief the prop that shows traced pixels in the midst of VTK's own frame
 *
 * It takes a traced actor's place in the renderer's prop array for one frame, so that VTK draws it
 * wherever it draws opaque geometry: below translucent props, in ambient occlusion's first stage,
 * in every layer of depth peeling. It has no bounds.
 */
#ifndef vtkSVOPresenter_h
#define vtkSVOPresenter_h

#include "svoFrameTextures.h"
#include "svoSilhouettes.h"
#include "svoTracer.h"

#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkProp3D.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderPass;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkRenderer;
class vtkShaderProgram;
class vtkTextureObject;

class vtkSVOPresenter : public vtkProp3D
{
public:
  static vtkSVOPresenter* New();
  vtkTypeMacro(vtkSVOPresenter, vtkProp3D);

  using SilhouetteFinder = svo::FrameTextures::SilhouetteFinder;

  /// The frame to show; it must live until the next call. `pass` is not asked for draw buffers.
  /// Where the framebuffer has several samples a pixel, silhouettes are asked for and the frame's
  /// pixels that they replace are exchanged.
  void SetFrame(svo::Frame* frame, const SilhouetteFinder& silhouettes, vtkOpenGLRenderPass* pass);

  /// Draws surfaces that are traced where VTK draws; null: there are none. Until the next call.
  using Draw = std::function<void(vtkViewport*)>;
  void SetSurfaces(Draw draw) { this->DrawSurfaces = std::move(draw); }

  /// The window, whose context is current, is drawn into from now on. `leave` is called in that
  /// context before it goes, or is exchanged for another, or another `leave` is set.
  void Enter(vtkOpenGLRenderWindow* window);
  void SetLeave(std::function<void()> leave);

  /// Called when the prop is about to draw, with the size in pixels of what is drawn, before it
  /// looks at its frame. Null (the default) in renderers whose pass is the prop's own.
  using Prepare = std::function<void(int width, int height)>;
  void SetPrepare(Prepare prepare) { this->PrepareFrame = std::move(prepare); }

  /// Other passes, which set up the framebuffer's attachments, are asked as for this prop, whose
  /// place in their frame the presenter has. Null: for none but those that know the presenter
  /// itself.
  void StandFor(vtkProp* prop);

  /// True if nothing can have been drawn before the presenter into the pixels that it shows: then
  /// those of tiles without holes may be copied (svoFrameCopy.h). False until it is said.
  void SetFirst(bool first) { this->First = first; }

  /// True if one of these passes wants positions and normals beside colours.
  bool WantsNormals();

  /// Seconds that the last frame's upload and drawing took.
  double GetPresentTime() const { return this->PresentTime; }

  double* GetBounds() override { return nullptr; }
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  /// Of the window that it has drawn into last, whichever is named, in that window's context.
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkSVOPresenter();
  ~vtkSVOPresenter() override;

private:
  vtkSVOPresenter(const vtkSVOPresenter&) = delete;
  void operator=(const vtkSVOPresenter&) = delete;

  void UploadRectangles(const std::vector<svo::PixelRect>& rectangles);
  bool DrawFrame(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void SelectDrawBuffers(vtkShaderProgram* program);

  void ReleaseAll();

  vtkSmartPointer<vtkTextureObject> Context; // has all released in the window's own context
  bool Entered = false;                      // and not left
  std::function<void()> LeaveContext;
  Prepare PrepareFrame;
  svo::Frame* Frame = nullptr;
  SilhouetteFinder FindSilhouettes;
  Draw DrawSurfaces;
  vtkOpenGLRenderPass* Pass = nullptr;
  double PresentTime = 0.0;
  bool First = false;
  svo::FrameTextures Textures;
  int Drawn = 0;                                  // corners
  vtkSmartPointer<vtkOpenGLBufferObject> Corners; // two triangles for each rectangle
  vtkSmartPointer<vtkOpenGLVertexArrayObject> Array;
  /// The mapper that other passes are given when they set up the quad's shader.
  vtkNew<vtkOpenGLPolyDataMapper> QuadMapper;
};

/**
 * @class vtkSVONothing
 * @brief draws nothing in a further traced actor's place
 */
class vtkSVONothing : public vtkProp3D
{
public:
  static vtkSVONothing* New();
  vtkTypeMacro(vtkSVONothing, vtkProp3D);
  double* GetBounds() override { return nullptr; }
};

#endif
