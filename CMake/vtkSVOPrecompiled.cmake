# Headers of the standard library, GLM, VTK and GoogleTest that most files of a target read are parsed once a target. Sources
# include what they use all the same: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON, as Testing/run-sanitizers.sh has it, builds without.
# Highway is not among them: its headers are read once for each instruction set.
if (NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
elseif (CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
  # What ccache asks for, else it caches nothing that reads a precompiled header.
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>")
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CMAKE_CXX_COMPILER_LAUNCHER})
endif ()

set(vtksvo_headers_std <algorithm> <array> <atomic> <cassert> <cmath> <cstddef> <cstdint> <cstring> <functional> <limits> <map>
  <memory> <mutex> <string> <unordered_map> <utility> <vector>)
set(vtksvo_headers_glm <glm/glm.hpp> <glm/gtc/matrix_transform.hpp>)
set(vtksvo_headers_vtk <vtkCellArray.h> <vtkCellData.h> <vtkDataArray.h> <vtkInformation.h> <vtkInformationVector.h> <vtkMatrix4x4.h>
  <vtkNew.h> <vtkObjectFactory.h> <vtkPointData.h> <vtkPoints.h> <vtkPolyData.h> <vtkSMPTools.h> <vtkSmartPointer.h>)
set(vtksvo_headers_rendering <vtkActor.h> <vtkCamera.h> <vtkLight.h> <vtkPolyDataMapper.h> <vtkProperty.h> <vtkRenderWindow.h>
  <vtkRenderer.h> <vtkTexture.h>)
set(vtksvo_headers_gtest <gtest/gtest.h>)
set(vtksvo_headers_openvdb <openvdb/openvdb.h>)

# vtksvo_precompile(<target> <group>...), of the groups above
function (vtksvo_precompile target)
  foreach (group IN LISTS ARGN)
    target_precompile_headers("${target}" PRIVATE ${vtksvo_headers_${group}})
  endforeach ()
endfunction ()
