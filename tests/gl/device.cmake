gnomon_tests(NAME gl_device LABEL gl SOURCES
  device_context_gl_test.cpp
  device_depth_gl_test.cpp
  device_draw_gl_test.cpp
  device_imports_gl_test.cpp
  device_pulled_gl_test.cpp
  device_readback_gl_test.cpp
  device_resources_gl_test.cpp
  device_state_gl_test.cpp)
