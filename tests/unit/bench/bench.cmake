if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_bench LABEL unit SOURCES bench/scaling/light_count_test.cpp bench/compare/pareto_front_test.cpp bench/text/replace_doc_section_test.cpp bench/accuracy/surface_mismatch_test.cpp
    bench/accuracy/default_limits_test.cpp bench/compare/crop_images_test.cpp bench/sweep/analysis_test.cpp bench/sweep/resume_log_test.cpp bench/sweep/sweep_plan_test.cpp bench/sweep/sweep_report_test.cpp bench/sweep/progress_test.cpp bench/check/check_test.cpp
    LIBRARIES gnomon_bench_parts)
endif()
