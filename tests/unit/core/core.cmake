include(${CMAKE_CURRENT_LIST_DIR}/core_tests.cmake)
# The others compare with the system and with the shader's text, which they compile as C++.
gnomon_tests(NAME unit_core LABEL unit SOURCES ${GNOMON_CORE_TESTS}
  core/core_stages_test.cpp core/core_shader_bias_test.cpp allocation_counter.cpp ../system/test_world.cpp)
target_include_directories(unit_core PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
gnomon_compiled_alone(core/core_shader_bias_test.cpp)
