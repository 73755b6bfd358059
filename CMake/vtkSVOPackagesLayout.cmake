# Called by cpack between installing and packing: what a package of Debian has beyond an installation.
function (vtksvo_finish folder package)
  set(doc "${folder}/usr/share/doc/${package}")
  file(REMOVE_RECURSE "${folder}/usr/share/doc")
  file(MAKE_DIRECTORY "${doc}")
  configure_file("${CPACK_VTKSVO_LICENSE}" "${doc}/copyright" COPYONLY)
  # What is new, and, in Debian's words, of which version these packages are.
  configure_file("${CPACK_VTKSVO_CHANGELOG}" "${doc}/changelog" COPYONLY)
  execute_process(COMMAND date -R -r "${CPACK_VTKSVO_CHANGELOG}"
    OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(WRITE "${doc}/changelog.Debian" "vtksvo (${CPACK_VTKSVO_DEBIAN_VERSION}) unstable; urgency=medium\n\n"
    "  * Packages of this version; changelog.gz says what is new.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  execute_process(COMMAND gzip -9n "${doc}/changelog" "${doc}/changelog.Debian")

  # Below /usr Python packages lie in python3, not in a folder for each minor version.
  file(GLOB python "${folder}/usr/lib/python3.*")
  if (python)
    file(RENAME "${python}" "${folder}/usr/lib/python3")
  endif ()
  file(GLOB config "${folder}/usr/lib/*/cmake/vtkSVO/vtkSVOConfig.cmake")
  if (config)
    file(READ "${config}" text)
    string(REGEX REPLACE "/python3\\.[0-9]+/dist-packages" "/python3/dist-packages" text "${text}")
    file(WRITE "${config}" "${text}")
  endif ()
endfunction ()

if (NOT CPACK_VTKSVO_PLUGINS)
  foreach (component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER "${component}" name)
    vtksvo_finish("${CPACK_TEMPORARY_DIRECTORY}/${component}" "${CPACK_DEBIAN_${name}_PACKAGE_NAME}")
  endforeach ()
  return ()
endif ()

# ParaView lists the plugins of the files and folders that its paraview.conf names. Debian's names a folder
# for plugins of other packages from Debian 13 on. Debian 12's ParaView has no such file and so lists not even
# its own plugins: there the file comes with this package, to where ParaView looks for it.
set(root "${CPACK_TEMPORARY_INSTALL_DIRECTORY}")
vtksvo_finish("${root}" "${CPACK_DEBIAN_PACKAGE_NAME}")
if (CPACK_VTKSVO_PLUGIN_FOLDER)
  file(MAKE_DIRECTORY "${root}${CPACK_VTKSVO_PLUGIN_FOLDER}")
  file(CREATE_LINK "../../../${CPACK_VTKSVO_PLUGINS}/SparseVoxelOctree"
    "${root}${CPACK_VTKSVO_PLUGIN_FOLDER}/SparseVoxelOctree" SYMBOLIC)
else ()
  file(WRITE "${root}/usr/${CPACK_VTKSVO_PLUGINS}/SparseVoxelOctree/plugins.xml"
    "<Plugins>\n  <Plugin name=\"SparseVoxelOctree\" auto_load=\"0\" filename=\"SparseVoxelOctree.so\"/>\n</Plugins>\n")
  file(WRITE "${root}/usr/bin/paraview.conf"
    "/usr/${CPACK_VTKSVO_PLUGINS}/paraview.plugins.xml\n"
    "/usr/${CPACK_VTKSVO_PLUGINS}/SparseVoxelOctree/plugins.xml\n")
endif ()
