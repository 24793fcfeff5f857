# What stands between gnomon::Shadows and an engine's own scene.
gnomon_tests(NAME unit_embed LABEL unit
  SOURCES embed/entt_bridge_test.cpp embed/layered_scene_test.cpp embed/limits_page_test.cpp embed/picture_lens_test.cpp embed/air_box_test.cpp embed/scene_store_test.cpp embed/streamed_casters_test.cpp embed/version_test.cpp embed/zone_test.cpp allocation_counter.cpp)
gnomon_compiled_alone(embed/zone_test.cpp)
target_compile_definitions(unit_embed PRIVATE GNOMON_PROJECT_VERSION="${PROJECT_VERSION}")
