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
foreach(program components_only three_lines own_ecs forward deferred)
  run(${WORK}/build/${program})
  message("${program}: ${output}")
endforeach()
