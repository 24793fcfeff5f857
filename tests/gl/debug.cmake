# Debug views against oracles that know the scene, not the views.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_debug LABEL gl SOURCES
    debug_depth_gl_test.cpp
    debug_lines_gl_test.cpp
    debug_lookups_gl_test.cpp
    frozen_fits_gl_test.cpp
    LIBRARIES gnomon_sample)
endif()
