# What decides a pixel's shadow exactly.
if(GNOMON_SAMPLE)
  gnomon_tests(NAME gl_sheets LABEL gl SOURCES
    exact_scenes_gl_test.cpp
    seen_places_gl_test.cpp
    sheets_gl_test.cpp
    sheets_of_scenes_gl_test.cpp
    soft_sheets_gl_test.cpp
    LIBRARIES gnomon_bench_parts)
endif()
