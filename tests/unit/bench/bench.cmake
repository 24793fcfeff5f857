if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_bench LABEL unit SOURCES bench/scaling/light_count_test.cpp bench/compare/pareto_front_test.cpp bench/flicker/camera_path_test.cpp bench/text/replace_doc_section_test.cpp bench/text/wrap_lines_test.cpp bench/accuracy/surface_mismatch_test.cpp bench/accuracy/air_accuracy_test.cpp
    bench/accuracy/default_limits_test.cpp bench/compare/crop_images_test.cpp bench/sweep/resume_log_test.cpp bench/sweep/sweep_plan_test.cpp bench/sweep/sweep_json_test.cpp bench/sweep/progress_test.cpp bench/check/check_test.cpp bench/area_table/lobe_fit_test.cpp
    LIBRARIES gnomon_bench_parts)
endif()
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
add_test(NAME SweepReport.SaysWhatTheFiguresShow
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/bench/sweep/report_test.py ${PROJECT_SOURCE_DIR}/bench/sweep)
set_tests_properties(SweepReport.SaysWhatTheFiguresShow PROPERTIES LABELS unit TIMEOUT 60
  ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
