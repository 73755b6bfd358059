#include "svoFloatArrays.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

TEST(FloatArrays, FloatsAreNotCopied)
{
  vtkNew<vtkFloatArray> array;
  array->InsertNextValue(1.5f);
  svo::FloatArrays floats;
  svo::KeepAlive kept;
  EXPECT_EQ(svo::floatsOf(array, floats, kept), array->GetPointer(0));
  EXPECT_EQ(floats.size(), 0u);
}

TEST(FloatArrays, DoublesAreConvertedOncePerChange)
{
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  array->InsertNextTuple3(1.0, 2.0, 3.0);
  svo::FloatArrays floats;
  svo::KeepAlive kept;
  const float* first = svo::floatsOf(array, floats, kept);
  EXPECT_EQ(first[2], 3.0f);
  floats.sweep();
  EXPECT_EQ(svo::floatsOf(array, floats, kept), first);
  array->SetComponent(0, 2, 5.0);
  EXPECT_EQ(svo::floatsOf(array, floats, kept)[2], 3.0f)
    << "nobody has said that the array changed";
  array->Modified();
  EXPECT_EQ(svo::floatsOf(array, floats, kept)[2], 5.0f);
  EXPECT_EQ(floats.size(), 1u);
}

TEST(FloatArrays, CopiesThatNobodyKeepsAreForgotten)
{
  vtkNew<vtkDoubleArray> array;
  array->InsertNextValue(1.0);
  svo::FloatArrays floats;
  {
    svo::KeepAlive kept, another;
    svo::floatsOf(array, floats, kept);
    svo::floatsOf(array, floats, another);
    kept = svo::KeepAlive();
    floats.sweep();
    EXPECT_EQ(floats.size(), 1u);
  }
  floats.sweep();
  EXPECT_EQ(floats.size(), 0u);
}
