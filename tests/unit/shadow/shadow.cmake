gnomon_tests(NAME unit_shadow LABEL unit LIBRARIES gnomon_oracle SOURCES
  shadow/cascade_fit_test.cpp shadow/gliding_ends_test.cpp shadow/splits_test.cpp shadow/sampled_depths_test.cpp shadow/demand_test.cpp shadow/local_fit_test.cpp shadow/lamp_aim_test.cpp shadow/predicted_error_test.cpp shadow/sets_test.cpp shadow/nearest_receiver_test.cpp shadow/swept_volume_test.cpp shadow/fit_test.cpp shadow/rectangle_test.cpp
  shadow/projection_test.cpp shadow/screen_rectangle_test.cpp shadow/content_signature_test.cpp shadow/caster_motion_test.cpp shadow/warped_bias_test.cpp shadow/manual_bias_test.cpp shadow/warped_fit_test.cpp shadow/marks_test.cpp
  shadow/contract_test.cpp shadow/filter_choice_test.cpp shadow/cascade_count_test.cpp shadow/draw_times_test.cpp shadow/extents_test.cpp shadow/filter_demand_test.cpp shadow/poisson_disk_test.cpp shadow/seed_cell_test.cpp shadow/sheet_items_test.cpp shadow/moments_test.cpp shadow/source_fit_test.cpp shadow/staleness_test.cpp shadow/draw_spread_test.cpp
  shadow/budget_test.cpp shadow/clearance_test.cpp shadow/lamp_places_test.cpp shadow/lookup_signature_test.cpp shadow/lookup_accuracy_test.cpp shadow/program_row_test.cpp shadow/cost_clock_test.cpp)
# warped_bias_test.cpp, manual_bias_test.cpp and moments_test.cpp compile the shaders' text as C++.
target_include_directories(unit_shadow PRIVATE ${PROJECT_SOURCE_DIR}/shaders)
