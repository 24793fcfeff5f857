gnomon_tests(NAME gl_device LABEL gl SOURCES
  device_context_gl_test.cpp
  device_depth_gl_test.cpp
  device_draw_gl_test.cpp
  device_draw_records_gl_test.cpp
  device_imports_gl_test.cpp
  device_pulled_gl_test.cpp
  device_readback_gl_test.cpp
  device_resources_gl_test.cpp
  device_state_gl_test.cpp)
# The same on a device that keeps the state of others.
gnomon_tests(NAME gl_device_kept LABEL gl SOURCES
  device_depth_gl_test.cpp
  device_draw_gl_test.cpp
  device_draw_records_gl_test.cpp
  device_imports_gl_test.cpp
  device_pulled_gl_test.cpp
  device_readback_gl_test.cpp
  device_resources_gl_test.cpp
  device_state_gl_test.cpp)
if(TARGET gl_device_kept)
  target_compile_definitions(gl_device_kept PRIVATE GNOMON_KEPT_STATE)
endif()
