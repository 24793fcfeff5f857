gnomon_tests(NAME unit_transform LABEL unit SOURCES
  transform/transform_system_test.cpp transform/transform_quarantine_test.cpp transform/transform_cost_test.cpp
  allocation_counter.cpp)
