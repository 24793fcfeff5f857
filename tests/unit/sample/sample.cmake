if(GNOMON_SAMPLE)
  gnomon_tests(NAME unit_sample LABEL unit LIBRARIES gnomon_sample
    SOURCES sample/support/scene/animation_player_test.cpp sample/app/command_line_test.cpp sample/support/built_in_scenes/courtyard_test.cpp sample/support/built_in_scenes/spheres_test.cpp sample/support/built_in_scenes/valley_test.cpp sample/support/built_in_scenes/city_test.cpp sample/game/rules_test.cpp sample/support/settings/light_settings_test.cpp
            sample/app/debug_option_test.cpp sample/game/step_climbing_test.cpp sample/app/gamepad_test.cpp sample/gui/light_history_test.cpp sample/support/scene/node_motion_test.cpp sample/support/files/image_files_test.cpp sample/support/settings/presets_test.cpp sample/support/settings/setting_uses_test.cpp sample/support/scene/spawn_scene_test.cpp)
endif()
