# The real pipeline against the ray tracer, through the bench's own measurement.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_truth LABEL gl SOURCES
    any_world_gl_test.cpp
    audit_gl_test.cpp
    edge_flicker_gl_test.cpp
    error_gate_gl_test.cpp
    left_out_lights_gl_test.cpp
    mean_error_gate_gl_test.cpp
    resolved_edges_gl_test.cpp
    recorded_errors.cpp
    soft_shadows_gl_test.cpp
    area_lights_gl_test.cpp
    sweep_bounds_gl_test.cpp
    sweep_gl_test.cpp
    truth_accuracy_gl_test.cpp
    truth_contract_gl_test.cpp
    truth_controls_gl_test.cpp
    truth_data_gl_test.cpp
    truth_edges_gl_test.cpp
    truth_planes_gl_test.cpp
    truth_source_gl_test.cpp
    truth_warp_gl_test.cpp
    antialias_gl_test.cpp
    ../data/data_files.cpp
    LIBRARIES gnomon_bench_parts gnomon_hard_cases)
endif()
# What claims to have no wrong pixel.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_exact LABEL gl SOURCES
    exact_scenes_gl_test.cpp
    exact_soft_gl_test.cpp
    exact_worlds_gl_test.cpp
    LIBRARIES gnomon_bench_parts)
endif()
# What a machine is checked by, checked; and that nothing is timed that was not drawn.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_check LABEL gl SOURCES check_gl_test.cpp failed_frame_gl_test.cpp failing_gl.cpp
    LIBRARIES gnomon_bench_parts PkgConfig::EPOXY)
endif()
