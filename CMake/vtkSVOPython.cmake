# The Python package `vtksvo`: every public class, wrapped, beside vtkmodules.
if (NOT VTKSVO_PYTHON)
  return ()
endif ()

set(vtksvo_wrapped SVO::SVOCore SVO::SVOPass)
vtk_module_wrap_python(
  MODULES ${vtksvo_wrapped}
  TARGET SVO::Python
  PYTHON_PACKAGE vtksvo
  MODULE_DESTINATION python
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/vtkSVO"
  BUILD_STATIC OFF
  INSTALL_HEADERS OFF)
configure_file("${CMAKE_CURRENT_LIST_DIR}/__init__.py.in"
  "${CMAKE_BINARY_DIR}/python/vtksvo/__init__.py" @ONLY)
install(FILES "${CMAKE_BINARY_DIR}/python/vtksvo/__init__.py" DESTINATION python/vtksvo)
