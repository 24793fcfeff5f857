gnomon_tests(NAME unit_debug LABEL unit SOURCES 
  debug/depth_tiles_test.cpp debug/depth_view_test.cpp debug/lines_test.cpp debug/lookup_views_test.cpp
  debug/world_views_test.cpp)
