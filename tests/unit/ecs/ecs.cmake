gnomon_tests(NAME unit_ecs LABEL unit SOURCES
  ecs/registry_test.cpp ecs/change_list_test.cpp ecs/registry_model_test.cpp allocation_counter.cpp)
