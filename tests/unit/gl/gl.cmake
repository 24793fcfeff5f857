gnomon_tests(NAME unit_gl LABEL unit SOURCES
  gl/bindings_test.cpp
  gl/commands_test.cpp
  gl/descriptions_test.cpp
  gl/draw_records_test.cpp
  gl/glsl_library_test.cpp
  gl/recording_device_test.cpp
  gl/recording_misuse_test.cpp
  gl/shader_source_test.cpp)
