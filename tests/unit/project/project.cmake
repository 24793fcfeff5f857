# What holds of the project as a whole: who may include whom, and that the launcher does what it says.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME Arrows.EveryFileKeepsThem COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_arrows.py)
add_test(NAME Arrows.AWrongOneIsFound COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/.ci/check_arrows.py --self-test)
add_test(NAME Summary.CountsWhatCtestReports
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/project/summary_test.py ${PROJECT_SOURCE_DIR}/.ci)
add_test(NAME Launcher.KeepsItsPromises
  COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/project/launcher_test.sh ${PROJECT_SOURCE_DIR}/gnomon)
set_tests_properties(Arrows.EveryFileKeepsThem Arrows.AWrongOneIsFound Summary.CountsWhatCtestReports
  Launcher.KeepsItsPromises PROPERTIES LABELS unit TIMEOUT 60)
