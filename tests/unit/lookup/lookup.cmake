gnomon_tests(NAME unit_lookup LABEL unit SOURCES
  lookup/lookup_glsl_test.cpp)
