gnomon_tests(NAME unit_debug LABEL unit SOURCES debug/depth_tiles_test.cpp debug/depth_view_test.cpp)
