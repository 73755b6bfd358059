// The mapper that draws the blocks of a tree, by the name that it has in this VTK.
#ifndef svoCompositeMapper_h
#define svoCompositeMapper_h

#include "vtkVersion.h"

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper.h"
namespace svotest
{
using CompositeMapper = vtkCompositePolyDataMapper;
}
#else
#include "vtkCompositePolyDataMapper2.h"
namespace svotest
{
using CompositeMapper = vtkCompositePolyDataMapper2;
}
#endif

#endif
