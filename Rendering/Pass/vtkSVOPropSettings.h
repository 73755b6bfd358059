/**
 * @class vtkSVOPropSettings
 * @brief the settings of vtkSVORenderPass that props and lights carry themselves
 */
#ifndef vtkSVOPropSettings_h
#define vtkSVOPropSettings_h

#include "vtkOpenGLRenderPass.h"
#include "vtkSVOPassModule.h" // for the export macro

#include <string> // for std::string

class vtkInformationDoubleKey;
class vtkInformationIntegerKey;
class vtkLight;
class vtkProp;

class VTKSVOPASS_EXPORT vtkSVOPropSettings : public vtkOpenGLRenderPass
{
public:
  vtkTypeMacro(vtkSVOPropSettings, vtkOpenGLRenderPass);

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
   * How large a light is; default 0: a point, whose shadows have sharp edges. Of a positional light
   * the radius of a ball, world units; of a directional one the angle of its disc in the sky,
   * degrees (the sun: 0.533; 170 at most). Its shadows have soft edges on surfaces that are traced,
   * whatever ShadowTechnique is, by as many rays from each visible point as MaximumLightSamples
   * says; how bright it is stays VTK's business. On surfaces that are left to the rasteriser, and
   * in frames of the OpenGL backend, soft edges are estimated from shadow maps, whatever
   * MaximumLightSamples is. Negative or not finite: refused, with a warning. Get knows of the
   * radius for VTK's ray tracing backend as well (vtkOSPRayLightNode::SetRadius()), which counts
   * where this is 0.
   */
  static void SetLightSize(double size, vtkLight* light);
  static double GetLightSize(vtkLight* light);
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
  static vtkInformationDoubleKey* LIGHT_SIZE();
  //@}

protected:
  vtkSVOPropSettings() = default;
  ~vtkSVOPropSettings() override = default;
};

#endif
