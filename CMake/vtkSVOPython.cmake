# The Python package `vtksvo`: every public class, wrapped, beside vtkmodules.
if (NOT VTKSVO_PYTHON)
  return ()
endif ()

# In the build tree the package lies in python/vtksvo; installed, where Debian's interpreter looks
# under the usual prefixes. That for ParaView's VTK goes with the plugin: both trees can be installed
# below one prefix.
set(VTKSVO_PYTHON_BUILD_DIR "python")
set(vtksvo_python_default
  "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/dist-packages")
if (VTKSVO_PARAVIEW)
  set(vtksvo_python_default
    "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/SparseVoxelOctree/python")
endif ()
set(VTKSVO_PYTHON_INSTALL_DIR "${vtksvo_python_default}"
  CACHE STRING "Where the Python package is installed, relative to the prefix")
mark_as_advanced(VTKSVO_PYTHON_INSTALL_DIR)

# The modules carry the interpreter's tag in their names, so that no other one loads them.
set(vtksvo_wrapped SVO::SVOCore SVO::SVOParallel SVO::SVOShadows SVO::SVOPass)
set(VTKSVO_IMPORT_OPENVDB "")
if (VTKSVO_HAS_OPENVDB)
  list(APPEND vtksvo_wrapped SVO::SVOOpenVDB)
  set(VTKSVO_IMPORT_OPENVDB "from .vtkSVOOpenVDB import *\n")
endif ()
vtk_module_wrap_python(
  MODULES ${vtksvo_wrapped}
  TARGET SVO::Python
  PYTHON_PACKAGE vtksvo
  MODULE_DESTINATION "${VTKSVO_PYTHON_INSTALL_DIR}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/vtkSVO"
  SOABI "${Python3_SOABI}"
  BUILD_STATIC OFF
  INSTALL_HEADERS OFF)
foreach (module IN LISTS vtksvo_wrapped)
  string(REPLACE "SVO::" "vtk" library "${module}")
  # VTK's generator knows the members of Python's types up to some version only.
  target_compile_options("${library}Python" PRIVATE -Wno-missing-field-initializers)
  set_target_properties("${library}Python" PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${VTKSVO_PYTHON_BUILD_DIR}/vtksvo")
  if (VTKSVO_PARAVIEW)
    # The libraries lie beside the plugin.
    file(RELATIVE_PATH vtksvo_to_plugin "/prefix/${VTKSVO_PYTHON_INSTALL_DIR}/vtksvo"
      "/prefix/${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/SparseVoxelOctree")
    set_property(TARGET "${library}Python" APPEND
      PROPERTY INSTALL_RPATH "$ORIGIN/${vtksvo_to_plugin}")
  endif ()
endforeach ()

set(vtksvo_package_file "${CMAKE_BINARY_DIR}/${VTKSVO_PYTHON_BUILD_DIR}/vtksvo/__init__.py")
configure_file("${CMAKE_CURRENT_LIST_DIR}/__init__.py.in" "${vtksvo_package_file}" @ONLY)
install(FILES "${vtksvo_package_file}"
  DESTINATION "${VTKSVO_PYTHON_INSTALL_DIR}/vtksvo"
  COMPONENT python)
