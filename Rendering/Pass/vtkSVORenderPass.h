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
 * An octree lives in its mesh's local frame, so an actor can be moved, turned, scaled, mirrored or
 * sheared by any affine matrix without building anything anew.
 *
 * Lights: every light that is switched on casts, but headlights, whose shadows cannot be seen, and
 * of several camera lights (a light kit) only the brightest. SetCastShadow(bool, vtkLight*) says
 * otherwise. Note that a positional vtkLight has a cone of 30 degrees unless told otherwise: set
 * 180 for a point light.
 *
 * Settings that are given a value out of their range take the nearest one in it; a value that is
 * not a number changes nothing and leads to a warning.
 *
 * Observers of ProgressEvent may do as they like: draw other windows, with this pass too, change
 * meshes, drop the pass. The frame is then collected once more.
 *
 * Method: Huang and Cheng, "A Rendering Method Using Sparse Voxel Octrees in Dynamic Scenes",
 * 2017. The paper's Z-buffer tables ZBT and SZBT are the depth buffer and the shadow buffers here.
 *
 * The pass takes the place of VTK's default pipeline (renderer->SetPass(pass)), or that of
 * vtkRenderStepsPass in a chain of passes, inside a vtkCameraPass or without one. It may be set on
 * several renderers; statistics are those of the one rendered last. A host that keeps the
 * renderer's passes to itself, as ParaView does, calls Attach() instead.
 *
 * @sa vtkPolyDataToSVO vtkSparseVoxelOctree
 */
#ifndef vtkSVORenderPass_h
#define vtkSVORenderPass_h

#include "vtkOpenGLRenderPass.h"
#include "vtkSVOPassModule.h" // for the export macro

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <string>     // for std::string

class vtkInformationDoubleKey;
class vtkInformationIntegerKey;
class vtkLight;
class vtkMultiProcessController;
class vtkProp;
class vtkRenderWindow;
class vtkRenderer;
#ifndef __VTK_WRAP__
namespace svo
{
class OwnCamera;
class Tracer;
struct PassFrame;
}
#endif

class VTKSVOPASS_EXPORT vtkSVORenderPass : public vtkOpenGLRenderPass
{
public:
  static vtkSVORenderPass* New();
  vtkTypeMacro(vtkSVORenderPass, vtkOpenGLRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum BackendType
  {
    BACKEND_AUTO = 0,
    BACKEND_CPU = 1,
    BACKEND_OPENGL = 2
  };

  enum ShadowTechniqueType
  {
    SHADOW_NONE = 0,
    SHADOW_BUFFER = 1,
    SHADOW_RAYS = 2,
    SHADOW_AUTOMATIC = 3
  };

  enum LeafGeometryType
  {
    LEAF_VOXEL = 0,
    LEAF_PLANE = 1,
    LEAF_TRIANGLE = 2,
    LEAF_AUTOMATIC = 3
  };

  //@{
  /**
   * Where rays are traced. Auto (the default) takes the fastest that is there. This version has the
   * CPU; asking for OpenGL warns once and uses the CPU.
   */
  virtual void SetBackend(int backend);
  vtkGetMacro(Backend, int);
  void SetBackendToAuto() { this->SetBackend(BACKEND_AUTO); }
  void SetBackendToCPU() { this->SetBackend(BACKEND_CPU); }
  void SetBackendToOpenGL() { this->SetBackend(BACKEND_OPENGL); }
  //@}

  /**
   * The backend that is used: BACKEND_CPU or BACKEND_OPENGL.
   */
  int GetActiveBackend() const { return BACKEND_CPU; }

  //@{
  /**
   * How shadows are found: not at all, by a shadow buffer per light that is traced like the picture
   * itself (the default), or by one ray to each light from each visible point, the exact reference.
   * With rays, rasterised surfaces still receive from shadow buffers.
   * Automatic takes buffers, whatever the scene and wherever its data lies. See
   * GetNumberOfLightsWithShadowRays().
   */
  vtkSetClampMacro(ShadowTechnique, int, SHADOW_NONE, SHADOW_AUTOMATIC);
  vtkGetMacro(ShadowTechnique, int);
  void SetShadowTechniqueToNone() { this->SetShadowTechnique(SHADOW_NONE); }
  void SetShadowTechniqueToShadowBuffer() { this->SetShadowTechnique(SHADOW_BUFFER); }
  void SetShadowTechniqueToShadowRays() { this->SetShadowTechnique(SHADOW_RAYS); }
  void SetShadowTechniqueToAutomatic() { this->SetShadowTechnique(SHADOW_AUTOMATIC); }
  //@}

  //@{
  /**
   * Texels along an edge of one shadow map, 16..16384; default 2048. A directional or spot light
   * has one map. So has a point light whose casters subtend less than 120 degrees, otherwise it has
   * the six faces of a cube. Where a texel of such a map would look wider than 16 pixels, as with a
   * terrain or a large ground that casts, maps of so many texels are fitted to what is seen.
   * Where all of them would take more than ShadowMemoryLimit they have fewer.
   */
  vtkSetClampMacro(ShadowBufferResolution, int, 16, 16384);
  vtkGetMacro(ShadowBufferResolution, int);
  //@}

  //@{
  /**
   * Compare depths on the receiver's own plane, at the texel's own ray (Dou et al., JCGT 2014), so
   * that a surface does not shade itself. Default on.
   */
  vtkSetMacro(AutomaticShadowBias, bool);
  vtkGetMacro(AutomaticShadowBias, bool);
  vtkBooleanMacro(AutomaticShadowBias, bool);
  //@}

  //@{
  /**
   * What is added to the depth of a shadow map before the comparison, in voxels of the caster,
   * 0..1000; default 0. With AutomaticShadowBias off, 0 is the paper's bare "distance > depth".
   */
  virtual void SetShadowBias(double voxels)
  {
    this->SetNumber("ShadowBias", voxels, 0.0, 1000.0, this->ShadowBias);
  }
  virtual double GetShadowBiasMinValue() { return 0.0; }
  virtual double GetShadowBiasMaxValue() { return 1000.0; }
  vtkGetMacro(ShadowBias, double);
  //@}

  //@{
  /**
   * Share of a light's diffuse and specular light that a shadow removes, 0..1; default 1. Ambient
   * light always stays.
   */
  virtual void SetShadowIntensity(double share)
  {
    this->SetNumber("ShadowIntensity", share, 0.0, 1.0, this->ShadowIntensity);
  }
  virtual double GetShadowIntensityMinValue() { return 0.0; }
  virtual double GetShadowIntensityMaxValue() { return 1.0; }
  vtkGetMacro(ShadowIntensity, double);
  //@}

  //@{
  /**
   * Whether what is translucent casts shadows as light as it is: by the opacity of properties and
   * blocks, and by the alpha of lookup tables, opacity arrays and colour arrays. Each such surface
   * takes from a ray of light the share of its opacity where the ray meets it first, so that a
   * closed body counts once and opacities of 0 and 1 are what invisible and opaque surfaces are.
   * Several surfaces multiply what they leave; SetCastShadow(true, prop) has all of a surface cast
   * like an opaque one. The alpha of textures does not count. Default on. Off, what is translucent
   * casts nothing, and a message says so.
   */
  vtkSetMacro(TranslucentShadows, bool);
  vtkGetMacro(TranslucentShadows, bool);
  vtkBooleanMacro(TranslucentShadows, bool);
  //@}

  //@{
  /**
   * Speed against accuracy: rays stop at the octree level whose voxels appear no larger than this
   * many pixels, 0..64; default 1. 0 always goes to the octree's full depth. Surfaces whose leaf
   * geometry is triangles or automatic and whose triangles are larger than about a pixel are
   * traced to the triangles themselves whatever is set here: that is faster, and exact. So are
   * those of smaller ones, up to about 64 in a voxel of this size.
   */
  virtual void SetPixelError(double pixels)
  {
    this->SetNumber("PixelError", pixels, 0.0, 64.0, this->PixelError);
  }
  virtual double GetPixelErrorMinValue() { return 0.0; }
  virtual double GetPixelErrorMaxValue() { return 64.0; }
  vtkGetMacro(PixelError, double);
  //@}

  //@{
  /**
   * Build an octree for each surface that comes without one; default on. Otherwise only meshes that
   * went through vtkPolyDataToSVO are traced and cast shadows.
   */
  vtkSetMacro(ConvertPolyData, bool);
  vtkGetMacro(ConvertPolyData, bool);
  vtkBooleanMacro(ConvertPolyData, bool);
  //@}

  //@{
  /**
   * Level of the deepest octrees that the pass builds: 2^level voxels along an edge of the mesh's
   * cube, 1..20; default 10. They are built no deeper than PixelError asks for, by the pixels of
   * the picture and by the texels of the shadow buffers, and are deepened when the camera comes
   * closer: see BuildInBackground. With a PixelError of 0, and for exact shadow rays, all are of
   * this level.
   */
  vtkSetClampMacro(MaximumLevel, int, 1, 20);
  vtkGetMacro(MaximumLevel, int);
  //@}

  //@{
  /**
   * What a ray meets in a leaf of the octrees that the pass builds; see vtkPolyDataToSVO. Default
   * automatic.
   */
  vtkSetClampMacro(LeafGeometry, int, LEAF_VOXEL, LEAF_AUTOMATIC);
  vtkGetMacro(LeafGeometry, int);
  void SetLeafGeometryToVoxel() { this->SetLeafGeometry(LEAF_VOXEL); }
  void SetLeafGeometryToPlane() { this->SetLeafGeometry(LEAF_PLANE); }
  void SetLeafGeometryToTriangle() { this->SetLeafGeometry(LEAF_TRIANGLE); }
  void SetLeafGeometryToAutomatic() { this->SetLeafGeometry(LEAF_AUTOMATIC); }
  //@}

  //@{
  /**
   * Memory for octrees that the pass keeps, in KiB; default 1 GiB. Those that the current frame
   * does not need go first, so the poses of an animated mesh are built once as long as they fit; of
   * a loop that is longer as many poses are kept as there is room for. Octrees of meshes that are
   * deleted go at once. What a single frame needs is kept in any case, with a warning where that is
   * more. Passes of one process share octrees of the same mesh.
   */
  vtkSetClampMacro(OctreeMemoryLimit, vtkIdType, 0, VTK_ID_MAX / 1024);
  vtkGetMacro(OctreeMemoryLimit, vtkIdType);
  //@}

  /**
   * Frees the octrees that the pass keeps, and ends what is built in the background; the next frame
   * builds what it needs. During a frame: when it is through.
   */
  void ReleaseOctrees();

  //@{
  /**
   * While the user interacts (the render window's desired update rate is 1 Hz or more), build
   * octrees in the background. Until they are there surfaces are traced through octrees of another
   * level if there are any, and rasterised if there are none. A still render waits for them, and
   * invokes ProgressEvent meanwhile: its picture depends neither on time nor on what was shown
   * before. An observer of it, or of the render window's AbortCheckEvent, that sets the window's
   * AbortRender ends the wait: surfaces whose octrees are not there yet are left to the rasteriser,
   * of which VTK shows as much as of any frame that is aborted. Default on.
   */
  vtkSetMacro(BuildInBackground, bool);
  vtkGetMacro(BuildInBackground, bool);
  vtkBooleanMacro(BuildInBackground, bool);
  //@}

  //@{
  /**
   * Keep what was traced of each object until its own matrix, octree, level of detail or the
   * viewpoint changes; default on. The picture is the same either way.
   */
  vtkSetMacro(FrameCoherence, bool);
  vtkGetMacro(FrameCoherence, bool);
  vtkBooleanMacro(FrameCoherence, bool);
  //@}

  //@{
  /**
   * Memory for what FrameCoherence keeps, in KiB; default 512 MiB.
   */
  vtkSetClampMacro(LayerMemoryLimit, vtkIdType, 0, VTK_ID_MAX / 1024);
  vtkGetMacro(LayerMemoryLimit, vtkIdType);
  //@}

  //@{
  /**
   * Smooth edges of shadows: shadow buffers give a share of each light, from all texels around a
   * point, compared with the planes of its surface, so that neither texels nor pixels show as
   * steps, on traced and on rasterised surfaces; default off: yes or no, from the texel that a
   * point lies in. Frames take 1.4 to 2.1 times as long where everything is shaded anew. That needs
   * AutomaticShadowBias; without it, and with exact shadow rays, there is no effect.
   */
  vtkSetMacro(FilterShadows, bool);
  vtkGetMacro(FilterShadows, bool);
  vtkBooleanMacro(FilterShadows, bool);
  //@}

  //@{
  /**
   * Memory that shadow buffers may take together, in KiB; default 4 GiB. It counts the tiles of
   * texels that casters lie in, of opaque casters and of groups of translucent ones, and where
   * rasterised surfaces receive shadows the copies for them, OpenGL's included; layers that
   * FrameCoherence keeps have LayerMemoryLimit. What the tiles will take at most follows from the
   * casters' boxes. Where that is more, all maps have half as many texels along an edge, or a
   * quarter, and so on, and a message says so once. A map has sixteen at least.
   */
  vtkSetClampMacro(ShadowMemoryLimit, vtkIdType, 0, VTK_ID_MAX / 1024);
  vtkGetMacro(ShadowMemoryLimit, vtkIdType);
  //@}

  //@{
  /**
   * Smooth edges inside and between traced surfaces, and those of shadows, with four rays in each
   * of their pixels; default off. It filters shadows as FilterShadows does, whether that is on or
   * off. Silhouettes and edges between facets follow the render window's SetMultiSamples instead,
   * as those of everything that VTK draws.
   */
  vtkSetMacro(AntiAliasing, bool);
  vtkGetMacro(AntiAliasing, bool);
  vtkBooleanMacro(AntiAliasing, bool);
  //@}

  //@{
  /**
   * While the user interacts (the render window's desired update rate is 1 Hz or more): whether
   * rays are as far apart as it takes to keep to half of the time for a frame, up to
   * MaximumImageSampleDistance pixels. Default on, and 8 (1..64). All of a window's renderers with
   * a pass share that time, with rays equally far apart. Shadow maps of camera lights, which are
   * traced in every frame, get coarser first, by at most as much; rays follow where that does not
   * save enough. Other frames have a ray for each pixel and do not depend on the time that
   * anything takes. Named as in vtkGPUVolumeRayCastMapper.
   */
  vtkSetMacro(AutoAdjustSampleDistances, bool);
  vtkGetMacro(AutoAdjustSampleDistances, bool);
  vtkBooleanMacro(AutoAdjustSampleDistances, bool);
  virtual void SetMaximumImageSampleDistance(double pixels)
  {
    this->SetNumber(
      "MaximumImageSampleDistance", pixels, 1.0, 64.0, this->MaximumImageSampleDistance);
  }
  virtual double GetMaximumImageSampleDistanceMinValue() { return 1.0; }
  virtual double GetMaximumImageSampleDistanceMaxValue() { return 64.0; }
  vtkGetMacro(MaximumImageSampleDistance, double);
  //@}

  //@{
  /**
   * For a host that enlarges what it renders, as ParaView's servers do while the user interacts:
   * how many pixels of the window a pixel of the frame becomes, along an edge, 1..50; default 1.
   * MaximumImageSampleDistance holds in the window. Named as in vtkSynchronizedRenderers.
   */
  vtkSetClampMacro(ImageReductionFactor, int, 1, 50);
  vtkGetMacro(ImageReductionFactor, int);
  //@}

  //@{
  /**
   * Whether instances that lie outside of a view are found together, by a loose octree of all
   * instances, instead of one by one, and whether those that others hide are left out before they
   * are traced. Both default to on. The picture is the same to the bit.
   */
  vtkSetMacro(ViewCulling, bool);
  vtkGetMacro(ViewCulling, bool);
  vtkBooleanMacro(ViewCulling, bool);
  vtkSetMacro(OcclusionCulling, bool);
  vtkGetMacro(OcclusionCulling, bool);
  vtkBooleanMacro(OcclusionCulling, bool);
  //@}

  //@{
  /**
   * While the user interacts (the window asks for at least a frame a second), instances the
   * rectangles around which have fewer pixels of the window than this are not drawn; they still
   * cast. 0 or more; default 0: all are drawn. Other frames show all in any case.
   * GetAcceptedPixelError() says how long the edges of what was left out were.
   */
  virtual void SetDetailCullingThreshold(double pixels)
  {
    this->SetNumber("DetailCullingThreshold", pixels, 0.0, 1e6, this->DetailCullingThreshold);
  }
  virtual double GetDetailCullingThresholdMinValue() { return 0.0; }
  virtual double GetDetailCullingThresholdMaxValue() { return 1e6; }
  vtkGetMacro(DetailCullingThreshold, double);
  //@}

  /**
   * Pixels of the window from ray to ray in the last frame.
   */
  double GetImageSampleDistance() const;

  /**
   * The pixel error that the last frame accepted, in pixels of the window: PixelError, or where
   * rays were more than a pixel apart to save time, at least the distance from ray to ray; at
   * least the texels, as wide as they look, of shadow maps that were made coarser to save time; at
   * least the voxels of octrees that were shown while deeper ones were built; and at least what
   * DetailCullingThreshold left out.
   */
  double GetAcceptedPixelError() const;

  //@{
  /**
   * Whether a prop casts shadows; without an answer every surface does that is to be seen, and what
   * is translucent as light as it is: see SetTranslucentShadows(). Of surfaces whose colours, by
   * lookup table, opacity array or block, are invisible in places, the other cells do. An answer of
   * true has all of a surface cast, like an opaque one, and like one that its mapper does not clip;
   * without that, what a mapper clips casts nothing. Get says what the next frame will do as far
   * as it depends on the prop, and false of what never casts: wireframes, volumes, widgets, props
   * that are not visible.
   */
  static void SetCastShadow(bool cast, vtkProp* prop);
  static bool GetCastShadow(vtkProp* prop);
  //@}

  /**
   * Why a prop is left to the rasteriser, or casts no shadow or less than its whole one: sentences
   * for people. Empty if it is traced and casts. Like GetCastShadow() it goes by the prop alone,
   * and takes it for granted that TranslucentShadows is on.
   */
  static std::string GetReason(vtkProp* prop);

  //@{
  /**
   * Whether a light casts shadows; without an answer every light does but a headlight and, of
   * several camera lights, all but the brightest. Get says what the next frame will do: false of a
   * light that is switched off, and of a camera light whether it is the brightest of the renderer
   * that a pass has drawn it in last. Until it has been drawn it counts as the only one.
   */
  static void SetCastShadow(bool cast, vtkLight* light);
  static bool GetCastShadow(vtkLight* light);
  //@}

  //@{
  /**
   * Whether shadows fall on a prop; default true.
   */
  static void SetReceiveShadow(bool receive, vtkProp* prop);
  static bool GetReceiveShadow(vtkProp* prop);
  //@}

  //@{
  /**
   * Whether nothing is seen of an actor but the shadows on it; default false. What is behind it,
   * the background in most cases, is darkened by the share of the light that shadows take from a
   * white surface in its place, times the opacity of the actor's property; where no shadow falls
   * nothing is changed. In pictures with a transparent background a shadow is black, and
   * transparent where it is light. It is drawn among translucent surfaces (ForceTranslucent of the
   * actor is switched on, and off again), takes part in depth peeling as they do, and casts
   * nothing. Its colours and specular light do not matter; a physically based material hides it,
   * and so do lights that cast nothing. Without this pass it is an ordinary surface.
   */
  static void SetShadowCatcher(bool catches, vtkProp* actor);
  static bool GetShadowCatcher(vtkProp* actor);
  //@}

  //@{
  /**
   * Whether a prop may be traced at all; default true. False leaves it to the rasteriser; it casts
   * and receives shadows as before.
   */
  static void SetUseSVO(bool use, vtkProp* prop);
  static bool GetUseSVO(vtkProp* prop);
  //@}

  //@{
  /**
   * A prop's own PixelError, 0..64; negative (the default): the pass's. Not a number: refused, with
   * a warning.
   */
  static void SetPropPixelError(double error, vtkProp* prop);
  static double GetPropPixelError(vtkProp* prop);
  //@}

  //@{
  /**
   * Keys behind the static helpers above. Those of props live in vtkProp::GetPropertyKeys() and are
   * not copied by vtkProp::ShallowCopy(); those of lights in vtkLight::GetInformation().
   */
  static vtkInformationIntegerKey* CAST_SHADOW();
  static vtkInformationIntegerKey* RECEIVE_SHADOW();
  static vtkInformationIntegerKey* USE_SVO();
  static vtkInformationIntegerKey* SHADOW_CATCHER();
  static vtkInformationDoubleKey* PIXEL_ERROR();
  //@}

  //@{
  /**
   * Wall-clock times of the last frame in seconds: finding what there is to trace (octrees that had
   * to be built included), tracing and shading, shadow buffers or rays, and handing the picture to
   * OpenGL.
   */
  double GetCollectTime() const;
  double GetTraceTime() const;
  double GetShadowTime() const;
  double GetPresentTime() const;
  //@}

  //@{
  /**
   * The work of the last frame: rays from the eye, rays (or texels) from and to lights, and layers
   * (one object seen from the eye or from a light) that could not be reused.
   */
  vtkIdType GetNumberOfPrimaryRays() const;
  vtkIdType GetNumberOfShadowRays() const;
  vtkIdType GetNumberOfRetracedLayers() const;
  //@}

  //@{
  /**
   * How the shadows of the last frame's casting lights were found: for so many of them by buffers,
   * for so many by rays.
   */
  int GetNumberOfLightsWithShadowBuffers() const;
  int GetNumberOfLightsWithShadowRays() const;
  //@}

  //@{
  /**
   * Actors of the last frame (parts of assemblies counted one by one): visible ones that were
   * traced, visible surfaces that were left to the rasteriser, and instances of octrees (a
   * composite actor has one for each block).
   */
  int GetNumberOfTracedActors() const;
  int GetNumberOfRasterizedActors() const;
  int GetNumberOfInstances() const;
  //@}

  enum CullingSteps
  {
    CULLED_BY_VIEW = 0,      // they lie outside of the view
    CULLED_BY_OCCLUSION = 1, // others hide them
    CULLED_BY_DETAIL = 2,    // they are too small: DetailCullingThreshold
    CULLED_CASTERS = 3       // of lights' maps, once a map: what they shadow is not seen
  };

  //@{
  /**
   * Instances that the last frame that was traced did not have to look at, by step; without one,
   * those of the first three together, which are the eye's.
   */
  vtkIdType GetNumberOfCulledInstances(int step) const;
  vtkIdType GetNumberOfCulledInstances() const;
  //@}

  /**
   * Which lights cast shadows, for people: a line for each light that was switched on in the last
   * frame, in the renderer's order.
   */
  const char* GetCastingLights() const;

  //@{
  /**
   * Octrees that the pass has built so far (a mesh that is seen from far and from near has
   * several), and those that are built in the background at this moment: as long as there are any,
   * another render will show more than the last one.
   */
  int GetNumberOfOctreesBuilt() const;
  int GetNumberOfOctreesInProgress() const;
  //@}

  //@{
  /**
   * Memory in KiB: kept layers, shadow buffers (see SetShadowMemoryLimit()), and the octrees that
   * the pass built itself.
   */
  vtkIdType GetLayerMemorySize() const;
  vtkIdType GetShadowMemorySize() const;
  vtkIdType GetOctreeMemorySize() const;
  //@}

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
   * Whether in attached renderers all surfaces are traced and cast shadows, as far as they can, and
   * not only those with an explicit SetUseSVO(true); default off. The octrees of the others are
   * built by the pass. There are no messages about them: GetReasonInLastFrame() says what of them
   * casts nothing. (Where the pass is set on a renderer this is so in any case.)
   */
  vtkSetMacro(ShadowsForEverything, bool);
  vtkGetMacro(ShadowsForEverything, bool);
  vtkBooleanMacro(ShadowsForEverything, bool);
  //@}

  /**
   * As GetReason(), but of a prop of an attached renderer in the last frame: empty if it cast its
   * shadow and was traced, or did not have to be, or if it was not there.
   */
  std::string GetReasonInLastFrame(vtkProp* prop) const;

  //@{
  /**
   * Off: frames of attached renderers are left to the rasteriser, for a host that needs the mesh's
   * own depth, as a selection of points does. Default on. It is asked at the renderer's StartEvent,
   * after observers of priority 0.
   */
  vtkSetMacro(Tracing, bool);
  vtkGetMacro(Tracing, bool);
  vtkBooleanMacro(Tracing, bool);
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
  /**
   * A tracer for a renderer, which is asked for all of its frames. This one runs on the processor;
   * a subclass may have another (svoTracer.h).
   */
  virtual std::unique_ptr<svo::Tracer> MakeTracer() const;
#endif

  int Backend = BACKEND_AUTO;
  int ShadowTechnique = SHADOW_BUFFER;
  int ShadowBufferResolution = 2048;
  bool AutomaticShadowBias = true;
  double ShadowBias = 0.0;
  double ShadowIntensity = 1.0;
  bool TranslucentShadows = true;
  double PixelError = 1.0;
  bool ConvertPolyData = true;
  int MaximumLevel = 10;
  int LeafGeometry = LEAF_AUTOMATIC;
  vtkIdType OctreeMemoryLimit = 1024 * 1024;
  bool BuildInBackground = true;
  bool FrameCoherence = true;
  vtkIdType LayerMemoryLimit = 512 * 1024;
  bool FilterShadows = false;
  vtkIdType ShadowMemoryLimit = 4 * 1024 * 1024;
  bool AntiAliasing = false;
  bool ShadowsForEverything = false;
  bool Tracing = true;
  bool AutoAdjustSampleDistances = true;
  double MaximumImageSampleDistance = 8.0;
  int ImageReductionFactor = 1;
  bool ViewCulling = true;
  bool OcclusionCulling = true;
  double DetailCullingThreshold = 0.0;

private:
  vtkSVORenderPass(const vtkSVORenderPass&) = delete;
  void operator=(const vtkSVORenderPass&) = delete;

  /// Clamps a value to its range; one that is not a number is refused with a warning.
  void SetNumber(const char* name, double value, double least, double most, double& setting);

  void BeginAttachedFrame(vtkObject* renderer, unsigned long event, void* data);
  void EndAttachedFrame(vtkObject* renderer, unsigned long event, void* data);
  void ForgetAttached(vtkObject* renderer, unsigned long event, void* data);
#ifndef __VTK_WRAP__
  svo::PassFrame& BeginFrame(vtkRenderer* renderer);
  bool CollectFrame(svo::PassFrame& frame, int width, int height, const svo::OwnCamera* camera);
  std::function<bool()> AbortOf(vtkRenderWindow* window, bool ask, bool& disturbed);
  void DecideSettings(svo::PassFrame& frame);
  void TraceFrame(svo::PassFrame& frame, int width, int height);
  void FinishFrame(svo::PassFrame& frame);
#endif

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
