#pragma once
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "engine/gl/commands.h"
#include "gnomon/frame.h"
#include "gnomon/light.h"
#include "systems/shadow/frame/lit_area.h"
#include "systems/shadow/frame/shader_key.h"
#include "systems/shadow/frame/tint_assignment.h"
#include "systems/shadow/frame/view_limits.h"
#include "systems/visibility/ray_records.h"

namespace gnomon::shadow {

/// Matches ViewRecord in shaders/shadow/lookup/light_block.glsl (std140).
struct ViewRecord {
    glm::mat4 map_from_anchor{1.0f};
    glm::vec4 axis_u{0.0f}, axis_v{0.0f}, axis_back{0.0f};
    glm::vec4 numeric{0.0f};
    glm::vec4 anchor_from_camera{0.0f};
    bool operator==(const ViewRecord&) const = default;
};
static_assert(sizeof(ViewRecord) == 144);

/// Matches LightBlock in shaders/shadow/lookup/light_block.glsl (std140).
struct LightRecord {
    glm::vec4 position{0.0f};
    glm::vec4 to_light{0.0f};
    glm::vec4 radiance{0.0f};
    glm::vec4 cone{0.0f};
    glm::ivec4 options{0};
    glm::vec4 bias{0.0f};
    glm::ivec4 filtering{0};
    glm::vec4 spread{0.0f};
    glm::ivec4 seed_cell{0};
    glm::vec4 seed_place{0.0f};
    glm::vec4 moments{0.0f}, moment_sampling{0.0f};
    glm::vec4 low{0.0f};
    ViewRecord views[kMaxViews];
};
static_assert(sizeof(LightRecord) == std::size_t{13} * 16 + kMaxViews * sizeof(ViewRecord));

/// Number of rounds of noise; the next one has the first one's pattern again. Round times step is then exact to 2^-14
/// in the shader's floats (noise_seed.glsl).
inline constexpr std::uint32_t kNoiseRounds = 1024;

/// Returns whether the light's lookup differs from round to round.
inline bool has_noise(const LightRecord& record) { return record.seed_cell.w >= 0; }

/// Returns the record for another round of noise. Round 0 is the record as it is published.
inline LightRecord in_round(LightRecord record, std::uint32_t round) {
    if (has_noise(record)) record.seed_cell.w = static_cast<int>(round % kNoiseRounds);
    return record;
}

/// Matches CameraBlock in shaders/common/camera_block.glsl (std140).
struct CameraRecord {
    glm::mat4 clip_from_anchor{1.0f};
    glm::vec4 anchor_high{0.0f}, anchor_low{0.0f};
    glm::vec4 right{0.0f}, up{0.0f}, back{0.0f};
    glm::vec4 unproject{0.0f};
    glm::vec4 lens{0.0f};
};
static_assert(sizeof(CameraRecord) == 176);

/// Accuracy of a lookup, for the light's report.
struct LookupAccuracy {
    ShadowFilter filter = ShadowFilter::automatic;  // automatic: there is nothing to look up
    double predicted_error_px = 0.0;                // largest over its views, pixels; 0: none shows an edge
    bool keeps_max_error = false;                   // it meets LightShadow::max_error_px
    ResolvedWidth resolved = {};                    // largest over its views
    bool operator==(const LookupAccuracy&) const = default;
};

/// Fallback while the light's own program is unavailable: one tap of the depth map, which every filter has.
struct FallbackLookup {
    ShaderKey row;  // no filter file: the light has no map
    gl::TextureHandle map{};
    gl::SamplerHandle sampler{};
    LookupAccuracy accuracy;
};

/// Struct 6. GPU-ready data of one light for one camera view, with the textures to bind.
struct LightingLight {
    std::uint32_t light = 0;  // index into SceneSnapshot::lights and FrameReport::lights
    ShaderKey row;
    gl::TextureHandle map{}, triangles{};  // triangles: {0} unless row.triangles
    gl::TextureHandle second{}, bounds{};  // {0} unless row.sheets
    gl::BufferHandle ends{};               // occluder pyramid; {0} unless the source has a size
    gl::SamplerHandle sampler{};
    visibility::RayBuffers rays{};  // {0} unless row.rays
    TintTextures tint;              // {0} without row.tint
    FallbackLookup plain;
    LitArea area;
    /// Hash of every input of the shadow lookup except pixel and camera (visibility_hash.h). Equal hashes mean equal
    /// visibility. 0: unknown, or visibility is not kept.
    std::uint64_t lookup_signature = 0;
    LightRecord record;
};

/// Lights of one camera view.
struct LightingInputs {
    std::uint32_t consumer = 0;
    CameraRecord camera;
    std::vector<LightingLight> lights;
};

/// A light that a picture shows otherwise than by its own row.
struct LookupFailure {
    std::uint32_t light = 0;  // index into SceneSnapshot::lights
    Reason reason = Reason::none;
    bool unshadowed = false;    // it is drawn without its shadow, or not at all; else by one tap of its map
    bool forward_only =
        false;  // on blended surfaces, shadow catchers or in fog; elsewhere its shadow is what it should be
    LookupAccuracy fallback;    // accuracy of that one tap
    bool operator==(const LookupFailure&) const = default;
};

/// A light with cached visibility in a picture.
struct CachedLookup {
    std::uint32_t light = 0;  // index into SceneSnapshot::lights
    std::uint64_t bytes = 0;
    bool reused = false;                  // the picture read it, and did not fill it
    std::optional<double> saved_us = {};  // saved time of lighting on the GPU; empty: never measured
};

/// What became of lights in the pictures of a frame. Lighting appends to it, picture by picture; the report is made
/// from it.
struct LightingOutcome {
    std::vector<LookupFailure> failures;
    std::vector<CachedLookup> cached;
    gl::Failure failure = gl::Failure::none;               // why a picture could not be recorded
    std::uint64_t ray_list_bytes = 0, position_bytes = 0;  // buffers for pixels that use rays
    void clear() {
        failures.clear();
        cached.clear();
        failure = gl::Failure::none;
        ray_list_bytes = position_bytes = 0;
    }
};

}  // namespace gnomon::shadow
