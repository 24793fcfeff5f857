gnomon_tests(NAME unit_extract LABEL unit SOURCES
  extract/drawable_basis_test.cpp core/range_list_test.cpp extract/device_arrays_test.cpp extract/extract_test.cpp extract/streaming_extract_test.cpp extract/in_place_test.cpp allocation_counter.cpp extract/flat_range_test.cpp extract/plane_normals_test.cpp extract/ray_masks_test.cpp extract/volumes_test.cpp ../system/test_world.cpp)
