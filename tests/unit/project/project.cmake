# Tests of the project as a whole: the arrows between its parts, its prose, its launcher. No sanitizer sees more of these.
if(GNOMON_SANITIZE)
  return()
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME Arrows.EveryFileKeepsThem COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_arrows.py)
add_test(NAME Arrows.AWrongOneIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_arrows.py --self-test)
add_test(NAME Tables.CodeReadsTheirFacts COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_tables.py)
add_test(NAME Tables.AComparisonIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_tables.py --self-test)
add_test(NAME Sizes.StayWithinTheirLimits COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_sizes.py)
add_test(NAME Sizes.WhatIsTooLargeIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_sizes.py --self-test)
add_test(NAME Prose.BreachesOnlyFall COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_prose.py)
add_test(NAME Prose.ABreachIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_prose.py --self-test)
add_test(NAME Summary.CountsWhatCtestReports
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/project/summary_test.py ${PROJECT_SOURCE_DIR}/.ci)
add_test(NAME SamePictures.FindsWhatDiffers
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/project/same_pictures_test.py ${PROJECT_SOURCE_DIR}/.ci)
add_test(NAME SameCost.FindsWhatCostsMore
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/project/same_cost_test.py ${PROJECT_SOURCE_DIR}/.ci)
add_test(NAME Launcher.KeepsItsPromises
  COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/project/launcher_test.sh ${PROJECT_SOURCE_DIR}/gnomon)
set_tests_properties(Arrows.EveryFileKeepsThem Arrows.AWrongOneIsFound Tables.CodeReadsTheirFacts Tables.AComparisonIsFound
  Sizes.StayWithinTheirLimits Sizes.WhatIsTooLargeIsFound
  Prose.BreachesOnlyFall Prose.ABreachIsFound Summary.CountsWhatCtestReports SamePictures.FindsWhatDiffers
  SameCost.FindsWhatCostsMore Launcher.KeepsItsPromises PROPERTIES LABELS unit TIMEOUT 60)
add_test(NAME Reference.HasNoWarning
  COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/project/reference_test.sh ${PROJECT_SOURCE_DIR})
set_tests_properties(Reference.HasNoWarning PROPERTIES LABELS unit TIMEOUT 120 SKIP_RETURN_CODE 77)
add_test(NAME Release.HasItsEntry COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_release.py)
add_test(NAME Release.AMissingEntryIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_release.py --self-test)
set_tests_properties(Release.HasItsEntry Release.AMissingEntryIsFound PROPERTIES LABELS unit TIMEOUT 60)
# Pages: links, pictures, commands, figures that stand twice, blocks that programs fill.
add_test(NAME Pages.AFaultIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_pages.py --self-test)
add_test(NAME Pages.AChangedBlockIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/generate_pages.py --self-test)
set_tests_properties(Pages.AFaultIsFound Pages.AChangedBlockIsFound PROPERTIES LABELS unit TIMEOUT 60)
if(GNOMON_SAMPLE)
  add_test(NAME Pages.HoldWhatTheySay
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_pages.py --bin $<TARGET_FILE_DIR:gnomon_game>)
  add_test(NAME Pages.SayWhatTheProgramsKnow
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/generate_pages.py --bin $<TARGET_FILE_DIR:gnomon_game> --check)
  set_tests_properties(Pages.HoldWhatTheySay Pages.SayWhatTheProgramsKnow PROPERTIES LABELS e2e TIMEOUT 120)
endif()
