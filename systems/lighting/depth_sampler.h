#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/gl/device.h"
#include "systems/extract/sampled_depths.h"
#include "systems/lighting/readback_ring.h"
#include "systems/retry.h"

namespace gnomon::lighting {

/// Counts the pixels of a picture by their view distance, on the GPU, and takes the counts when they have come: never
/// waiting, a few pictures under way at most, in each frame the newest. Makes what it needs when first asked.
class DepthSampler {
public:
    explicit DepthSampler(gl::Device& device)
        : device_(device), counts_(device, "view distances to read", sizeof(SampledDepths::pixels)) {}
    ~DepthSampler();
    DepthSampler(const DepthSampler&) = delete;
    DepthSampler& operator=(const DepthSampler&) = delete;

    struct Picture {
        ecs::Entity camera;
        gl::TextureHandle depth;
        gl::SamplerHandle sampler;
        gl::BufferHandle uniforms;  // begins with the CameraRecord
        glm::uvec2 size_px;
    };
    /// Records the counting of one picture, outside passes; nothing if all slots are under way or something failed.
    void record(const Picture& picture, gl::CommandList& list);

    /// Replaces `depths` by the newest counts that have come since the last call; without any it stays as it is.
    /// Tells of failures by depths.failed, until counts come again.
    void collect(SampledDepths& depths);

private:
    bool prepare();

    gl::Device& device_;
    gl::ProgramHandle program_{};
    gl::BufferHandle bins_{};
    ReadbackRing counts_;
    std::uint64_t frames_ = 0;
    Retry retry_;
    bool failed_ = false;
};

}  // namespace gnomon::lighting
