gnomon_tests(NAME unit_assets LABEL unit LIBRARIES nlohmann_json::nlohmann_json
  SOURCES assets/animation_test.cpp assets/bad_input.cpp assets/bad_input_test.cpp assets/bad_skin_input.cpp assets/bad_resource_test.cpp assets/bad_uri_test.cpp
          assets/data_folder_test.cpp assets/deformer_test.cpp assets/inner_box_test.cpp assets/gltf_builder.cpp assets/living_import_test.cpp
          assets/material_import_test.cpp assets/mesh_import_test.cpp assets/scene_import_test.cpp
          assets/neighbours_test.cpp assets/surface_edges_test.cpp assets/taken_input_test.cpp assets/topology_test.cpp ../fuzz/gltf_mutation_test.cpp ../fuzz/gltf_mutator.cpp
          ../data/data_files.cpp)
if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_proxies LABEL unit LIBRARIES gnomon_sample
    SOURCES assets/proxies_test.cpp ../data/data_files.cpp)
endif()
