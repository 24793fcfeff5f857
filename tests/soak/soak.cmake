# Long lives and bad days: the same random world on the recording device and on the real one.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME system_faults LABEL system TIMEOUT 900 LIBRARIES gnomon_sample SOURCES
    system/test_world.cpp system/fault_scenes.cpp system/fault_play.cpp system/every_call_fails_test.cpp)
  gnomon_tests(NAME gl_faults LABEL gl LIBRARIES gnomon_gui PkgConfig::EPOXY SOURCES
    system/test_world.cpp system/fault_scenes.cpp gl/failing_gl.cpp gl/out_of_memory_gl_test.cpp
    soak/soak_world.cpp gl/context_loss_gl_test.cpp gl/overlay_gl_test.cpp)
endif()
gnomon_tests(NAME system_soak LABEL system SOURCES soak/soak_world.cpp system/test_world.cpp system/soak_test.cpp
  system/streaming_soak_test.cpp)
# The executable when its context is lost under it.
if(GNOMON_SAMPLE)
  add_library(gnomon_lose_context MODULE e2e/lose_context.cpp)
  target_link_libraries(gnomon_lose_context PRIVATE gnomon_options)
endif()
if(GNOMON_SAMPLE AND NOT GNOMON_SANITIZE)
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
  add_test(NAME e2e_context_loss
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/e2e/test_context_loss.py
            $<TARGET_FILE:gnomon_game> $<TARGET_FILE:gnomon_scene_generator> $<TARGET_FILE:gnomon_lose_context>)
  set_tests_properties(e2e_context_loss PROPERTIES LABELS e2e TIMEOUT 600 ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
endif()
