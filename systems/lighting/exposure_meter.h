#pragma once
#include <cstdint>
#include <optional>

#include "engine/gl/device.h"
#include "systems/lighting/readback_ring.h"
#include "systems/retry.h"

namespace gnomon::lighting {

/// Brings the automatic exposure of a picture back from the GPU, which works it out in the frame that needs it: never
/// waiting, so that it comes some frames late. Makes what it needs when first asked.
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
        std::uint32_t exposure_offset;  // of the ExposureRecord in it
    };
    /// Records the reading of one picture, outside passes; nothing if all slots are under way or something failed.
    void record(const Picture& picture, gl::CommandList& list);

    /// The exposure to reckon with: an upper bound of what the next picture of `camera` is multiplied by before the
    /// tone curve, by the newest reading of one of its pictures; in quarter stops, and the same for as long as it holds
    /// and is not far too large. Infinite while nothing is known.
    double bound(ecs::Entity camera);
    /// What is known is of the past: nobody has recorded since.
    void forget() { measured_.reset(); }

    /// By how much a picture may become darker, and its exposure greater, until the next reading comes, at most four
    /// frames: two stops. Whoever turns from the sun to the dark within a fifteenth of a second has the shadows of
    /// faint lights a fifteenth of a second later.
    static constexpr double kMostGrowth = 4.0;

private:
    bool prepare();

    gl::Device& device_;
    gl::ProgramHandle program_{};
    gl::BufferHandle scale_of_{};
    ReadbackRing scales_;
    ecs::Entity camera_ = {};
    std::optional<double> measured_;
    double held_ = 0.0;
    std::uint64_t frames_ = 0;
    Retry retry_;
};

}  // namespace gnomon::lighting
