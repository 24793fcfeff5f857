#pragma once
#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"
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
    gl::SamplerHandle of(const MomentDemand& demand) const {
        for (const OfMoments& m : moments)
            if (m.mipmaps == (demand.levels > 1) && m.anisotropy == anisotropy(demand)) return m.sampler;
        return {};
    }
    static std::uint32_t anisotropy(const MomentDemand& demand) {
        return demand.sampler_anisotropy ? demand.anisotropy : 1;
    }
};

/// The consumer's camera as shaders see it.
CameraRecord camera_record(const ConsumerItem& consumer);

/// Stage 6: for each camera that draws, each light with its program row, record and textures. A light without a map is
/// published unshadowed. Fills frame.inputs.
/// Those that ask by rays get `rays`; `masked`: GpuScene::caster_masks() has something for those that read triangles.
void publish_lights(const SceneSnapshot& scene, const MapSamplers& samplers, const visibility::RayBuffers& rays,
                    bool masked, ShadowFrame& frame);

}  // namespace gnomon::shadow
