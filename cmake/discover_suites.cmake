# Lists an executable's GoogleTest suites and writes them as ctest's tests: one process per suite, not one per test, since
# starting a process, and a GL context in it, takes longer than most tests.
# cmake -DEXECUTABLE= -DLABEL= -DTIMEOUT= -DRESULTS= -DLONG= -DALL_LONG= -DOUT= -P discover_suites.cmake
# LONG names the file of suites that have the label `long`, too; with ALL_LONG each suite must be there.
# Each process leaves GoogleTest's own results, test by test, in RESULTS; .ci/summary.py reads them.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${EXECUTABLE} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${EXECUTABLE} --gtest_list_tests ended with ${code}:\n${listed}")
endif()
get_filename_component(executable ${EXECUTABLE} NAME)
string(REPLACE ";" "," listed "${listed}")
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\.[^\n]*" suites "${listed}")
if(NOT suites)
  message(FATAL_ERROR "${EXECUTABLE} holds no test")
endif()
file(STRINGS ${LONG} long_suites REGEX "^[^#]")
list(TRANSFORM long_suites REPLACE "[ #].*" "")
set(tests "")
foreach(line IN LISTS suites)
  string(REGEX REPLACE "^\n?([A-Za-z0-9_/]+)\\..*" "\\1" suite "${line}")
  string(REPLACE "/" "." test "${executable}.${suite}")
  set(labels ${LABEL})
  if(test IN_LIST long_suites)
    list(APPEND labels long)
  elseif(ALL_LONG)
    message(FATAL_ERROR "${LONG} does not say what stands for ${test} in a short run")
  endif()
  string(APPEND tests
    "add_test([=[${test}]=] [=[${EXECUTABLE}]=] \"--gtest_filter=${suite}.*\")\n"
    "set_tests_properties([=[${test}]=] PROPERTIES LABELS \"${labels}\" TIMEOUT ${TIMEOUT}\n"
    "  ENVIRONMENT [=[GTEST_OUTPUT=xml:${RESULTS}/${test}.xml]=])\n")
endforeach()
file(WRITE ${OUT} "${tests}")
