# Scenes of boxes and planes, whose shadows are known in closed form.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_analytic LABEL gl SOURCES
    cube_routes_gl_test.cpp
    sampled_depths_gl_test.cpp
    cascades_gl_test.cpp
    prefiltered_gl_test.cpp
    projection_gl_test.cpp
    shadow_blending_gl_test.cpp
    shadow_limits_gl_test.cpp
    shadow_shape_gl_test.cpp
    shadow_shading_gl_test.cpp
    visibility_include_gl_test.cpp
    LIBRARIES gnomon_sample)
endif()
