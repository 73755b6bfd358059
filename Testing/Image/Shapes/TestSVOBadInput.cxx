// Whatever an actor brings, the rest of the frame is complete, and one message says what is wrong.
#include "svoTestStage.h"

#include "vtkCellArray.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOutputWindow.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"

#include <functional>
#include <iostream>
#include <limits>

namespace
{
// Counts messages instead of printing them, so that expected ones do not fail the test.
class Messages : public vtkOutputWindow
{
public:
  static Messages* New();
  vtkTypeMacro(Messages, vtkOutputWindow);
  void DisplayText(const char* text) override { this->take(text); }
  void DisplayErrorText(const char* text) override { this->take(text); }
  void DisplayWarningText(const char* text) override { this->take(text); }
  void DisplayGenericWarningText(const char* text) override { this->take(text); }
  int count = 0;
  std::string last;

private:
  void take(const char* text)
  {
    ++this->count;
    this->last = text;
  }
};
vtkStandardNewMacro(Messages);

// A mapper as a later VTK may have one.
class NewMapper : public vtkOpenGLPolyDataMapper
{
public:
  static NewMapper* New();
  vtkTypeMacro(NewMapper, vtkOpenGLPolyDataMapper);
};
vtkStandardNewMacro(NewMapper);

const double NaN = std::numeric_limits<double>::quiet_NaN();

vtkSmartPointer<vtkTrivialProducer> producer(vtkPolyData* mesh)
{
  auto source = vtkSmartPointer<vtkTrivialProducer>::New();
  source->SetOutput(mesh);
  return source;
}

// A square at height z of two triangles; `corner` is the x of its last point.
vtkSmartPointer<vtkTrivialProducer> square(double z, double corner)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1.0, -1.0, z);
  points->InsertNextPoint(1.0, -1.0, z);
  points->InsertNextPoint(1.0, 1.0, z);
  points->InsertNextPoint(corner, 1.0, z);
  vtkNew<vtkCellArray> triangles;
  const vtkIdType first[3] = { 0, 1, 2 };
  const vtkIdType second[3] = { 0, 2, 3 };
  triangles->InsertNextCell(3, first);
  triangles->InsertNextCell(3, second);
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return producer(mesh);
}

/// All actors of this class have the same address, one after the other.
class ActorOfOnePlace : public vtkOpenGLActor
{
public:
  static ActorOfOnePlace* New() { return new ActorOfOnePlace; }
  static void* operator new(std::size_t size)
  {
    alignas(16) static unsigned char place[sizeof(vtkOpenGLActor) + 64];
    return size <= sizeof(place) ? place : nullptr;
  }
  static void operator delete(void*) {}
};

struct Case
{
  const char* name;
  int messages; // how many, over three frames
  std::function<void(svotest::Stage&)> add;
  bool untouched = false; // no bit of the picture may change
};

void withMatrix(svotest::Stage& stage, int row, int column, double value)
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(row, column, value);
  stage.add(svotest::ball(0.5, 0.0, 0.0, 2.0), 1.0, 0.0, 0.0)->SetUserMatrix(matrix);
}

void flattened(svotest::Stage& stage, double scale)
{
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(2, 2, scale);
  matrix->SetElement(2, 3, 1.0);
  stage.add(svotest::ball(0.5, 0.0, 0.0, 0.0), 1.0, 0.0, 0.0)->SetUserMatrix(matrix);
}
}

namespace
{
void expectMessagesOfNewActors(svotest::Checks& checks)
{
  using namespace svotest;
  Stage stage;
  stage.addGround();
  stage.addSun(2.0, -1.5, 4.0);
  vtkNew<Messages> messages;
  vtkOutputWindow::SetInstance(messages);
  for (int i = 0; i < 2; ++i)
  {
    vtkActor* model = stage.add(ball(0.5, 0.0, 0.0, 2.0), 1.0, 0.0, 0.0);
    const auto actor = vtkSmartPointer<vtkActor>::Take(ActorOfOnePlace::New());
    actor->SetMapper(model->GetMapper());
    vtkNew<vtkMatrix4x4> perspective;
    perspective->SetElement(3, 1, 0.1);
    actor->SetUserMatrix(perspective);
    stage.renderer->AddActor(actor);
    stage.renderer->RemoveActor(model);
    stage.shadowed();
    stage.shadowed();
    stage.renderer->RemoveActor(actor);
  }
  vtkOutputWindow::SetInstance(nullptr);
  std::cout << "a new actor in an old one's place: " << messages->count << " messages\n";
  checks.expect(messages->count == 2, "a new actor in an old one's place has its own message");
}
}

int TestSVOBadInput(int, char*[])
{
  using namespace svotest;
  Checks checks;
  const Case cases[] = {
    { "no points at all", 0,
      [](Stage& stage)
      {
        vtkNew<vtkPolyData> mesh;
        stage.add(producer(mesh), 1.0, 0.0, 0.0);
      } },
    { "only a vertex and a line", 0,
      [](Stage& stage)
      {
        auto source = square(-9.0, -1.0);
        vtkPolyData* mesh = vtkPolyData::SafeDownCast(source->GetOutputDataObject(0));
        vtkNew<vtkCellArray> lines;
        const vtkIdType line[2] = { 0, 1 };
        lines->InsertNextCell(2, line);
        mesh->SetPolys(nullptr);
        mesh->SetLines(lines);
        stage.add(source, 1.0, 0.0, 0.0);
      } },
    { "all points equal", 0,
      [](Stage& stage)
      {
        vtkActor* actor = stage.add(square(0.0, -1.0), 1.0, 0.0, 0.0);
        auto* mesh = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputDataObject(0, 0));
        for (vtkIdType i = 0; i < 4; ++i)
        {
          mesh->GetPoints()->SetPoint(i, 0.0, 0.0, -9.0);
        }
        mesh->GetPoints()->Modified();
      } },
    { "a point that is not a number", 1,
      [](Stage& stage) { stage.add(square(-9.0, NaN), 1.0, 0.0, 0.0); } },
    // Flattened within the ball that is there; TestSVOMatrices looks at such actors.
    { "a singular matrix", 0, [](Stage& stage) { flattened(stage, 0.0); } },
    { "a matrix of condition 1e13", 0, [](Stage& stage) { flattened(stage, 1e-13); } },
    { "a matrix that is not a number", 1, [](Stage& stage) { withMatrix(stage, 0, 0, NaN); },
      true },
    { "an infinite matrix", 1,
      [](Stage& stage) { withMatrix(stage, 1, 1, std::numeric_limits<double>::infinity()); },
      true },
    { "surfaces of a mapper that is not known", 1,
      [](Stage& stage)
      {
        for (int i = 0; i < 2; ++i)
        {
          vtkActor* actor = stage.add(square(-9.0, -1.0), 1.0, 0.0, 0.0);
          vtkNew<NewMapper> mapper;
          mapper->SetInputConnection(actor->GetMapper()->GetInputConnection(0, 0));
          actor->SetMapper(mapper);
        }
      } },
    // It is left to the rasteriser, which draws it far beside the picture here. A rasterised
    // receiver may be anywhere, so the ground casts as well, and shadows have other texels.
    { "a matrix with a perspective row", 1,
      [](Stage& stage)
      {
        vtkNew<vtkMatrix4x4> matrix;
        matrix->SetElement(0, 3, 1000.0);
        matrix->SetElement(3, 1, 0.1);
        stage.add(ball(0.5, 0.0, 0.0, 2.0), 1.0, 0.0, 0.0)->SetUserMatrix(matrix);
      },
      true },
  };

  Stage good;
  good.addGround();
  good.add(ball(0.7, 0.0, 0.0, 1.0), 0.9, 0.5, 0.3);
  good.addSun(2.0, -1.5, 4.0);
  const Picture expected = good.shadowed();

  for (const Case& bad : cases)
  {
    vtkNew<Messages> messages;
    vtkOutputWindow::SetInstance(messages);
    Picture picture;
    {
      Stage stage;
      stage.addGround();
      stage.add(ball(0.7, 0.0, 0.0, 1.0), 0.9, 0.5, 0.3);
      stage.addSun(2.0, -1.5, 4.0);
      bad.add(stage);
      for (int frame = 0; frame < 3; ++frame)
      {
        picture = stage.shadowed();
      }
    }
    vtkOutputWindow::SetInstance(nullptr);
    const Difference change = difference(picture, expected);
    std::cout << bad.name << ": " << messages->count << " messages, largest difference "
              << change.largest << "\n"
              << messages->last << "\n";
    checks.expect(
      change.mean < 0.05, std::string(bad.name) + ": the rest of the frame is complete");
    checks.expect(!bad.untouched || change.largest == 0,
      std::string(bad.name) + ": the rest of the frame is the same to the bit");
    checks.expect(messages->count == bad.messages,
      std::string(bad.name) + ": " + std::to_string(bad.messages) + " messages over three frames");
  }
  expectMessagesOfNewActors(checks);
  return checks.exitCode();
}
