// What is opaque casts, whatever makes the rest of a surface translucent or invisible: tables,
// opacity arrays, points and cells without a value, blocks. What casts nothing says so once, and
// casts in silence with TranslucentShadows.
#include "../../Unit/svoTestMessages.h"
#include "svoCompositeMapper.h"
#include "svoTestStage.h"

#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkTexture.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <cstdlib>
#include <functional>
#include <iostream>

namespace
{
using namespace svotest;

// Two plates above the ground, side by side; the left one is the first half of points and cells.
vtkSmartPointer<vtkPolyData> plates(bool left = true)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> squares;
  for (int plate = left ? 0 : 1; plate < 2; ++plate)
  {
    for (int i = 0; i < 36; ++i)
    {
      points->InsertNextPoint(
        -1.3 + 1.4 * plate + 0.24 * (i % 6), -0.6 + 0.24 * (i / 6), 1.0 + 0.02 * (i % 6));
    }
    for (int i = 0; i < 25; ++i)
    {
      const vtkIdType first = points->GetNumberOfPoints() - 36 + 6 * (i / 5) + i % 5;
      const vtkIdType corners[4] = { first, first + 1, first + 7, first + 6 };
      squares->InsertNextCell(4, corners);
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(squares);
  return mesh;
}

// 0 in the first half, 1 in the other.
vtkSmartPointer<vtkFloatArray> halves(vtkIdType count, float first = 0.0f)
{
  auto values = vtkSmartPointer<vtkFloatArray>::New();
  for (vtkIdType i = 0; i < count; ++i)
  {
    values->InsertNextValue(2 * i < count ? first : 1.0f);
  }
  return values;
}

// A colour for each half, with the alpha of the first.
vtkSmartPointer<vtkLookupTable> table(double alpha, double nanAlpha = 1.0)
{
  auto made = vtkSmartPointer<vtkLookupTable>::New();
  made->SetNumberOfTableValues(2);
  made->SetTableValue(0, 0.2, 0.9, 0.3, alpha);
  made->SetTableValue(1, 0.9, 0.4, 0.2, 1.0);
  made->SetNanColor(0.2, 0.9, 0.3, nanAlpha);
  made->SetTableRange(0.0, 1.0);
  return made;
}

struct Case
{
  std::string name;
  std::function<void(vtkPolyData*, vtkMapper*, vtkActor*)> make;
  enum Shadow
  {
    None,
    Half, // of the right plate
    Whole
  } shadow;
  int messages;
  bool gone;            // the left plate is not to be seen
  bool lighter = false; // the rest casts as light as it is with TranslucentShadows
};

struct Scene : Stage
{
  vtkNew<vtkActor> actor;
  // `composite`: the mesh is a block.
  Scene(vtkPolyData* mesh, bool composite, const Case& one)
    : Stage(200, 200)
  {
    this->addGround();
    this->addSun(1.0, -1.5, 4.0);
    this->pass->TranslucentShadowsOff();
    if (composite)
    {
      vtkNew<vtkMultiBlockDataSet> blocks;
      blocks->SetBlock(0, mesh);
      vtkNew<CompositeMapper> mapper;
      vtkNew<vtkCompositeDataDisplayAttributes> attributes;
      mapper->SetCompositeDataDisplayAttributes(attributes);
      mapper->SetInputDataObject(blocks);
      this->actor->SetMapper(mapper);
    }
    else
    {
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputData(mesh);
      this->actor->SetMapper(mapper);
    }
    this->actor->GetMapper()->UseLookupTableScalarRangeOn();
    one.make(mesh, this->actor->GetMapper(), this->actor);
    this->renderer->AddActor(this->actor);
  }
};

std::size_t pixelsBeyond(const Picture& a, const Picture& b, int levels)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
  {
    count += std::abs(int(a.rgb[i]) - int(b.rgb[i])) > levels ||
      std::abs(int(a.rgb[i + 1]) - int(b.rgb[i + 1])) > levels ||
      std::abs(int(a.rgb[i + 2]) - int(b.rgb[i + 2])) > levels;
  }
  return count;
}

// Ground that is not below a plate in the picture, and darker than without shadows.
std::size_t darkened(const Picture& shadowed, const Picture& unshadowed)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < shadowed.size(); ++i)
  {
    count += shadowed.grey(i) < unshadowed.grey(i) - 20.0;
  }
  return count;
}
}

int TestSVOOpacity(int, char*[])
{
  Checks checks;
  const auto byPoints = [](double alpha)
  {
    return [alpha](vtkPolyData* mesh, vtkMapper* mapper, vtkActor*)
    {
      mesh->GetPointData()->SetScalars(halves(mesh->GetNumberOfPoints()));
      mapper->SetLookupTable(table(alpha));
    };
  };
  const auto byCells = [](float first, vtkScalarsToColors* colors)
  {
    return [first, held = vtkSmartPointer<vtkScalarsToColors>(colors)](
             vtkPolyData* mesh, vtkMapper* mapper, vtkActor*)
    {
      mesh->GetCellData()->SetScalars(halves(mesh->GetNumberOfCells(), first));
      mapper->SetLookupTable(held);
    };
  };
  const auto byFunction = [](bool mapsOpacity)
  {
    auto made = vtkSmartPointer<vtkDiscretizableColorTransferFunction>::New();
    made->AddRGBPoint(0.0, 0.2, 0.9, 0.3);
    made->AddRGBPoint(1.0, 0.9, 0.4, 0.2);
    made->SetNanColor(1.0, 1.0, 0.0);
    made->SetNanOpacity(0.0);
    made->DiscretizeOn();
    made->SetNumberOfValues(2);
    if (mapsOpacity)
    {
      vtkNew<vtkPiecewiseFunction> opacity;
      opacity->AddPoint(0.0, 0.0);
      opacity->AddPoint(1.0, 1.0);
      made->SetScalarOpacityFunction(opacity);
      made->EnableOpacityMappingOn();
    }
    made->Build();
    return made;
  };
  const float nan = static_cast<float>(vtkMath::Nan());
  const Case cases[] = {
    { "a table, invisible at points", byPoints(0.0), Case::Half, 0, true },
    { "a table, translucent at points", byPoints(0.5), Case::Half, 1, false, true },
    { "the same, interpolated before mapping",
      [&](vtkPolyData* mesh, vtkMapper* mapper, vtkActor* actor)
      {
        byPoints(0.0)(mesh, mapper, actor);
        mapper->InterpolateScalarsBeforeMappingOn();
      },
      Case::Half, 0, true },
    { "a table, invisible cells", byCells(0.0f, table(0.0)), Case::Half, 0, true },
    { "a table, invisible cells without a value", byCells(nan, table(1.0, 0.0)), Case::Half, 0,
      true },
    { "a transfer function, cells without a value", byCells(nan, byFunction(false)), Case::Half, 0,
      true },
    { "an opacity function", byCells(0.0f, byFunction(true)), Case::Half, 0, true },
    { "a table with translucent colours that nothing has", byCells(1.0f, table(0.5)), Case::Whole,
      0, false },
    { "colours with alpha",
      [](vtkPolyData* mesh, vtkMapper*, vtkActor*)
      {
        vtkNew<vtkUnsignedCharArray> colors;
        colors->SetNumberOfComponents(4);
        for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
        {
          colors->InsertNextTuple4(200, 100, 50, 2 * i < mesh->GetNumberOfPoints() ? 0 : 255);
        }
        mesh->GetPointData()->SetScalars(colors);
      },
      Case::Half, 0, true },
    { "everything invisible",
      [](vtkPolyData* mesh, vtkMapper* mapper, vtkActor*)
      {
        mesh->GetPointData()->SetScalars(halves(mesh->GetNumberOfPoints()));
        const auto clear = table(0.0);
        clear->SetTableValue(1, 0.9, 0.4, 0.2, 0.0);
        mapper->SetLookupTable(clear);
      },
      Case::None, 0, true },
    { "opacity 0.99",
      [](vtkPolyData*, vtkMapper*, vtkActor* actor) { actor->GetProperty()->SetOpacity(0.99); },
      Case::None, 1, false, true },
    { "forced to be translucent",
      [](vtkPolyData*, vtkMapper*, vtkActor* actor) { actor->ForceTranslucentOn(); }, Case::None, 1,
      false, true },
    { "opacity 0",
      [](vtkPolyData*, vtkMapper*, vtkActor* actor) { actor->GetProperty()->SetOpacity(0.0); },
      Case::None, 0, true },
    { "opacity 0.99, and asked to cast",
      [](vtkPolyData*, vtkMapper*, vtkActor* actor)
      {
        actor->GetProperty()->SetOpacity(0.99);
        vtkSVORenderPass::SetCastShadow(true, actor);
      },
      Case::Whole, 0, false },
    { "opacity 0.99, and asked not to cast",
      [](vtkPolyData*, vtkMapper*, vtkActor* actor)
      {
        actor->GetProperty()->SetOpacity(0.99);
        vtkSVORenderPass::SetCastShadow(false, actor);
      },
      Case::None, 0, false },
    { "a texture with holes",
      [](vtkPolyData* mesh, vtkMapper*, vtkActor* actor)
      {
        vtkNew<vtkFloatArray> coordinates;
        coordinates->SetNumberOfComponents(2);
        for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
        {
          coordinates->InsertNextTuple2(i % 2, 0.5);
        }
        mesh->GetPointData()->SetTCoords(coordinates);
        vtkNew<vtkImageData> image;
        image->SetDimensions(2, 1, 1);
        image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
        for (int x = 0; x < 2; ++x)
        {
          for (int c = 0; c < 4; ++c)
          {
            image->SetScalarComponentFromDouble(x, 0, 0, c, x == 0 && c == 3 ? 0 : 255);
          }
        }
        vtkNew<vtkTexture> texture;
        texture->SetInputData(image);
        actor->SetTexture(texture);
      },
      Case::Whole, 1, false },
  };

  const Case plain{ "", [](vtkPolyData*, vtkMapper*, vtkActor*) {}, Case::Whole, 0, false };
  Scene whole(plates(), false, plain);
  Scene half(plates(false), false, plain);
  const std::size_t wholeArea = darkened(whole.shadowed(), whole.unshadowed());
  const std::size_t halfArea = darkened(half.shadowed(), half.unshadowed());
  for (const Case& one : cases)
  {
    for (const bool composite : { false, true })
    {
      const std::string name = one.name + (composite ? ", of a block: " : ": ");
      Scene scene(plates(), composite, one);
      // The same without any shadow, by VTK alone.
      const Picture unshadowed = scene.unshadowed();
      scene.usePass(false);
      const Picture raster = capture(scene.window);
      scene.usePass(true);
      svo::TestMessages messages(scene.pass);
      Picture shadowed;
      for (int frame = 0; frame < 3; ++frame)
      {
        shadowed = scene.shadowed();
      }
      scene.pass->TranslucentShadowsOn();
      const std::size_t lighterArea = darkened(scene.shadowed(), unshadowed);
      const std::size_t look = pixelsBeyond(raster, unshadowed, 10);
      const std::size_t area = darkened(shadowed, unshadowed);
      const std::size_t expected = one.shadow == Case::Whole ? wholeArea
        : one.shadow == Case::Half                           ? halfArea
                                                             : 0;
      std::cout << name << look << " pixels unlike VTK's, shadow of " << area
                << " pixels, expected " << expected << ", " << messages.warnings.size()
                << " messages " << messages.all() << '\n';
      checks.expect(look <= 12, name + "without shadows it is VTK's own picture but for 12 pixels");
      const double share = expected > 0 ? double(area) / double(expected) : 1.0 + double(area);
      checks.expect(share > 0.98 && share < 1.02, name + "the shadow is that of what is opaque");
      checks.expect(int(messages.warnings.size()) == one.messages,
        name + std::to_string(one.messages) + " messages over three frames");
      const double lighter = static_cast<double>(lighterArea);
      const double wanted = static_cast<double>(one.lighter ? wholeArea : expected);
      std::cout << "  with TranslucentShadows " << lighter << ", expected " << wanted << '\n';
      checks.expect(lighter >= 0.98 * wanted && lighter <= 1.02 * wanted,
        name + "with TranslucentShadows it is that of all that is to be seen");
      checks.expect(
        vtkSVORenderPass::GetCastShadow(scene.actor) == (one.lighter || one.shadow != Case::None),
        name + "GetCastShadow() says what the frame did");
      const bool lessThanAll = one.shadow != Case::Whole && !one.lighter;
      const std::string reason = vtkSVORenderPass::GetReason(scene.actor);
      std::cout << "  " << reason << '\n';
      checks.expect((reason.find("Casts") != std::string::npos) == lessThanAll,
        name + "GetReason() says why it casts less than its whole shadow");
    }
  }

  // Blocks with opacities of their own.
  for (const double opacity : { 0.0, 0.5 })
  {
    Stage stage(200, 200);
    stage.addGround();
    stage.addSun(1.0, -1.5, 4.0);
    stage.pass->TranslucentShadowsOff();
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, plates());
    blocks->SetBlock(1, plates(false));
    vtkNew<vtkCompositeDataDisplayAttributes> attributes;
    attributes->SetBlockOpacity(blocks->GetBlock(0), opacity);
    vtkNew<CompositeMapper> mapper;
    mapper->SetCompositeDataDisplayAttributes(attributes);
    mapper->SetInputDataObject(blocks);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    stage.renderer->AddActor(actor);
    svo::TestMessages messages(stage.pass);
    const std::size_t area = darkened(stage.shadowed(), stage.unshadowed());
    std::cout << "a block of opacity " << opacity << ": " << area << " pixels, expected "
              << halfArea << '\n';
    checks.expect(area > 0.98 * halfArea && area < 1.02 * halfArea, "the opaque block casts alone");
    checks.expect(messages.warnings.size() == (opacity > 0.0 ? 1 : 0), "and that is said");
    stage.pass->TranslucentShadowsOn();
    const std::size_t lighter = darkened(stage.shadowed(), stage.unshadowed());
    const double wanted = static_cast<double>(opacity > 0.0 ? wholeArea : halfArea);
    checks.expect(lighter > 0.98 * wanted && lighter < 1.02 * wanted,
      "the translucent one as well with TranslucentShadows");
  }
  return checks.exitCode();
}
