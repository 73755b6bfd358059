# Installs the build into an empty prefix, moves the prefix, builds and runs Project/, the README's
# lines and the example ShadowedSphere against it and imports the Python package from it. Called by ctest with -D definitions; see CMakeLists.txt.
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${WORK_DIR}/staged" "${prefix}" "${WORK_DIR}/project" "${WORK_DIR}/readme"
  "${WORK_DIR}/example")

function (run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if (NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "This step failed (${result}): ${command}")
  endif ()
endfunction ()

# Installed in one place and used in another: nothing may remember an absolute path.
run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --config "${CONFIG}" --prefix "${WORK_DIR}/staged")
file(RENAME "${WORK_DIR}/staged" "${prefix}")

function (build source binary)
  run("${CMAKE_COMMAND}" -S "${source}" -B "${binary}" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DVTK_DIR=${VTK_DIR}"
    "-DCMAKE_BUILD_TYPE=${CONFIG}"
    "-DCMAKE_C_COMPILER=${C_COMPILER}"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=$ENV{CMAKE_CXX_COMPILER_LAUNCHER}"
    ${ARGN})
  run("${CMAKE_COMMAND}" --build "${binary}" --config "${CONFIG}")
endfunction ()

build("${PROJECT_DIR}" "${WORK_DIR}/project" "-DEXPECTED_VERSION=${VERSION}")
run("${WORK_DIR}/project/shadow")

# The README's own lines.
file(READ "${README}" readme)
if (NOT readme MATCHES "```cmake\n([^`]*)```")
  message(FATAL_ERROR "The README has no lines for a project of one's own")
endif ()
file(WRITE "${WORK_DIR}/readme/CMakeLists.txt" "${CMAKE_MATCH_1}")
file(WRITE "${WORK_DIR}/readme/main.cxx" "
#include <vtkNew.h>
#include <vtkPolyDataToSVO.h>
#include <vtkRenderer.h>
#include <vtkSVORenderPass.h>
int main()
{
  vtkNew<vtkPolyDataToSVO> toOctree;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkSVORenderPass> pass;
  renderer->SetPass(pass);
  return toOctree->GetMaximumLevel() == 10 && renderer->GetPass() == pass ? 0 : 1;
}
")
build("${WORK_DIR}/readme" "${WORK_DIR}/readme/build")
run("${WORK_DIR}/readme/build/program")

build("${EXAMPLE_DIR}" "${WORK_DIR}/example")
run("${WORK_DIR}/example/ShadowedSphere" "${WORK_DIR}/example/sphere.png")

if (PYTHON_DIR)
  run("${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH "PYTHONPATH=${prefix}/${PYTHON_DIR}"
    "${PYTHON}" -c "
import vtksvo
assert vtksvo.__version__ == '${VERSION}', vtksvo.__version__
assert vtksvo.__file__.startswith('${prefix}/'), vtksvo.__file__
print(vtksvo.vtkSVORenderPass(), vtksvo.vtkPolyDataToSVO())
")
  # The example's own test, on the program that was built against the installation.
  run("${PYTHON}" "${EXAMPLE_DIR}/../Tests/TestShadowedSphere.py"
    "${WORK_DIR}/example/ShadowedSphere")
endif ()
