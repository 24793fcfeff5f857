#include "systems/shadow/request/light_kinds.h"

#include <iterator>

#include "systems/shadow/projection/far_lamp_aim.h"

namespace gnomon::shadow {
namespace {

/// Default number of a sun's cascades. Each about doubles the depth range of one texel size
/// (docs/explanation/accuracy.md).
constexpr std::uint32_t kCascades = 4;

constexpr LightKindRow kKindRows[] = {
    {LightKind::directional, "directional", "LIGHT_DIRECTIONAL", "shadow/lookup/kinds/directional.glsl",
     gl::TextureKind::array, kCascades, fit_directional, nullptr},
    {LightKind::spot, "spot", "LIGHT_SPOT", "shadow/lookup/kinds/spot.glsl", gl::TextureKind::array, 1, fit_spot,
     add_spot_frusta},
    {LightKind::point, "point", "LIGHT_POINT", "shadow/lookup/kinds/point.glsl", gl::TextureKind::cube, 6, fit_point,
     add_cube_frusta},
    {LightKind::rectangle, "rectangle", "LIGHT_RECTANGLE", "shadow/lookup/kinds/point.glsl", gl::TextureKind::cube, 6,
     fit_point, add_cube_frusta},
    {LightKind::disc, "disc", "LIGHT_DISC", "shadow/lookup/kinds/point.glsl", gl::TextureKind::cube, 6, fit_point,
     add_cube_frusta},
    {LightKind::sphere, "sphere", "LIGHT_SPHERE", "shadow/lookup/kinds/point.glsl", gl::TextureKind::cube, 6, fit_point,
     add_cube_frusta},
    {LightKind::tube, "tube", "LIGHT_TUBE", "shadow/lookup/kinds/point.glsl", gl::TextureKind::cube, 6, fit_point,
     add_cube_frusta},
};

constexpr bool kinds_are_in_order() {
    for (std::size_t i = 0; i < std::size(kKindRows); ++i)
        if (static_cast<std::size_t>(kKindRows[i].kind) != i) return false;
    return true;
}
static_assert(kinds_are_in_order());

}  // namespace

std::span<const LightKindRow> light_kind_table() { return kKindRows; }

const LightKindRow& light_kind_row(LightKind kind) { return kKindRows[static_cast<std::size_t>(kind)]; }

LightFrusta light_frusta(const LightItem& light, const ShadowRequest& request) {
    LightFrusta frusta;
    const FrustaFunction add = light_kind_row(light.kind).frusta;
    if (request.projection.aim.used)
        frusta.items[frusta.count++] = aimed_frustum(light, request.projection.aim);
    else if (add)
        add(light, request, frusta);
    return frusta;
}

gl::TextureKind map_texture(const LightItem& light, const ShadowRequest& request) {
    return request.projection.aim.used ? gl::TextureKind::array : light_kind_row(light.kind).texture;
}

}  // namespace gnomon::shadow

namespace gnomon {

const char* to_text(LightKind kind) { return shadow::light_kind_row(kind).name.data(); }

}  // namespace gnomon
