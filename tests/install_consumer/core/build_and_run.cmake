# Installs Gnomon's core alone into an empty folder, moves it, and lets a stranger build examples/core_only.cpp against it
# where CMake finds no library but GLM.
# cmake -DBUILD= -DSOURCE= -DWORK= -DCOMPILER= -DLAUNCHER= -DPYTHON= -P build_and_run.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${code}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first --component core)
file(RENAME ${WORK}/first ${WORK}/moved)
file(GLOB_RECURSE headers RELATIVE ${WORK}/moved ${WORK}/moved/*.h ${WORK}/moved/*.hpp)
if(NOT headers STREQUAL "include/gnomon/core.h")
  message(FATAL_ERROR "the core's headers are ${headers}")
endif()

file(COPY ${SOURCE}/tests/install_consumer/core/CMakeLists.txt ${SOURCE}/examples/core_only.cpp DESTINATION ${WORK}/stranger)
set(configure ${CMAKE_COMMAND} -S ${WORK}/stranger -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/moved
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
foreach(library PkgConfig glfw3 Threads embree tinygltf OpenMesh)
  list(APPEND configure -DCMAKE_DISABLE_FIND_PACKAGE_${library}=ON)
endforeach()
run(${configure} -B ${WORK}/build)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${PYTHON} ${SOURCE}/tests/unit/core/core_only_test.py ${WORK}/build/core_only)

# The same project, with a part that was not installed, must not configure.
foreach(components "shadows" "core shadows")
  execute_process(COMMAND ${configure} -B ${WORK}/without "-DCOMPONENTS=${components}"
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(code EQUAL 0 OR NOT output MATCHES "shadows is not installed")
    message(FATAL_ERROR "${components} were found without the shadows:\n${output}")
  endif()
endforeach()
message("core alone: built, run; shadows are missed where they are wanted")
