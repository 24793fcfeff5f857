#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/gl/device.h"
#include "systems/extract/sampled_depths.h"
#include "systems/lighting/readback_ring.h"
#include "systems/retry.h"

namespace gnomon::lighting {

/// Counts a picture's pixels by view distance on the GPU and reads the counts back. Never blocks: a few pictures are in
/// flight, and the newest counts are used. Makes its objects on first use.
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
        gl::BufferHandle uniforms;  // starts with the CameraRecord
        glm::uvec2 size_px;
    };
    /// Records the counting of one picture, outside passes. Does nothing if all slots are in flight or something
    /// failed.
    void record(const Picture& picture, gl::CommandList& list);

    /// Replaces `depths` by the newest counts since the last call, if any. Sets depths.failed from a failure until the
    /// next counts.
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
