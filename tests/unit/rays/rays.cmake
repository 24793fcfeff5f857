gnomon_tests(NAME unit_rays LABEL unit SOURCES rays/mesh_bvh_test.cpp rays/nearest_test.cpp rays/occlusion_test.cpp)
