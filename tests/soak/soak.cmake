# Long lives and bad days: the same random world on the recording device and on the real one.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME system_faults LABEL system TIMEOUT 900 LIBRARIES gnomon_sample SOURCES
    system/test_world.cpp system/fault_scenes.cpp system/fault_play.cpp system/every_call_fails_test.cpp)
  gnomon_tests(NAME gl_faults LABEL gl TIMEOUT 3600 LIBRARIES gnomon_sample PkgConfig::EPOXY SOURCES
    system/test_world.cpp system/fault_scenes.cpp gl/failing_gl.cpp gl/every_gl_call_fails_test.cpp
    soak/soak_world.cpp gl/context_loss_gl_test.cpp)
endif()
gnomon_tests(NAME system_soak LABEL system SOURCES soak/soak_world.cpp system/test_world.cpp system/soak_test.cpp)
gnomon_tests(NAME gl_soak LABEL gl TIMEOUT 1200 SOURCES soak/soak_world.cpp system/test_world.cpp gl/soak_gl_test.cpp)
gnomon_tests(NAME gl_bad_days LABEL gl SOURCES system/test_world.cpp gl/out_of_memory_gl_test.cpp)
