#include "systems/embed/draw_drawables.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/gl/device_gl45.h"

namespace gnomon::embed {
namespace {

/// Clears a map's triangles: no texel shows any (kNoTriangle in shaders/shadow/filters/triangles/mesh_walk.glsl). In a
/// map with one number per texel all bits of its triangle say so (TriangleReferences).
constexpr float kNoTriangle = 4294967296.0f;  // the largest integer of a cleared format (gl::is_integer)

}  // namespace

gl::Failure draw_drawables(gl::Device& device, const SceneStore& store, const ViewGroup& group, gl::CommandList& list) {
    const std::span<const shadow::EngineDraw> draws = group.shadows.engine_draws();
    if (draws.empty()) return gl::Failure::none;
    const auto area = [](const shadow::EngineDraw& draw) {
        const auto size = static_cast<std::int32_t>(draw.size_px);
        return gl::Rect{0, 0, size, size};
    };
    list.clear();
    list.add(gl::BeginGroup{"drawables"});
    for (const shadow::EngineDraw& draw : draws) {
        if (!draw.clears) continue;
        const float first = draw.triangle_bits > 0 ? std::exp2(static_cast<float>(draw.triangle_bits)) - 1.0f : 0.0f;
        list.add(gl::BeginPass{draw.target, area(draw), true, 0.0f, true, {first, kNoTriangle, 0.0f, 0.0f}});
        list.add(gl::EndPass{});
    }
    list.add(gl::EndGroup{});
    const gl::Failure failure = device.submit(list).failure;
    for (const shadow::EngineDraw& draw : draws) {
        const auto* engine = store.draw_of(draw.instance);
        if (!engine) continue;
        const glm::dmat4 anchor_from_world = glm::translate(glm::dmat4(1.0), -draw.anchor_ws_m);
        const DrawableView view{glm::mat4(glm::dmat4(draw.clip_from_anchor) * anchor_from_world), draw.clip_from_anchor,
                                draw.anchor_ws_m, draw.size_px, store.light_at(draw.light)};
        gl::draw_into(device, draw.target, area(draw), [&] { (*engine)(view); });
    }
    return failure;
}

}  // namespace gnomon::embed
