# What only `./gnomon test --long` runs, whatever its subject: tests/long_suites.txt names what stands for it in a short run,
# which so has less to compile.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_long LONG LABEL gl TIMEOUT 3600 SOURCES
    air_accuracy_gl_test.cpp
    antialias_gl_test.cpp
    area_lights_gl_test.cpp
    edge_flicker_gl_test.cpp
    resolved_edges_gl_test.cpp
    soft_shadows_gl_test.cpp
    sweep_bounds_gl_test.cpp
    sweep_gl_test.cpp
    truth_contract_gl_test.cpp
    truth_controls_gl_test.cpp
    truth_edges_gl_test.cpp
    truth_planes_gl_test.cpp
    truth_source_gl_test.cpp
    truth_warp_gl_test.cpp
    exact_soft_gl_test.cpp
    exact_visibility_gl_test.cpp
    exact_worlds_gl_test.cpp
    creases_gl_test.cpp
    flat_receivers_gl_test.cpp
    planes_gl_test.cpp
    shadow_cube_gl_test.cpp
    fog_gl_test.cpp
    smoothed_edges_gl_test.cpp
    lookup_gl_test.cpp
    lookup_hardware_gl_test.cpp
    every_pair_of_rows_gl_test.cpp
    shader_layout_gl_test.cpp
    economy_identity_gl_test.cpp
    every_gl_call_fails_test.cpp
    soak_gl_test.cpp
    failing_gl.cpp
    ../economy/both_ways.cpp
    ../economy/changing_world.cpp
    ../soak/soak_world.cpp
    ../system/fault_scenes.cpp
    ../system/test_world.cpp
    LIBRARIES gnomon_bench_parts PkgConfig::EPOXY)
endif()
