# find_package(vtkSVO), from an installation and from the build tree alike.
include(CMakePackageConfigHelpers)

set(vtksvo_cmake_destination "${CMAKE_INSTALL_LIBDIR}/cmake/vtkSVO")
set(vtksvo_cmake_build "${CMAKE_BINARY_DIR}/${vtksvo_cmake_destination}")
# The VTK components that our targets need are those that the modules' own files name.
set(vtksvo_vtk_components "${vtksvo_required_modules}")
list(TRANSFORM vtksvo_vtk_components REPLACE "^VTK::" "")
list(SORT vtksvo_vtk_components)
list(JOIN vtksvo_vtk_components " " vtksvo_vtk_components)

# One file for each of the two trees: they differ only in where the Python package lies.
function (vtksvo_write_config file python_destination)
  set(vtksvo_python_relative "")
  if (VTKSVO_PYTHON)
    file(RELATIVE_PATH vtksvo_python_relative
      "/prefix/${vtksvo_cmake_destination}" "/prefix/${python_destination}")
  endif ()
  configure_file("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/vtkSVOConfig.cmake.in" "${file}" @ONLY)
endfunction ()
vtksvo_write_config("${vtksvo_cmake_build}/vtkSVOConfig.cmake" "${VTKSVO_PYTHON_BUILD_DIR}")
vtksvo_write_config("${CMAKE_BINARY_DIR}/CMakeFiles/vtkSVOConfig.cmake"
  "${VTKSVO_PYTHON_INSTALL_DIR}")

write_basic_package_version_file("${vtksvo_cmake_build}/vtkSVOConfigVersion.cmake"
  VERSION "${PROJECT_VERSION}"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_BINARY_DIR}/CMakeFiles/vtkSVOConfig.cmake"
  "${vtksvo_cmake_build}/vtkSVOConfigVersion.cmake"
  DESTINATION "${vtksvo_cmake_destination}"
  COMPONENT development)
install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT runtime)
