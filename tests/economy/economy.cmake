# What is saved loses nothing: scripted runs, with economy and without, on the recording device and on the real one.
set(GNOMON_ECONOMY_SOURCES economy/both_ways.cpp economy/changing_world.cpp system/test_world.cpp)
gnomon_tests(NAME system_economy LABEL system SOURCES
  ${GNOMON_ECONOMY_SOURCES} economy/map_contents.cpp system/economy_identity_test.cpp system/lights_per_camera_test.cpp system/one_writer_test.cpp)
if(GNOMON_SAMPLE)
  gnomon_tests(NAME system_many_lights LABEL system SOURCES system/many_lights_test.cpp LIBRARIES gnomon_bench_parts)
  gnomon_tests(NAME gl_economy LABEL gl LIBRARIES gnomon_bench_parts SOURCES
    gl/hidden_lights_gl_test.cpp gl/kept_visibility_gl_test.cpp gl/dim_lights_gl_test.cpp gl/light_passes_gl_test.cpp)
endif()
