find_package(Python3 REQUIRED COMPONENTS Interpreter)
include(${CMAKE_CURRENT_LIST_DIR}/core_tests.cmake)
# The others compare with the system and with the shader's text, which they compile as C++.
gnomon_tests(NAME unit_core LABEL unit SOURCES ${GNOMON_CORE_TESTS}
  core/core_stages_test.cpp core/core_shader_bias_test.cpp allocation_counter.cpp ../system/test_world.cpp)
target_include_directories(unit_core PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
gnomon_compiled_alone(core/core_shader_bias_test.cpp)

if(TARGET core_only)
  add_dependencies(gnomon_headless_tests core_only)
  foreach(mode "" --self-test)
    set(name Examples.CoreOnlyPrintsWhatItShould)
    if(mode)
      set(name Examples.AWrongLineOfCoreOnlyIsFound)
    endif()
    add_test(NAME ${name}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/core_only_test.py ${mode} $<TARGET_FILE:core_only>)
    set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT 60)
  endforeach()
endif()
# Compilers with GLM alone: what is missing of them is skipped with the reason. clang compiles core and tests for sanitizers.
if(NOT GNOMON_SANITIZE)
  add_test(NAME Core.BuildsWithGlmAlone COMMAND ${PROJECT_SOURCE_DIR}/.ci/check_core ${PROJECT_BINARY_DIR}/check_core gcc mingw)
  set_tests_properties(Core.BuildsWithGlmAlone PROPERTIES LABELS "unit;long" TIMEOUT 1500 SKIP_RETURN_CODE 77)
endif()
