#include "systems/lighting/lighting_targets.h"

namespace gnomon::lighting {
namespace {

/// Format of SurfacePlace in shaders/lighting/gbuffer/visible_triangle.glsl.
constexpr gl::Format kPlaceFormat = gl::Format::rgba32ui;
constexpr gl::Format kDepthFormat = gl::Format::d32f;

}  // namespace

bool LightingTargets::make(gl::TextureHandle& texture, const char* label, gl::Format format, std::uint32_t width,
                           std::uint32_t height, std::uint32_t mips) {
    const auto made = device_.create_texture({label, gl::TextureKind::flat, format, width, height, 1, mips}, {});
    texture = made.handle;
    failure_ = made.failure;
    return static_cast<bool>(texture);
}

bool LightingTargets::make(gl::TargetHandle& target, const char* label,
                           std::initializer_list<gl::TextureHandle> colours, gl::TextureHandle depth_texture) {
    gl::TargetDesc desc{label, {}, {depth_texture, -1}};
    for (const gl::TextureHandle c : colours) desc.colours.push_back({c, -1});
    const auto made = device_.create_target(desc);
    target = made.handle;
    failure_ = made.failure;
    return static_cast<bool>(target);
}

bool LightingTargets::resize(glm::uvec2 size) {
    if (size == size_px_ && picture_target) return true;
    release();
    const bool made = make(depth, "surface depth", kDepthFormat, size.x, size.y) &&
                      make(colour, "surface colour", gl::Format::srgb8_a8, size.x, size.y) &&
                      make(normals, "surface normals", gl::Format::rgba16_snorm, size.x, size.y) &&
                      make(material, "surface material", gl::Format::rgba8, size.x, size.y) &&
                      make(light_sum, "light sum", gl::Format::rgba16f, size.x, size.y) &&
                      make(luminance, "luminance", gl::Format::rg32f, kLuminanceSide_px, kLuminanceSide_px, 0) &&
                      make(picture, "picture", gl::Format::srgb8_a8, size.x, size.y) &&
                      make(surface_target, "surfaces", {colour, normals, material, light_sum}, depth) &&
                      make(light_target, "light sum", {light_sum}, depth) &&
                      make(luminance_target, "luminance", {luminance}, {}) &&
                      make(picture_target, "picture", {picture}, {});
    if (!made) {
        release();
        return false;
    }
    size_px_ = size;
    return true;
}

bool LightingTargets::ensure_visibility() {
    if (visibility_target) return true;
    if (!picture_target) return false;
    if (make(visibility, "visibility", gl::Format::r32f, size_px_.x, size_px_.y) &&
        make(visibility_target, "visibility", {visibility}, {}))
        return true;
    device_.destroy(visibility);
    visibility = {};
    return false;
}

bool LightingTargets::ensure_tint() {
    if (tint_target) return true;
    if (!picture_target) return false;
    if (make(tint, "tint", gl::Format::rgba32f, size_px_.x, size_px_.y) && make(tint_target, "tint", {tint}, {}))
        return true;
    device_.destroy(tint);
    tint = {};
    return false;
}

bool LightingTargets::provide_places(bool wanted) {
    if (wanted == static_cast<bool>(places_target)) return true;
    const bool made = wanted && make(places, "surface places", kPlaceFormat, size_px_.x, size_px_.y) &&
                      make(places_target, "surface places", {colour, normals, material, light_sum, places}, depth);
    if (!made) release_places();
    return made == wanted;
}

bool LightingTargets::provide_undecided(bool wanted) {
    if (wanted == static_cast<bool>(undecided_target)) return true;
    const bool made = wanted && make(undecided, "undecided depth", kDepthFormat, size_px_.x, size_px_.y) &&
                      make(undecided_target, "undecided light", {light_sum}, undecided);
    if (!made) release_undecided();
    return made == wanted;
}

std::uint64_t LightingTargets::place_bytes() const {
    return places ? std::uint64_t{gl::texel_bytes(kPlaceFormat)} * size_px_.x * size_px_.y : 0;
}

void LightingTargets::release_places() {
    device_.destroy(places_target);
    device_.destroy(places);
    places_target = {};
    places = {};
}

void LightingTargets::release_undecided() {
    device_.destroy(undecided_target);
    device_.destroy(undecided);
    undecided_target = {};
    undecided = {};
}

void LightingTargets::release() {
    release_places();
    release_undecided();
    for (gl::TargetHandle* t :
         {&surface_target, &light_target, &luminance_target, &picture_target, &visibility_target, &tint_target}) {
        device_.destroy(*t);
        *t = {};
    }
    for (gl::TextureHandle* t :
         {&depth, &colour, &normals, &material, &light_sum, &luminance, &picture, &visibility, &tint}) {
        device_.destroy(*t);
        *t = {};
    }
    size_px_ = {0, 0};
}

}  // namespace gnomon::lighting
