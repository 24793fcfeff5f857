gnomon_tests(NAME gl_shaders LABEL gl SOURCES
  caster_texels_gl_test.cpp
  ray_list_gl_test.cpp
  ray_texels_gl_test.cpp
  shader_rows_gl_test.cpp
  LIBRARIES PkgConfig::EPOXY)
