# Every file of the test data, as a whole frame on the recording device; gl_truth draws them.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME system_data LABEL system TIMEOUT 900 LIBRARIES gnomon_sample
    SOURCES data/data_files.cpp system/data_folder_test.cpp system/bad_files_test.cpp
            unit/assets/bad_input.cpp unit/assets/bad_skin_input.cpp unit/assets/gltf_builder.cpp)
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
  add_test(NAME e2e_data
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/e2e/test_data.py
            $<TARGET_FILE:gnomon_game> $<TARGET_FILE:gnomon_scene_generator>)
  set_tests_properties(e2e_data PROPERTIES LABELS e2e TIMEOUT 300
    SKIP_RETURN_CODE 77 ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
endif()
