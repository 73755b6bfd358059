// The render pass without a window: defaults, ranges, and what props and lights carry.
#include "svoTestMessages.h"
#include "vtkPolyDataToSVO.h"
#include "vtkSVORenderPass.h"

#include "svoLayout.h"
#include "svoTracerSettings.h"

#include "vtkActor.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSkybox.h"
#include "vtkSphereSource.h"
#include "vtkVolume.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

// Scripts and states of 0.2 rely on them.
TEST(RenderPassSettings, DefaultsStay)
{
  vtkNew<vtkSVORenderPass> pass;
  EXPECT_EQ(pass->GetActiveBackend(), vtkSVORenderPass::BACKEND_CPU);
  EXPECT_EQ(pass->GetShadowTechnique(), vtkSVORenderPass::SHADOW_BUFFER);
  EXPECT_EQ(pass->GetShadowBufferResolution(), 2048);
  EXPECT_EQ(pass->GetShadowIntensity(), 1.0);
  EXPECT_FALSE(pass->GetFilterShadows());
  EXPECT_TRUE(pass->GetTranslucentShadows());
  EXPECT_EQ(pass->GetPixelError(), 1.0);
  EXPECT_EQ(pass->GetMaximumLevel(), 10);
  EXPECT_EQ(pass->GetLeafGeometry(), vtkSVORenderPass::LEAF_AUTOMATIC);
  EXPECT_EQ(pass->GetOctreeMemoryLimit(), 1024 * 1024);
  EXPECT_FALSE(pass->GetAntiAliasing());
}

// Numbers are handed on as they are.
TEST(RenderPassSettings, ChoicesAreThoseOfTheTracer)
{
  using Pass = vtkSVORenderPass;
  EXPECT_EQ(static_cast<int>(Pass::SHADOW_NONE), static_cast<int>(svo::ShadowTechnique::None));
  EXPECT_EQ(static_cast<int>(Pass::SHADOW_BUFFER), static_cast<int>(svo::ShadowTechnique::Buffer));
  EXPECT_EQ(static_cast<int>(Pass::SHADOW_RAYS), static_cast<int>(svo::ShadowTechnique::Rays));
  EXPECT_EQ(static_cast<int>(Pass::LEAF_VOXEL), static_cast<int>(svo::LeafGeometry::Voxel));
  EXPECT_EQ(static_cast<int>(Pass::LEAF_PLANE), static_cast<int>(svo::LeafGeometry::Plane));
  EXPECT_EQ(static_cast<int>(Pass::LEAF_TRIANGLE), static_cast<int>(svo::LeafGeometry::Triangle));
  EXPECT_EQ(static_cast<int>(Pass::LEAF_AUTOMATIC), static_cast<int>(svo::LeafGeometry::Automatic));
  EXPECT_EQ(static_cast<int>(vtkPolyDataToSVO::VOXEL), static_cast<int>(Pass::LEAF_VOXEL));
  EXPECT_EQ(static_cast<int>(vtkPolyDataToSVO::PLANE), static_cast<int>(Pass::LEAF_PLANE));
  EXPECT_EQ(static_cast<int>(vtkPolyDataToSVO::TRIANGLE), static_cast<int>(Pass::LEAF_TRIANGLE));
  EXPECT_EQ(static_cast<int>(vtkPolyDataToSVO::AUTOMATIC), static_cast<int>(Pass::LEAF_AUTOMATIC));

  vtkNew<Pass> pass;
  pass->SetMaximumLevel(100);
  EXPECT_EQ(pass->GetMaximumLevel(), svo::MaximumLevel);
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetMaximumLevel(100);
  EXPECT_EQ(filter->GetMaximumLevel(), svo::MaximumLevel);
}

TEST(RenderPassSettings, ValuesOutOfRangeAreClamped)
{
  vtkNew<vtkSVORenderPass> pass;
  pass->SetShadowBufferResolution(1);
  EXPECT_EQ(pass->GetShadowBufferResolution(), 16);
  pass->SetShadowBias(-1.0);
  EXPECT_EQ(pass->GetShadowBias(), 0.0);
  pass->SetShadowIntensity(2.0);
  EXPECT_EQ(pass->GetShadowIntensity(), 1.0);
  pass->SetPixelError(-1.0);
  EXPECT_EQ(pass->GetPixelError(), 0.0);
  pass->SetMaximumLevel(0);
  EXPECT_EQ(pass->GetMaximumLevel(), 1);
  pass->SetMaximumLevel(21);
  EXPECT_EQ(pass->GetMaximumLevel(), 20);
  pass->SetLayerMemoryLimit(-1);
  EXPECT_EQ(pass->GetLayerMemoryLimit(), 0);
  pass->SetBackend(-3);
  EXPECT_EQ(pass->GetBackend(), vtkSVORenderPass::BACKEND_AUTO);
}

// They would pass every comparison with the ends of a range.
TEST(RenderPassSettings, WhatIsNotANumberIsRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  vtkNew<vtkSVORenderPass> pass;
  svo::TestMessages messages(pass);
  pass->SetShadowBias(2.0);
  pass->SetShadowIntensity(0.5);
  pass->SetPixelError(3.0);
  pass->SetMaximumImageSampleDistance(4.0);
  const vtkMTimeType time = pass->GetMTime();
  pass->SetShadowBias(nan);
  pass->SetShadowIntensity(nan);
  pass->SetPixelError(nan);
  pass->SetMaximumImageSampleDistance(nan);
  EXPECT_EQ(pass->GetShadowBias(), 2.0);
  EXPECT_EQ(pass->GetShadowIntensity(), 0.5);
  EXPECT_EQ(pass->GetPixelError(), 3.0);
  EXPECT_EQ(pass->GetMaximumImageSampleDistance(), 4.0);
  EXPECT_EQ(pass->GetMTime(), time);
  EXPECT_EQ(messages.warnings.size(), 4u);
  pass->SetShadowBias(infinity);
  EXPECT_EQ(pass->GetShadowBias(), pass->GetShadowBiasMaxValue());
  pass->SetMaximumImageSampleDistance(-infinity);
  EXPECT_EQ(pass->GetMaximumImageSampleDistance(), 1.0);

  vtkNew<vtkActor> actor;
  vtkSVORenderPass::SetPropPixelError(2.0, actor);
  vtkObject::GlobalWarningDisplayOff();
  vtkSVORenderPass::SetPropPixelError(nan, actor);
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(vtkSVORenderPass::GetPropPixelError(actor), 2.0);
}

TEST(RenderPassSettings, NamedSettersChooseTheirValue)
{
  vtkNew<vtkSVORenderPass> pass;
  pass->SetBackendToCPU();
  EXPECT_EQ(pass->GetBackend(), vtkSVORenderPass::BACKEND_CPU);
  pass->SetShadowTechniqueToNone();
  EXPECT_EQ(pass->GetShadowTechnique(), vtkSVORenderPass::SHADOW_NONE);
  pass->SetShadowTechniqueToShadowRays();
  EXPECT_EQ(pass->GetShadowTechnique(), vtkSVORenderPass::SHADOW_RAYS);
  pass->SetShadowTechniqueToAutomatic();
  EXPECT_EQ(pass->GetShadowTechnique(), vtkSVORenderPass::SHADOW_AUTOMATIC);
  pass->SetShadowTechniqueToShadowBuffer();
  EXPECT_EQ(pass->GetShadowTechnique(), vtkSVORenderPass::SHADOW_BUFFER);
  pass->SetLeafGeometryToVoxel();
  EXPECT_EQ(pass->GetLeafGeometry(), vtkSVORenderPass::LEAF_VOXEL);
  pass->SetLeafGeometryToPlane();
  EXPECT_EQ(pass->GetLeafGeometry(), vtkSVORenderPass::LEAF_PLANE);
  pass->SetLeafGeometryToTriangle();
  EXPECT_EQ(pass->GetLeafGeometry(), vtkSVORenderPass::LEAF_TRIANGLE);
}

TEST(RenderPassSettings, TheBackendIsActiveFromItsFirstFrameOn)
{
  vtkNew<vtkSVORenderPass> pass;
  pass->SetBackendToOpenGL();
  EXPECT_EQ(pass->GetBackend(), vtkSVORenderPass::BACKEND_OPENGL);
  EXPECT_EQ(pass->GetActiveBackend(), vtkSVORenderPass::BACKEND_CPU);
}

TEST(RenderPassSettings, PropsAnswerForThemselves)
{
  vtkNew<vtkActor> actor;
  EXPECT_TRUE(vtkSVORenderPass::GetCastShadow(actor));
  EXPECT_TRUE(vtkSVORenderPass::GetReceiveShadow(actor));
  EXPECT_TRUE(vtkSVORenderPass::GetUseSVO(actor));
  vtkSVORenderPass::SetCastShadow(false, actor);
  vtkSVORenderPass::SetReceiveShadow(false, actor);
  vtkSVORenderPass::SetUseSVO(false, actor);
  EXPECT_FALSE(vtkSVORenderPass::GetCastShadow(actor));
  EXPECT_FALSE(vtkSVORenderPass::GetReceiveShadow(actor));
  EXPECT_FALSE(vtkSVORenderPass::GetUseSVO(actor));
}

TEST(RenderPassSettings, ATranslucentPropCastsAnInvisibleOneDoesNot)
{
  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->GetProperty()->SetOpacity(0.5);
  EXPECT_TRUE(vtkSVORenderPass::GetCastShadow(actor));
  actor->SetMapper(mapper);
  EXPECT_TRUE(vtkSVORenderPass::GetCastShadow(actor));
  EXPECT_EQ(vtkSVORenderPass::GetReason(actor), "Left to the rasteriser: it is translucent.");
  actor->GetProperty()->SetOpacity(0.0);
  EXPECT_FALSE(vtkSVORenderPass::GetCastShadow(actor));
  vtkSVORenderPass::SetCastShadow(true, actor);
  EXPECT_TRUE(vtkSVORenderPass::GetCastShadow(actor));
  vtkNew<vtkSVORenderPass> pass;
  EXPECT_TRUE(pass->GetTranslucentShadows());
  pass->TranslucentShadowsOff();
  EXPECT_FALSE(pass->GetTranslucentShadows());
}

TEST(RenderPassSettings, AHeadlightCastsOnlyWhenAsked)
{
  vtkNew<vtkLight> light;
  EXPECT_TRUE(vtkSVORenderPass::GetCastShadow(light));
  vtkSVORenderPass::SetCastShadow(false, light);
  EXPECT_FALSE(vtkSVORenderPass::GetCastShadow(light));

  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  EXPECT_FALSE(vtkSVORenderPass::GetCastShadow(headlight));
  vtkSVORenderPass::SetCastShadow(true, headlight);
  EXPECT_TRUE(vtkSVORenderPass::GetCastShadow(headlight));
}

TEST(RenderPassSettings, WhatNeverCastsSaysSoAndWhy)
{
  using Pass = vtkSVORenderPass;
  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  EXPECT_TRUE(Pass::GetCastShadow(actor));
  EXPECT_EQ(Pass::GetReason(actor), "");

  actor->GetProperty()->SetRepresentationToWireframe();
  EXPECT_FALSE(Pass::GetCastShadow(actor));
  Pass::SetCastShadow(true, actor); // nothing helps
  EXPECT_FALSE(Pass::GetCastShadow(actor));
  EXPECT_NE(Pass::GetReason(actor).find("wireframe"), std::string::npos);

  actor->GetProperty()->SetRepresentationToSurface();
  EXPECT_TRUE(Pass::GetCastShadow(actor));
  actor->GetProperty()->EdgeVisibilityOn();
  EXPECT_TRUE(Pass::GetCastShadow(actor));
  EXPECT_EQ(Pass::GetReason(actor), "Left to the rasteriser: it shows its edges or vertices.");
  actor->VisibilityOff();
  EXPECT_FALSE(Pass::GetCastShadow(actor));

  vtkNew<vtkVolume> volume;
  EXPECT_FALSE(Pass::GetCastShadow(volume));
  EXPECT_NE(Pass::GetReason(volume).find("neither an actor"), std::string::npos);
  vtkNew<vtkSkybox> sky; // an actor, too
  sky->SetMapper(mapper);
  EXPECT_FALSE(Pass::GetCastShadow(sky));
  EXPECT_EQ(Pass::GetReason(nullptr), "");

  vtkNew<vtkLight> light;
  light->SwitchOff();
  EXPECT_FALSE(Pass::GetCastShadow(light));
}

TEST(RenderPassSettings, NothingIsAskedOfNobody)
{
  vtkSVORenderPass::SetCastShadow(true, static_cast<vtkProp*>(nullptr));
  vtkSVORenderPass::SetCastShadow(true, static_cast<vtkLight*>(nullptr));
  EXPECT_FALSE(vtkSVORenderPass::GetCastShadow(static_cast<vtkProp*>(nullptr)));
  EXPECT_FALSE(vtkSVORenderPass::GetCastShadow(static_cast<vtkLight*>(nullptr)));
}

TEST(RenderPassSettings, PrintsSettingsAndStatistics)
{
  vtkNew<vtkSVORenderPass> pass;
  std::ostringstream text;
  pass->Print(text);
  for (const char* name : { "Backend", "ShadowTechnique", "ActiveBackend", "ShadowMemorySize",
         "NumberOfRasterizedActors", "AcceptedPixelError", "NumberOfOctreesBuilt" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}
