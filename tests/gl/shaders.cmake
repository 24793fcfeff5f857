gnomon_tests(NAME gl_shaders LABEL gl SOURCES
  caster_texels_gl_test.cpp
  ray_list_gl_test.cpp
  ray_texels_gl_test.cpp
  shader_layout_gl_test.cpp
  shader_rows_gl_test.cpp
  LIBRARIES PkgConfig::EPOXY)
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_rows LABEL gl SOURCES every_pair_of_rows_gl_test.cpp light_passes_gl_test.cpp
    LIBRARIES gnomon_bench_parts)
endif()
