gnomon_tests(NAME unit_truth LABEL unit SOURCES truth/error_tints_test.cpp)
if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_truth_scenes LABEL unit LIBRARIES gnomon_oracle gnomon_sample SOURCES truth/picture_truth_test.cpp truth/tint_truth_test.cpp)
endif()
