#pragma once
#include <cstdint>
#include <optional>

#include "engine/gl/device.h"
#include "systems/lighting/readback_ring.h"
#include "systems/retry.h"

namespace gnomon::lighting {

/// Reads a picture's automatic exposure back from the GPU, some frames late, without blocking. Makes its objects on
/// first use.
class ExposureMeter {
public:
    explicit ExposureMeter(gl::Device& device) : device_(device), scales_(device, "exposure to read", sizeof(float)) {}
    ~ExposureMeter();
    ExposureMeter(const ExposureMeter&) = delete;
    ExposureMeter& operator=(const ExposureMeter&) = delete;

    struct Picture {
        ecs::Entity camera;
        gl::TextureHandle luminance;  // with its mips, as the tone curve reads it
        gl::SamplerHandle sampler;
        gl::BufferHandle uniforms;
        std::uint32_t exposure_offset;  // offset of the ExposureRecord in `uniforms`
    };
    /// Records the reading of one picture, outside passes. Does nothing if all slots are in flight or something failed.
    void record(const Picture& picture, gl::CommandList& list);

    /// Returns an upper bound of the factor of `camera`'s next picture before the tone curve, from its newest reading.
    /// Rounded to quarter stops, and unchanged while valid and at most twice too large. Infinite if unknown.
    double bound(ecs::Entity camera);
    /// Discards readings that are outdated, because no picture was recorded since.
    void forget() { measured_.reset(); }

    /// Maximum growth of the exposure until the next reading, at most four frames: two stops. A faster change, from the
    /// sun to the dark within 1/15 s, shows faint lights' shadows 1/15 s late.
    static constexpr double kMostGrowth = 4.0;

private:
    bool prepare();

    gl::Device& device_;
    gl::ProgramHandle program_{};
    gl::BufferHandle scale_of_{};
    ReadbackRing scales_;
    ecs::Entity camera_ = {};
    std::optional<double> measured_;
    double last_ = 0.0;
    std::uint64_t frames_ = 0;
    Retry retry_;
};

}  // namespace gnomon::lighting
