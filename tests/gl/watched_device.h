#pragma once
#include <functional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/gl/device.h"
#include "tests/gl/gl_state_record.h"

namespace gnomon {

/// A device that records the context's state around every call of another one, and reports what differs.
class WatchedDevice final : public gl::Device {
public:
    /// Called with the name of the device's function and a difference.
    using Report = std::function<void(const std::string& function, const std::string& difference)>;
    WatchedDevice(gl::Device& device, Report report) : device_(device), report_(std::move(report)) {}

    /// Returns the names of the functions that were called.
    const std::set<std::string>& called() const { return called_; }

    /// Runs a call of another function of the device, and watches it.
    template <class Call>
    std::invoke_result_t<Call> watch(const char* function, Call call) {
        called_.insert(function);
        const GlStateRecord before = record_gl_state();
        auto result = call();
        for (const std::string& difference : differences(before, record_gl_state())) report_(function, difference);
        return result;
    }

    const gl::DeviceInfo& info() const override { return device_.info(); }
    std::uint64_t compiled_programs() const override { return device_.compiled_programs(); }
    gl::Created<gl::TextureHandle> create_texture(const gl::TextureDesc& desc,
                                                  std::span<const std::byte> pixels) override {
        return watch("create_texture", [&] { return device_.create_texture(desc, pixels); });
    }
    gl::Created<gl::SamplerHandle> create_sampler(const gl::SamplerDesc& desc) override {
        return watch("create_sampler", [&] { return device_.create_sampler(desc); });
    }
    gl::Created<gl::BufferHandle> create_buffer(const gl::BufferDesc& desc, std::span<const std::byte> bytes) override {
        return watch("create_buffer", [&] { return device_.create_buffer(desc, bytes); });
    }
    gl::Created<gl::ProgramHandle> create_program(const gl::ProgramDesc& desc) override {
        return watch("create_program", [&] { return device_.create_program(desc); });
    }
    gl::Created<gl::TargetHandle> create_target(const gl::TargetDesc& desc) override {
        return watch("create_target", [&] { return device_.create_target(desc); });
    }
    void destroy(gl::TextureHandle handle) override { destroy_any("destroy texture", handle); }
    void destroy(gl::SamplerHandle handle) override { destroy_any("destroy sampler", handle); }
    void destroy(gl::BufferHandle handle) override { destroy_any("destroy buffer", handle); }
    void destroy(gl::ProgramHandle handle) override { destroy_any("destroy program", handle); }
    void destroy(gl::TargetHandle handle) override { destroy_any("destroy target", handle); }
    gl::SubmitResult submit(const gl::CommandList& list) override {
        return watch("submit", [&] { return device_.submit(list); });
    }
    bool read_texture(gl::TextureHandle texture, std::uint32_t layer, std::span<std::byte> out) override {
        return watch("read_texture", [&] { return device_.read_texture(texture, layer, out); });
    }
    gl::Readback read_buffer(gl::BufferHandle buffer, std::span<std::byte> out) override {
        return watch("read_buffer", [&] { return device_.read_buffer(buffer, out); });
    }
    void set_timing(gl::TimingMode mode) override {
        watch("set_timing", [&] { return device_.set_timing(mode), 0; });
    }
    std::vector<gl::Timing> take_timings() override {
        return watch("take_timings", [&] { return device_.take_timings(); });
    }
    void finish() override {
        watch("finish", [&] { return device_.finish(), 0; });
    }

private:
    template <class H>
    void destroy_any(const char* function, H handle) {
        watch(function, [&] { return device_.destroy(handle), 0; });
    }

    gl::Device& device_;
    Report report_;
    std::set<std::string> called_;
};

}  // namespace gnomon
