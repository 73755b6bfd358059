// A few glyphs with arrays for every mode of their mapper, for the tests of glyphs.
#ifndef svoGlyphStage_h
#define svoGlyphStage_h

#include "svoTestStage.h"

#include "vtkGlyph3DMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"

namespace svotest
{
/// 5 x 4 points above the ground, each a little higher than the last, with point data: "size" (0.5
/// to 1.5), "sizes" (3 components), "way" (directions), "angles" (degrees), "turn" (quaternions),
/// "shape" (-1 to 3), "shown" (bits), "value" (0 to 1, the active scalars), "rgb" and "rgba"
/// (bytes; some of the latter translucent).
vtkSmartPointer<vtkPolyData> glyphPoints();

/// A mesh with an inside and an outside, and no symmetry: its turns and reflections differ.
vtkSmartPointer<vtkPolyData> oddShape();

/// A stage with a sun and glyphs of an odd shape, whose mapper shows no arrays.
class GlyphStage : public Stage
{
public:
  explicit GlyphStage(int width = 300, int height = 300);

  vtkNew<vtkGlyph3DMapper> mapper;
  vtkNew<vtkActor> actor;
  vtkSmartPointer<vtkPolyData> points = glyphPoints();
};

// Settings of the mapper, by names of arrays.
void scaleBy(GlyphStage& stage, const char* array, bool components);
void orientBy(GlyphStage& stage, const char* array, int mode);
void colorBy(GlyphStage& stage, const char* array, int mode);

/// Half of the points in a block, the others in a tree below.
vtkSmartPointer<vtkMultiBlockDataSet> useTree(GlyphStage& stage);
}

#endif
