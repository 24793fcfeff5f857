if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_sample LABEL unit LIBRARIES gnomon_sample
    SOURCES sample/animation_player_test.cpp sample/command_line_test.cpp sample/courtyard_test.cpp sample/spheres_test.cpp sample/valley_test.cpp sample/game_test.cpp sample/light_settings_test.cpp
            sample/debug_request_test.cpp sample/footing_test.cpp sample/gamepad_test.cpp sample/light_graph_test.cpp sample/motion_test.cpp sample/picture_files_test.cpp sample/presets_test.cpp sample/spawn_test.cpp)
endif()
