gnomon_tests(NAME system_budget_refresh LABEL system SOURCES test_world.cpp budget_refresh_test.cpp refresh_test.cpp)
# 200 shadowed lights within a budget: the level of ./gnomon bench demand on the recording device.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME system_budget LABEL system SOURCES
    automatic_limit_test.cpp budget_test.cpp copy_room_test.cpp test_world.cpp ${PROJECT_SOURCE_DIR}/bench/scaling/many_lights_scene.cpp LIBRARIES gnomon_sample)
endif()
