# The hard cases in pictures, and the flicker bench's lookup against the shaders'.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_stability LABEL gl SOURCES
    exact_visibility_gl_test.cpp
    hard_cases_gl_test.cpp
    scale_and_place_gl_test.cpp
    LIBRARIES gnomon_bench_parts gnomon_hard_cases)
endif()
