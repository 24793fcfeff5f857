# Long lives and bad days: the same random world on the recording device and on the real one.
gnomon_tests(NAME system_soak LABEL system SOURCES soak/soak_world.cpp system/test_world.cpp system/soak_test.cpp)
gnomon_tests(NAME gl_soak LABEL long SOURCES soak/soak_world.cpp system/test_world.cpp gl/soak_gl_test.cpp)
gnomon_tests(NAME gl_bad_days LABEL gl SOURCES
  soak/soak_world.cpp system/test_world.cpp gl/context_loss_gl_test.cpp gl/out_of_memory_gl_test.cpp)
