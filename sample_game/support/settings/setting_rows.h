#pragma once
#include <span>

#include "sample_game/support/settings/light_settings.h"

/// The rows of setting_groups(), group by group.
namespace gnomon::game {

std::span<const LightSetting> shadow_rows();
std::span<const LightSetting> size_rows();
std::span<const LightSetting> kernel_rows();
std::span<const LightSetting> moments_rows();
std::span<const LightSetting> bias_rows();
std::span<const LightSetting> projection_rows();
std::span<const LightSetting> cascades_rows();
std::span<const LightSetting> maps_rows();
std::span<const LightSetting> reuse_rows();

}  // namespace gnomon::game
