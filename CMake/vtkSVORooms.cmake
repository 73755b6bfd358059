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
