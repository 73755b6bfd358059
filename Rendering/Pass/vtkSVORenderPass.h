/**
 * @class vtkSVORenderPass
 * @brief traces the surfaces of a renderer through sparse voxel octrees, with shadows
 *
 * @code{.cpp}
 * vtkNew<vtkSVORenderPass> pass;
 * renderer->SetPass(pass);
 * @endcode
 *
 * is all there is to it. The picture is VTK's own, plus shadows. Surfaces whose look can be
 * reproduced (polygons and strips, material or array colours, flat, Gouraud and Phong shading, any
 * of VTK's lights) are traced through octrees: the one that vtkPolyDataToSVO left on the mesh, or
 * one that the pass builds where ConvertPolyData is on. Everything else (textures, PBR, visible
 * edges, wireframe, translucent surfaces, volumes, text, widgets and so on) is drawn by VTK's
 * rasteriser in the same frame, at the right depth. Opaque rasterised surfaces cast shadows as
 * well, and rasterised surfaces receive them. Selection and picking stay VTK's.
 *
 * An octree lives in its mesh's local coordinates, so an actor can be moved, turned, scaled,
 * mirrored or sheared by any affine matrix without building anything anew.
 *
 * Lights: every light that is switched on casts, but headlights, whose shadows cannot be seen, and
 * of several camera lights (a light kit) only the brightest. SetCastShadow(bool, vtkLight*) says
 * otherwise. Note that a positional vtkLight has a cone of 30 degrees unless told otherwise: set
 * 180 for a point light.
 *
 * ProgressEvent is invoked while a still picture waits for octrees, and for samples of lights. Its
 * observers may do as they like: draw other windows, with this pass too, change meshes, drop the
 * pass, abort the window's frame. The frame is then collected once more.
 *
 * Method: Huang and Cheng, "A Rendering Method Using Sparse Voxel Octrees in Dynamic Scenes",
 * 2017. The paper's Z-buffer tables ZBT and SZBT are the depth buffer and the shadow buffers here.
 *
 * The pass takes the place of VTK's default pipeline (renderer->SetPass(pass)), or that of
 * vtkRenderStepsPass in a chain of passes, inside a vtkCameraPass or without one. It may be set on
 * several renderers; statistics are those of the one rendered last. A host that keeps the
 * renderer's passes to itself, as ParaView does, calls Attach() instead.
 *
 * @sa vtkSVOPassSettings vtkSVOPropSettings vtkPolyDataToSVO vtkSparseVoxelOctree
 */
#ifndef vtkSVORenderPass_h
#define vtkSVORenderPass_h

#include "vtkSVOPassModule.h"   // for the export macro
#include "vtkSVOPassSettings.h" // for its settings

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkLight;
class vtkMultiProcessController;
class vtkOpenGLRenderWindow;
class vtkProp;
class vtkRenderer;
#ifndef __VTK_WRAP__
namespace svo
{
class AttachedRenderer;
class OwnCamera;
class Tracer;
struct PassFrame;
}
#endif

class VTKSVOPASS_EXPORT vtkSVORenderPass : public vtkSVOPassSettings
{
public:
  static vtkSVORenderPass* New();
  vtkTypeMacro(vtkSVORenderPass, vtkSVOPassSettings);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Frees the octrees that the pass keeps, and ends what is built in the background; the next frame
   * builds what it needs. During a frame: when it is through.
   */
  void ReleaseOctrees();

  /**
   * Draws the windows of the pass once more, with twice as many samples of lights that have a size
   * and of ambient occlusion, up to MaximumLightSamples, or until LightError is reached. Returns
   * false if nothing is left to be done: `while (pass->Refine()) {}`. In windows whose interactor
   * runs that goes on by itself while nothing else is to be done; there the CPU takes
   * samples in steps of about half a second, without a LightError, so that users are soon heard.
   * What has changed meanwhile begins anew.
   */
  bool Refine();

  //@{
  /**
   * Octrees that the pass has built so far (a mesh that is seen from far and from near has
   * several), and those that are built in the background at this moment: as long as there are any,
   * another render will show more than the last one.
   */
  int GetNumberOfOctreesBuilt() const;
  int GetNumberOfOctreesInProgress() const;
  //@}

  /**
   * Memory of the octrees that the pass built itself, KiB.
   */
  vtkIdType GetOctreeMemorySize() const;

  //@{
  /**
   * For a host whose renderers have passes of their own: from Attach() to Detach() each frame of
   * the renderer shows what this pass traces, although the pass is not set on it. A prop that is
   * put first in the renderer's list draws it, and a culler takes the traced ones from what the
   * renderer draws (a selector's frames are never traced). In the midst of a frame Detach() takes
   * effect when the frame is done. Only props with an explicit SetUseSVO(true) are traced and cast
   * shadows, with ShadowsForEverything all are. All other surfaces are drawn as ever, and receive
   * shadows. IsTraced(): whether the frame that is drawn shows the prop.
   */
  void Attach(vtkRenderer* renderer);
  void Detach(vtkRenderer* renderer);
  bool IsTraced(vtkProp* prop) const;
  //@}

  //@{
  /**
   * Where the surfaces of attached renderers are spread over several processes: the processes that
   * render, all of them in every frame, at the renderer's StartEvent. Their shadow buffers are
   * merged by the nearest caster, so that shadows fall across processes; for shadow rays each gets
   * the others' casters. Null (the default): one process has all.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  //@}

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  //@{
  /**
   * How shadows fall on rasterised surfaces; called by their mappers.
   */
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* VAO = nullptr) override;
  vtkMTimeType GetShaderStageMTime() override;
  //@}

protected:
  vtkSVORenderPass();
  ~vtkSVORenderPass() override;

  /**
   * What the last frame took, in seconds, which part of it neither fewer rays nor coarser shadow
   * maps would shorten, and which part only the latter would. It is all that
   * AutoAdjustSampleDistances goes by, so a subclass that answers otherwise than by the clock has
   * interactive pictures that can be reproduced.
   */
  virtual void MeasureFrame(double& seconds, double& fixedSeconds, double& shadowSeconds) const;

  /**
   * Texts of the pass that a host puts into its own words, because they ask users to do something
   * or name things that have other names there.
   */
  enum TextType
  {
    TEXT_HEADLIGHT = 0,       // what a headlight is called, in GetCastingLights()
    TEXT_ONLY_HEADLIGHTS = 1, // there are no shadows, because no other lights are on
    // Without TranslucentShadows, and of textures:
    TEXT_TRANSLUCENT = 2,         // cells of a surface cast none, because they are translucent
    TEXT_TRANSLUCENT_SURFACE = 3, // a surface casts none, because its opacity makes it translucent
    TEXT_CUT_OUT = 4,             // cells cast their whole shadows, although a texture hides parts
    TEXT_NOT_CHOSEN = 5,          // a reason, the end of a sentence that begins with "it"
    TEXT_NOTHING_CASTS = 6,       // there are no shadows, ... ; what follows says why
    TEXT_NOTHING_RECEIVES = 7,    // the same
    TEXT_CLIPPED = 8,             // a surface casts none, because its mapper clips it
    TEXT_LIGHT = 9                // a light's name, in GetCastingLights(); empty: its number
  };

  /**
   * The text, for programmers. For a subclass to override whose users set the scene up otherwise
   * than by calls; an empty message is not given. `about` is the light, or nullptr.
   */
  virtual std::string GetText(int text, vtkLight* about) const;

#ifndef __VTK_WRAP__
  const svo::PassStatistics& LastFrame() const override;

  /**
   * A tracer for a renderer, which is asked for all of its frames. This one runs on the processor,
   * and on the GPU where the backend is OpenGL; a subclass may have another (svoTracer.h).
   */
  virtual std::unique_ptr<svo::Tracer> MakeTracer() const;

  /**
   * Whether a window, whose context is current, is to be drawn by OpenGL where Backend is Auto;
   * asked in each frame; `rays`: with rays to lights. `complaint` is why it cannot be, if that is
   * so; it is said once. This one goes by the name of the context's renderer, and for rays, where
   * that is a GPU, by how fast they are there and here, measured once in the life of the context
   * (svoBackendChoice.h).
   */
  virtual bool PrefersOpenGL(
    vtkOpenGLRenderWindow* window, bool rays, std::string& complaint) const;
#endif

private:
#ifndef __VTK_WRAP__
  void HearAttached(vtkRenderer* renderer, unsigned long event);
  void BeginAttachedFrame(svo::AttachedRenderer& attached);
  bool CollectFrame(svo::PassFrame& frame, int width, int height, const svo::OwnCamera* camera);
  bool MayPreferOpenGL(svo::PassFrame& frame, bool rays, bool volumes);
  void TraceFrame(svo::PassFrame& frame, int width, int height);
  bool WantsSamples(const svo::PassFrame& frame) const;
  void TellOfSamples(svo::PassFrame& frame);
  void FinishFrame(svo::PassFrame& frame);
  bool RefineFor(double seconds);
#endif

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
