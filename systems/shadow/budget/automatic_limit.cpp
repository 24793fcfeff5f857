#include "systems/shadow/budget/automatic_limit.h"

#include "systems/shadow/request/map_textures.h"

namespace gnomon::shadow {

std::uint64_t automatic_limit(std::span<const ConsumerItem> consumers) {
    std::uint64_t pixels = 0;
    for (const ConsumerItem& consumer : consumers)
        pixels += std::uint64_t{consumer.viewport_px.x} * consumer.viewport_px.y;
    if (pixels <= kLimitPixels) return kAutomatic_bytes;
    return static_cast<std::uint64_t>(static_cast<double>(kAutomatic_bytes) * static_cast<double>(pixels) /
                                      static_cast<double>(kLimitPixels));
}

bool leaves_size(const LightItem& light) {
    const LightShadow& shadow = light.shadow;
    return shadow.resolution_px == 0 && !(shadow.max_error_px > 0.0f) && !(shadow.narrowest_caster_px > 0.0f);
}

WantedBytes wanted_bytes(const SceneSnapshot& scene, const FittedViews& fitted, std::span<const LightStatus> statuses) {
    WantedBytes wanted;
    for (std::size_t i = 0; i < fitted.lights.size(); ++i) {
        const FitChoice& choice = fitted.lights[i];
        if (choice.request.skip != Reason::none || statuses[i].is_skipped() || choice.views.count == 0) continue;
        (leaves_size(scene.lights[i]) ? wanted.limited : wanted.given) += map_bytes(scene.lights[i], choice.request);
    }
    return wanted;
}

}  // namespace gnomon::shadow
