# The ParaView plugin and its tests. The plugin names the modules by their files, so they are built
# by ParaView's own functions, against the VTK that ParaView brings.
if (VTKSVO_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development)
endif ()
# Without components ParaView's package asks for the development files of Qt. It uses names of its own
# that it calls deprecated, which is not ours to say.
set(CMAKE_WARN_DEPRECATED OFF)
find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingViews)
unset(CMAKE_WARN_DEPRECATED)

paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin"
  PROVIDES_PLUGINS vtksvo_plugins
  ENABLE_BY_DEFAULT ON)
paraview_plugin_build(
  RUNTIME_DESTINATION "${CMAKE_INSTALL_BINDIR}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  PLUGINS ${vtksvo_plugins})

include(CMake/vtkSVOPython.cmake)

if (VTKSVO_TESTING)
  enable_testing()
  add_subdirectory(Testing/ParaView)
  add_subdirectory(Testing/Packages)
endif ()
include(CMake/vtkSVOPackages.cmake)
