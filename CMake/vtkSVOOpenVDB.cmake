# OpenVDB, where it is installed: Filters/OpenVDB is built then. It is found by its files: its own
# FindOpenVDB.cmake asks for all that OpenVDB itself was built with, and its targets would have to be found
# by whoever uses ours. What differs between its builds stands in its version.h.
option(VTKSVO_OPENVDB "Build what reads and writes OpenVDB's files, if OpenVDB is there" ON)
find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OPENVDB_LIBRARY openvdb)
find_library(TBB_LIBRARY tbb)
find_library(IMATH_LIBRARY NAMES Imath Imath-3_1 Imath-3_2) # its half floats; where OpenVDB has none of its own
mark_as_advanced(OPENVDB_INCLUDE_DIR OPENVDB_LIBRARY TBB_LIBRARY IMATH_LIBRARY)
set(VTKSVO_OPENVDB_LIBRARIES "${OPENVDB_LIBRARY}" "${TBB_LIBRARY}")
if (IMATH_LIBRARY)
  list(APPEND VTKSVO_OPENVDB_LIBRARIES "${IMATH_LIBRARY}")
endif ()
set(VTKSVO_HAS_OPENVDB OFF)
if (OPENVDB_INCLUDE_DIR AND OPENVDB_LIBRARY AND TBB_LIBRARY)
  set(VTKSVO_HAS_OPENVDB ${VTKSVO_OPENVDB})
elseif (VTKSVO_OPENVDB)
  message(STATUS
    "OpenVDB is not found (libopenvdb-dev and libtbb-dev): vtkSVOVDBReader and vtkSVOVDBWriter are left out")
endif ()
