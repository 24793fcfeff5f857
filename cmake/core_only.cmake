# The rest of the build where GNOMON_CORE_ONLY is set: for machines and compilers that have GLM and nothing else.
# GNOMON_GTEST_SOURCE names the folder of GoogleTest's sources, which are then compiled along: no package of it exists for
# cross compilers.
set(GNOMON_GTEST_SOURCE "" CACHE PATH "Sources of GoogleTest; empty: an installed one")
if(GNOMON_INSTALL)
  include(cmake/install_core.cmake)
endif()
if(GNOMON_EXAMPLES)
  add_subdirectory(examples)
endif()
if(GNOMON_TESTS)
  enable_testing()
  if(GNOMON_GTEST_SOURCE)
    set(INSTALL_GTEST OFF)
    set(BUILD_GMOCK OFF)
    add_subdirectory(${GNOMON_GTEST_SOURCE} ${PROJECT_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
  else()
    find_package(GTest REQUIRED)
  endif()
  set(unit ${PROJECT_SOURCE_DIR}/tests/unit)
  include(${unit}/core/core_tests.cmake)
  add_executable(core_tests ${GNOMON_CORE_TESTS} ${unit}/allocation_counter.cpp)
  target_include_directories(core_tests PRIVATE ${PROJECT_SOURCE_DIR})  # tests/unit/…; of Gnomon they include <gnomon/core.h>
  target_compile_options(core_tests PRIVATE -Og)  # each test's own text runs once
  gnomon_compiled_alone(${unit}/allocation_counter.cpp)
  target_link_libraries(core_tests PRIVATE gnomon_options Gnomon::core GTest::gtest_main)
  add_test(NAME core_tests COMMAND core_tests)
endif()
