# Debian packages: `cpack` in a build tree leaves them in its folder packages, for the release of Debian
# that it was built on. From build/vtk:
#   libvtksvo0.2      the libraries, called after their soname as Debian's policy wants it
#   libvtksvo-dev     headers and find_package(vtkSVO)
#   python3-vtksvo    `import vtksvo`
# and from build/paraview:
#   paraview-vtksvo   the plugin, with a `vtksvo` for pvpython. It needs none of the others: up to Debian 13
#                     ParaView brings a VTK of its own, whose Python package conflicts with VTK's
if (NOT EXISTS "/etc/debian_version")
  return ()
endif ()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_CONTACT "The vtkSVO authors <vtksvo@users.noreply.invalid>")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# To apt the packages for a newer Debian are newer: 0.2.0-1~deb12, 0.2.0-1~deb13, and for unstable, which
# has no number, 0.2.0-1.
execute_process(
  COMMAND sh -c ". /etc/os-release && echo $ID$VERSION_ID"
  OUTPUT_VARIABLE vtksvo_release OUTPUT_STRIP_TRAILING_WHITESPACE)
string(REGEX REPLACE "^debian" "deb" vtksvo_release "${vtksvo_release}")
set(CPACK_DEBIAN_PACKAGE_RELEASE "1")
if (vtksvo_release MATCHES "[0-9]")
  string(APPEND CPACK_DEBIAN_PACKAGE_RELEASE "~${vtksvo_release}")
endif ()
set(vtksvo_debian_version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")

# What the libraries load is found by dpkg-shlibdeps, which is told where our own lie. It ties the plugin to
# the very release of ParaView.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
# A versioned range: what is built for one minor version of a library or interpreter fits no other.
function (vtksvo_only_minor variable package version)
  string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" minor "${version}")
  math(EXPR next "${CMAKE_MATCH_2} + 1")
  set(${variable} "${package} (>= ${minor}), ${package} (<< ${CMAKE_MATCH_1}.${next}~)" PARENT_SCOPE)
endfunction ()
if (VTKSVO_PYTHON)
  vtksvo_only_minor(vtksvo_python_depends python3 "${Python3_VERSION}")
  # Python leaves its compiled copy beside the file when root imports it, and no package owns that.
  string(REGEX REPLACE "/python3\\.[0-9]+/" "/python3/" vtksvo_python_folder
    "/usr/${VTKSVO_PYTHON_INSTALL_DIR}/vtksvo")
  set(vtksvo_prerm "${CMAKE_BINARY_DIR}/CMakeFiles/prerm")
  file(WRITE "${vtksvo_prerm}" "#!/bin/sh\nset -e\nrm -rf ${vtksvo_python_folder}/__pycache__\n")
endif ()

# The last touches to what was installed for a package.
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/vtkSVOPackagesLayout.cmake")
set(CPACK_VTKSVO_LICENSE "${CMAKE_CURRENT_SOURCE_DIR}/LICENSE")
set(CPACK_VTKSVO_CHANGELOG "${CMAKE_CURRENT_SOURCE_DIR}/CHANGELOG.md")
set(CPACK_VTKSVO_DEBIAN_VERSION "${vtksvo_debian_version}")

if (VTKSVO_PARAVIEW)
  set(CPACK_PACKAGE_NAME paraview-vtksvo)
  set(CPACK_DEBIAN_PACKAGE_NAME paraview-vtksvo)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "sparse voxel octrees with shadows - ParaView plugin")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "The plugin SparseVoxelOctree: a representation with shadows, filters, sources.")
  set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${vtksvo_prerm})
  # Everything but headers. ParaView 5.11 gives the plugin itself no component.
  set(CPACK_DEB_COMPONENT_INSTALL OFF)
  set(CPACK_INSTALL_CMAKE_PROJECTS "")
  foreach (component IN ITEMS Unspecified paraview_plugins runtime python)
    list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};vtkSVO;${component};/")
  endforeach ()
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${PARAVIEW_PLUGIN_SUBDIR}/SparseVoxelOctree"
    "${ParaView_DIR}/../..")

  # How ParaView comes to know of it, see vtkSVOPackagesLayout.cmake.
  set(CPACK_VTKSVO_PLUGINS "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}")
  set(CPACK_VTKSVO_PLUGIN_FOLDER OFF)
  get_filename_component(vtksvo_conf
    "${ParaView_DIR}/../../${PARAVIEW_PLUGIN_SUBDIR}/../paraview.conf" ABSOLUTE)
  if (EXISTS "${vtksvo_conf}")
    file(STRINGS "${vtksvo_conf}" CPACK_VTKSVO_PLUGIN_FOLDER REGEX "^/usr/share/paraview/plugins$")
  endif ()
else ()
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_ALL runtime development)
  set(vtksvo_library "libvtksvo${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")

  # Whose libraries they are, for packages of programs that are linked with them, and that the system's list
  # of libraries is made anew.
  set(vtksvo_shlibs "")
  foreach (module IN LISTS vtksvo_modules)
    get_target_property(vtksvo_name "${module}" OUTPUT_NAME)
    string(APPEND vtksvo_shlibs "lib${vtksvo_name} ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} "
      "${vtksvo_library} (>= ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}.0)\n")
  endforeach ()
  file(WRITE "${CMAKE_BINARY_DIR}/CMakeFiles/shlibs" "${vtksvo_shlibs}")
  file(WRITE "${CMAKE_BINARY_DIR}/CMakeFiles/triggers" "activate-noawait ldconfig\n")

  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME "${vtksvo_library}")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA
    "${CMAKE_BINARY_DIR}/CMakeFiles/shlibs" "${CMAKE_BINARY_DIR}/CMakeFiles/triggers")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_MULTIARCH same)
  set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "The libraries of vtkSVO, which programs and the other packages use.")

  vtksvo_only_minor(vtksvo_vtk_dev libvtk9-dev "${VTK_VERSION}")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libvtksvo-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${vtksvo_library} (= ${vtksvo_debian_version}), ${vtksvo_vtk_dev}, libglm-dev, libhwy-dev")
  set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and CMake package of vtkSVO, for programs of one's own.")

  if (VTKSVO_PYTHON)
    list(APPEND CPACK_COMPONENTS_ALL python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-vtksvo)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${vtksvo_prerm}")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "${vtksvo_library} (= ${vtksvo_debian_version}), python3-vtk9, ${vtksvo_python_depends}")
    set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The classes of vtkSVO for Python: import vtksvo.")
  endif ()
endif ()
include(CPack)
