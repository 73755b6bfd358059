# The files of a module lie in rooms, sub-folders named from the lowest to the highest: the files of a
# room include those of their own and of lower ones only (Testing/House checks it). Includes name no
# room, since installed headers lie side by side.
#
# Modules are compiled with all warnings about shadowed names and narrowing conversions.
#
# vtksvo_rooms(<module> ROOMS <room>... [INSTALL <header>...] PRECOMPILED <group of vtkSVOPrecompiled.cmake>...)
function (vtksvo_rooms module)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ROOMS;INSTALL;PRECOMPILED")
  string(REPLACE "SVO::" "" target "${module}")
  vtksvo_precompile("${target}" ${arg_PRECOMPILED})
  vtk_module_compile_options("${module}" PRIVATE -Wshadow -Wconversion)
  # Of which -DCMAKE_UNITY_BUILD=ON compiles several in one. Highway compiles a source once for each instruction set.
  set_target_properties("${target}" PROPERTIES UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE 8)
  get_target_property(sources "${target}" SOURCES)
  foreach (source IN LISTS sources)
    get_filename_component(source "${source}" ABSOLUTE)
    if (EXISTS "${source}" AND source MATCHES "\\.cxx$")
      file(STRINGS "${source}" kernel REGEX "foreach_target" LIMIT_COUNT 1)
      if (kernel)
        set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif ()
    endif ()
  endforeach ()
  foreach (room IN LISTS arg_ROOMS)
    vtk_module_include("${module}" PUBLIC "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/${room}>")
  endforeach ()
  if (arg_INSTALL)
    vtk_module_install_headers(FILES ${arg_INSTALL})
  endif ()
endfunction ()

# Shaders are edited as .glsl files and compiled in as strings, each with a header of its own.
# vtksvo_shaders(<room> <name>...): adds to the lists shaders (sources) and shader_headers.
function (vtksvo_shaders room)
  foreach (shader IN LISTS ARGN)
    vtk_encode_string(
      INPUT "${room}/${shader}.glsl"
      NAME "${shader}"
      HEADER_OUTPUT shader_header
      SOURCE_OUTPUT shader_source)
    list(APPEND shaders "${shader_source}")
    list(APPEND shader_headers "${shader_header}")
  endforeach ()
  set(shaders "${shaders}" PARENT_SCOPE)
  set(shader_headers "${shader_headers}" PARENT_SCOPE)
endfunction ()
