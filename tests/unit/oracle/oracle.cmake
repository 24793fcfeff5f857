gnomon_tests(NAME unit_oracle LABEL unit
  SOURCES oracle/alpha_mask_test.cpp oracle/area_flicker_test.cpp oracle/area_truth_test.cpp oracle/edge_exceptions_test.cpp oracle/far_errors_test.cpp oracle/lamp_on_floor_test.cpp oracle/metrics_test.cpp oracle/nearest_to_light_test.cpp oracle/soft_truth_test.cpp oracle/spread_test.cpp oracle/tracer_layers_test.cpp
  oracle/tracer_test.cpp oracle/triangle_test_test.cpp
  LIBRARIES gnomon_oracle)
