# The real pipeline against the ray tracer, through the bench's own measurement; hard cases and files of the test data, too.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_truth LABEL gl SOURCES
    any_world_gl_test.cpp
    audit_gl_test.cpp
    data_folder_gl_test.cpp
    error_gate_gl_test.cpp
    hard_cases_gl_test.cpp
    left_out_lights_gl_test.cpp
    mean_error_gate_gl_test.cpp
    recorded_errors.cpp
    scale_and_place_gl_test.cpp
    truth_accuracy_gl_test.cpp
    truth_data_gl_test.cpp
    ../data/data_files.cpp
    LIBRARIES gnomon_bench_parts gnomon_hard_cases)
endif()
# What a machine is checked by, checked; and that nothing is timed that was not drawn.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_check LABEL gl SOURCES check_gl_test.cpp failed_frame_gl_test.cpp failing_gl.cpp
    LIBRARIES gnomon_bench_parts PkgConfig::EPOXY)
endif()
