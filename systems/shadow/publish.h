#pragma once
#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/types.h"

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

/// Pixels a light can reach in the consumer's picture: the whole viewport for a sun or an unlimited light, the bounding
/// rectangle of a ball around its range, a spot's around its cone, otherwise; empty if that is behind the camera or
/// beyond its far plane. Conservative.
gl::Rect screen_rectangle(const LightItem& light, const ConsumerItem& consumer);

/// Depth of the picture (reversed, in [0,1]) that all surfaces within the light's reach exceed; 0: any surface may be.
/// Conservative.
float farthest_depth(const LightItem& light, const ConsumerItem& consumer);

/// Stage 6: for each camera that draws, each light with its program row, record and textures. A light without a map is
/// published unshadowed. Fills frame.inputs.
/// Those that ask by rays get `rays`; `masked`: GpuScene::caster_masks() has something for those that read triangles.
void publish_lights(const SceneSnapshot& scene, const MapSamplers& samplers, const visibility::RayBuffers& rays,
                    bool masked, ShadowFrame& frame);

}  // namespace gnomon::shadow
