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

/// One per way of reading a map that the filter table names (MapReading); those that nobody asked for are {0}.
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

/// The consumer's camera as shaders see it.
CameraRecord camera_record(const ConsumerItem& consumer);

/// What is published, beside the scene.
struct PublishInputs {
    const DrawnViews& drawn;
    std::span<const glm::dvec3> lamps_ws_m;  // one per light (culling/lamp_offsets.h); empty: where the lights are
    std::span<const double> clearances_m;    // one per light (exact/near_light_clearance.h)
    const MapSamplers& samplers;
    const visibility::RayBuffers& rays;  // nodes {0}: no light can use rays
    bool masked = false;                 // GpuScene::caster_masks() has something for lights that read triangles
};

/// Stage 6: publishes, for each camera that draws, each light with its program row, record and textures. A light
/// without a map is published unshadowed.
void publish_lights(const SceneSnapshot& scene, const PublishInputs& in, std::vector<LightingInputs>& out,
                    std::span<double> cpu_us);

}  // namespace gnomon::shadow
