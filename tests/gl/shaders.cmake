gnomon_tests(NAME gl_shaders LABEL gl SOURCES
  shader_layout_gl_test.cpp
  shader_rows_gl_test.cpp
  LIBRARIES gnomon_shaders PkgConfig::EPOXY)
