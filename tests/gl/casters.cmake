# Which casters are drawn, by which faces and through which mask.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_casters LABEL gl SOURCES
    shadow_layers_gl_test.cpp
    bars_along_light_gl_test.cpp
    caster_faces_gl_test.cpp
    far_lamps_gl_test.cpp
    few_draws_gl_test.cpp
    fine_meshes_gl_test.cpp
    flat_casters_gl_test.cpp
    lamps_on_planes_gl_test.cpp
    ledges_gl_test.cpp
    masked_casters_gl_test.cpp
    moved_casters_gl_test.cpp
    proxies_gl_test.cpp
    refresh_gl_test.cpp
    resolved_width_gl_test.cpp
    short_references_gl_test.cpp
    vertex_colours_gl_test.cpp
    budget_gl_test.cpp
    ../economy/both_ways.cpp
    LIBRARIES gnomon_bench_parts)
  # Translucent casters, by maps and by rays.
  gnomon_tests(NAME gl_tint LABEL gl SOURCES
    tint_gl_test.cpp
    tint_hard_cases_gl_test.cpp
    LIBRARIES gnomon_sample gnomon_oracle)
endif()
