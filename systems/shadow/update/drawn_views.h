#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "systems/shadow/frame/types.h"

/// Which views of a frame are drawn, and of which casters.
namespace gnomon::shadow {

/// Room for the uniforms of all faces of a cube, by face.
inline constexpr std::size_t kFaces = 6;
/// Of DrawItem::place, for the layer.
inline constexpr std::uint32_t kLayerBits = 3;

inline bool is_drawn(const ShadowFrame& frame, std::size_t view) {
    return frame.slots[view].target && !frame.slots[view].reuse;
}

inline std::span<const std::uint32_t> still_casters(const ShadowFrame& frame, const ShadowView& view) {
    return std::span(frame.view_caster_items).subspan(view.casters.first, view.still_casters);
}

inline std::span<const std::uint32_t> moving_casters(const ShadowFrame& frame, const ShadowView& view) {
    return std::span(frame.view_caster_items)
        .subspan(view.casters.first + view.still_casters, view.casters.count - view.still_casters);
}

}  // namespace gnomon::shadow
