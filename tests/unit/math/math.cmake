gnomon_tests(NAME unit_math LABEL unit SOURCES
  math/aabb_test.cpp math/frustum_test.cpp math/clip_box_test.cpp math/projection_test.cpp
  math/bounds_tree_test.cpp math/inner_hull_test.cpp math/shape_tree_test.cpp math/convex_polygon_test.cpp math/cone_test.cpp allocation_counter.cpp)
