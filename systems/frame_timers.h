#pragma once
#include <cstddef>
#include <cstdint>

namespace gnomon {

/// Returns timer ids in a frame's commands: for a light's maps and lighting pass. Constants: the rest of the picture.
inline std::uint32_t shadow_timer(std::uint32_t light) { return 2 * light; }
inline std::uint32_t lighting_timer(std::uint32_t light) { return 2 * light + 1; }
inline constexpr std::uint32_t kSurfaceTimer = 0xfffffff0u, kFinishTimer = 0xfffffff1u;
inline constexpr std::uint32_t kDepthTimer = 0xfffffff2u;  // counting of view distances

/// Submissions that are remembered until their timers' results arrive: more than drivers queue.
inline constexpr std::size_t kTimedSubmissions = 8;

}  // namespace gnomon
