if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_bench LABEL unit SOURCES bench/demand_test.cpp bench/filter_front_test.cpp bench/marked_text_test.cpp bench/other_surfaces_test.cpp
    bench/promise_test.cpp bench/row_pictures_test.cpp bench/sweep_findings_test.cpp bench/sweep_journal_test.cpp bench/sweep_plan_test.cpp bench/sweep_report_test.cpp bench/sweep_time_left_test.cpp bench/check_test.cpp
    LIBRARIES gnomon_bench_parts)
endif()
