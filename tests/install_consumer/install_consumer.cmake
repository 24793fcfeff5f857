# A stranger's project against the installed library.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
if(GNOMON_INSTALL AND NOT GNOMON_SANITIZE)
  add_test(NAME Package.AStrangerBuildsAgainstTheInstalledCopy
    COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR}
            -DWORK=${CMAKE_CURRENT_BINARY_DIR}/install_consumer -DCOMPILER=${CMAKE_CXX_COMPILER}
            -DLAUNCHER=$<$<BOOL:${GNOMON_CCACHE}>:${GNOMON_CCACHE}>
            -P ${PROJECT_SOURCE_DIR}/tests/install_consumer/build_and_run.cmake)
  set_tests_properties(Package.AStrangerBuildsAgainstTheInstalledCopy PROPERTIES LABELS "e2e;long" TIMEOUT 600)
  add_test(NAME Package.CoreIsFoundWithGlmAlone
    COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR}
            -DWORK=${CMAKE_CURRENT_BINARY_DIR}/core_consumer -DCOMPILER=${CMAKE_CXX_COMPILER}
            -DLAUNCHER=$<$<BOOL:${GNOMON_CCACHE}>:${GNOMON_CCACHE}> -DPYTHON=${Python3_EXECUTABLE}
            -P ${PROJECT_SOURCE_DIR}/tests/install_consumer/core/build_and_run.cmake)
  set_tests_properties(Package.CoreIsFoundWithGlmAlone PROPERTIES LABELS e2e TIMEOUT 300)
  add_test(NAME Package.PartsBringNoOthersLibraries
    COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR}
            -DWORK=${CMAKE_CURRENT_BINARY_DIR}/parts_consumer -DCOMPILER=${CMAKE_CXX_COMPILER}
            -DLAUNCHER=$<$<BOOL:${GNOMON_CCACHE}>:${GNOMON_CCACHE}>
            -P ${PROJECT_SOURCE_DIR}/tests/install_consumer/parts/build_and_run.cmake)
  set_tests_properties(Package.PartsBringNoOthersLibraries PROPERTIES LABELS e2e TIMEOUT 300)
  add_test(NAME Package.ExamplesRunAgainstTheInstalledCopy
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/examples/run_examples.py ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR}
            ${CMAKE_CURRENT_BINARY_DIR}/examples_consumer ${CMAKE_CXX_COMPILER} $<$<BOOL:${GNOMON_CCACHE}>:${GNOMON_CCACHE}>)
  # The build compiles every example, too; the tutorial's is built and run below.
  set_tests_properties(Package.ExamplesRunAgainstTheInstalledCopy PROPERTIES LABELS "e2e;long" TIMEOUT 600)
  add_test(NAME Package.TheTutorialsProgramDrawsItsPicture
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/tutorial.py ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR}
            ${CMAKE_CURRENT_BINARY_DIR}/tutorial_consumer ${CMAKE_CXX_COMPILER} $<$<BOOL:${GNOMON_CCACHE}>:${GNOMON_CCACHE}>)
  set_tests_properties(Package.TheTutorialsProgramDrawsItsPicture PROPERTIES LABELS e2e TIMEOUT 600)
endif()

# The pages show code of programs that tests build, and nothing else but what .ci/loose_code.txt lists.
add_test(NAME Guides.ShowWhatTheStrangerBuilds
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/snippets.py ${PROJECT_SOURCE_DIR})
add_test(NAME Guides.AChangedBlockIsFound
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/snippets.py --self-test ${PROJECT_SOURCE_DIR})
set_tests_properties(Guides.ShowWhatTheStrangerBuilds Guides.AChangedBlockIsFound PROPERTIES LABELS unit TIMEOUT 60)
