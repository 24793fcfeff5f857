#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/lighting_inputs.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {

/// One sampler per way of reading a map in the filter table (MapReading); {0}: no light needs it.
struct MapSamplers {
    gl::SamplerHandle nearest{}, linear{}, depths{};
    struct OfMoments {
        bool mipmaps;
        std::uint32_t anisotropy;
        gl::SamplerHandle sampler;
    };
    std::vector<OfMoments> moments;

    gl::SamplerHandle of(MapReading reading) const {
        if (reading == MapReading::depths) return depths;
        return reading == MapReading::compare_linear ? linear : nearest;
    }
    gl::SamplerHandle of(const PrefilterSettings& request) const {
        for (const OfMoments& m : moments)
            if (m.mipmaps == (request.levels > 1) && m.anisotropy == anisotropy(request)) return m.sampler;
        return {};
    }
    static std::uint32_t anisotropy(const PrefilterSettings& request) {
        return request.sampler_anisotropy ? request.anisotropy : 1;
    }
};

/// Returns the record of a camera for shaders.
CameraRecord camera_record(const ConsumerItem& consumer);

/// Inputs of publication, beside the scene.
struct PublishInputs {
    const DrawnViews& drawn;
    std::span<const glm::dvec3> lamps_ws_m;  // one per light (culling/lamp_offsets.h); empty: the lights' own positions
    std::span<const double> clearances_m;    // one per light (exact/near_light_clearance.h)
    const MapSamplers& samplers;
    const visibility::RayBuffers& rays;  // nodes {0}: no light can use rays
    bool masked = false;                 // GpuScene::caster_masks() has masks for lights that read triangles
    std::span<const TintAssignment> tints = {};    // one per view; empty: no light has translucent casters in its maps
    std::span<const std::uint8_t> ray_tints = {};  // ShadowFrame::ray_tints
    gl::BufferHandle tint_tree = {};               // for these lights
    std::span<const LitArea> lit_areas = {};       // ReceiverCasterSets::lit_areas; empty: by range alone
};

/// Publishes, for each camera that draws, each light with its program row, record and textures (stage 6). A light
/// without a map is published unshadowed.
void publish_lights(const SceneSnapshot& scene, const PublishInputs& in, std::vector<LightingInputs>& out,
                    std::span<double> cpu_us);

}  // namespace gnomon::shadow
