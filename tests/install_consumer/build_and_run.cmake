# Installs Gnomon into an empty folder, moves it, and lets a stranger build against it and run.
# cmake -DBUILD= -DSOURCE= -DWORK= -DCOMPILER= -DLAUNCHER= -P build_and_run.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${code}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/moved)  # a package may be unpacked anywhere

# Nothing in it may lead back to where it was built.
file(GLOB_RECURSE texts ${WORK}/moved/*.h ${WORK}/moved/*.cmake)
foreach(text IN LISTS texts)
  file(READ ${text} content)
  foreach(place ${SOURCE} ${BUILD} ${WORK}/first)
    string(FIND "${content}" "${place}" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${text} names ${place}")
    endif()
  endforeach()
endforeach()

file(COPY ${SOURCE}/tests/install_consumer/ DESTINATION ${WORK}/stranger)
run(${CMAKE_COMMAND} -S ${WORK}/stranger -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/moved
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
message("${output}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
foreach(program components_only load_only three_lines)
  run(${WORK}/build/${program})
  message("${program}: ${output}")
endforeach()

# The whole package gives its core to a project that has GLM alone, and nothing to one that wants all of it.
file(COPY ${SOURCE}/examples/core_only.cpp DESTINATION ${WORK}/stranger/core)
set(glm_alone ${CMAKE_COMMAND} -S ${WORK}/stranger/core -B ${WORK}/core -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/moved
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_DISABLE_FIND_PACKAGE_glfw3=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
run(${glm_alone})
run(${CMAKE_COMMAND} --build ${WORK}/core)
run(${WORK}/core/core_only)
execute_process(COMMAND ${glm_alone} -DCOMPONENTS=window RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
if(code EQUAL 0)
  message(FATAL_ERROR "the window was found without GLFW")
endif()
message("core_only: built against the whole package with GLM alone")
