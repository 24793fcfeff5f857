#pragma once
#include <algorithm>

#include "engine/gl/device_recording.h"

namespace gnomon {

/// A device that keeps nothing, so that only the frame's own allocations are counted.
class SilentDevice final : public gl::Device {
public:
    const gl::DeviceInfo& info() const override { return inner_.info(); }
    std::uint64_t compiled_programs() const override { return inner_.compiled_programs(); }
    gl::Created<gl::TextureHandle> create_texture(const gl::TextureDesc& d, std::span<const std::byte> b) override { return inner_.create_texture(d, b); }
    gl::Created<gl::SamplerHandle> create_sampler(const gl::SamplerDesc& d) override { return inner_.create_sampler(d); }
    gl::Created<gl::BufferHandle> create_buffer(const gl::BufferDesc& d, std::span<const std::byte> b) override { return inner_.create_buffer(d, b); }
    gl::Created<gl::ProgramHandle> create_program(const gl::ProgramDesc& d) override { return inner_.create_program(d); }
    gl::Created<gl::TargetHandle> create_target(const gl::TargetDesc& d) override { return inner_.create_target(d); }
    void destroy(gl::TextureHandle h) override { inner_.destroy(h); }
    void destroy(gl::SamplerHandle h) override { inner_.destroy(h); }
    void destroy(gl::BufferHandle h) override { inner_.destroy(h); }
    void destroy(gl::ProgramHandle h) override { inner_.destroy(h); }
    void destroy(gl::TargetHandle h) override { inner_.destroy(h); }
    gl::SubmitResult submit(const gl::CommandList&) override { return {}; }
    bool read_texture(gl::TextureHandle, std::uint32_t, std::span<std::byte>) override { return false; }
    gl::Readback read_buffer(gl::BufferHandle, std::span<std::byte> out) override {
        std::fill(out.begin(), out.end(), std::byte{1});
        return gl::Readback::done;
    }
    void set_timing(gl::TimingMode) override {}
    std::vector<gl::Timing> take_timings() override { return {}; }
    void finish() override {}

private:
    gl::RecordingDevice inner_;
};

}  // namespace gnomon
