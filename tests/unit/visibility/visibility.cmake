gnomon_tests(NAME unit_visibility LABEL unit LIBRARIES gnomon_oracle
  SOURCES visibility/instance_tree_test.cpp visibility/lamp_on_floor_test.cpp visibility/light_queries_test.cpp visibility/streaming_trees_test.cpp visibility/visibility_queries_test.cpp allocation_counter.cpp)
if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_visibility_scenes LABEL unit LIBRARIES gnomon_oracle gnomon_sample
    SOURCES visibility/real_scenes_test.cpp)
endif()
