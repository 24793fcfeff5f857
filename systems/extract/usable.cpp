#include "systems/extract/usable.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "systems/extract/light_facts.h"

namespace gnomon {

namespace {

bool is_source_size(float size_m, float most_m) { return size_m > 0.0f && size_m <= most_m; }

/// Returns whether an area light has an area.
bool has_area(const Light& light) {
    constexpr float kMostSide_m = 2.0f * kMostSourceRadius_m;
    const SourceShape shape = light_facts(light.kind).shape;
    const bool wide = shape == SourceShape::rectangle || shape == SourceShape::tube;
    if (wide && !is_source_size(light.width_m, kMostSide_m)) return false;
    if (shape == SourceShape::rectangle) return is_source_size(light.height_m, kMostSide_m);
    return shape == SourceShape::facing || is_source_size(light.source_radius_m, kMostSourceRadius_m);
}

}  // namespace

bool usable(const Light& light) {
    const bool numbers = std::isfinite(light.intensity) && light.intensity >= 0.0f && std::isfinite(light.range_m) &&
                         light.range_m >= 0.0f && light.colour.r >= 0.0f && light.colour.g >= 0.0f &&
                         light.colour.b >= 0.0f && std::isfinite(light.colour.r + light.colour.g + light.colour.b);
    // Shaders multiply both in float: an infinite product becomes NaN where no light arrives.
    if (!numbers || !std::isfinite(light.intensity * (light.colour.r + light.colour.g + light.colour.b))) return false;
    if (!has_area(light)) return false;
    return !light_facts(light.kind).cone ||
           (light.outer_cone_rad > 0.0f && light.outer_cone_rad <= glm::half_pi<float>() * 1.000001f &&
            light.inner_cone_rad >= 0.0f && light.inner_cone_rad <= light.outer_cone_rad);
}

bool usable(const FogVolume& fog) {
    const auto within = [](float value, float least, float most) { return value >= least && value <= most; };
    const glm::dvec3& half_m = fog.half_extent_m;
    const bool box =
        half_m.x > 0.0 && half_m.y > 0.0 && half_m.z > 0.0 && std::isfinite(half_m.x + half_m.y + half_m.z);
    return box && within(fog.extinction_per_m, 0.0f, 1000.0f) && within(fog.albedo.r, 0.0f, 1.0f) &&
           within(fog.albedo.g, 0.0f, 1.0f) && within(fog.albedo.b, 0.0f, 1.0f) &&
           within(fog.anisotropy, -0.95f, 0.95f);
}

bool usable(const Camera& camera) {
    if (!(camera.near_m < camera.far_m)) return false;
    if (camera.projection == CameraProjection::orthographic)
        return camera.half_height_m > 0.0 && std::isfinite(camera.half_height_m) && std::isfinite(camera.far_m) &&
               std::isfinite(camera.near_m);
    return camera.near_m > 0.0 && camera.fov_y_rad > 0.0 && camera.fov_y_rad < glm::pi<double>();
}

}  // namespace gnomon
