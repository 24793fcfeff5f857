#pragma once
#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/gl/device_recording.h"
#include "systems/frame_timers.h"

namespace gnomon {

/// A recording device with timers that report how long a GPU of known speeds would take: the clock of tests. It also
/// records the most bytes that maps had between any two calls.
class TimedDevice final : public gl::Device {
public:
    /// Nanoseconds of the true GPU, known to this device alone.
    struct Speeds {
        double pass = 5000.0, draw = 1000.0, triangle = 1.0, texel = 0.02, shaded_pixel = 0.5;
        double plain_pixel = 0.1, filtered_pixel = 0.75;  // looked up by one fetch, or by any other filter
        double left = 0.06;  // share of pixels that the first of a light's two draws leaves to the second
    };
    Speeds speeds;
    bool answers = true;                               // false: no timer ever comes
    std::size_t late = 0;                              // submissions after which timers come, as with drivers
    std::uint64_t capacity_bytes = ~std::uint64_t{0};  // most bytes of maps; more is refused

    gl::RecordingDevice recording;
    std::uint64_t most_map_bytes = 0;
    /// Microseconds of the last submission.
    double drawing_us = 0.0, lookup_us = 0.0;
    double shadow_us() const { return drawing_us + lookup_us; }

    const gl::DeviceInfo& info() const override { return recording.info(); }
    gl::Created<gl::TextureHandle> create_texture(const gl::TextureDesc& desc,
                                                  std::span<const std::byte> bytes) override {
        const bool is_map = desc.label.rfind("shadow map", 0) == 0;
        if (is_map && map_bytes() + gl::byte_size(desc) > capacity_bytes)
            return {{}, gl::Failure::out_of_memory, "no room"};
        auto made = recording.create_texture(desc, bytes);
        if (made && is_map) {
            maps_.push_back({made.handle, gl::byte_size(desc)});
            most_map_bytes = std::max(most_map_bytes, map_bytes());
        }
        return made;
    }
    gl::Created<gl::SamplerHandle> create_sampler(const gl::SamplerDesc& d) override {
        return recording.create_sampler(d);
    }
    gl::Created<gl::BufferHandle> create_buffer(const gl::BufferDesc& d, std::span<const std::byte> b) override {
        return recording.create_buffer(d, b);
    }
    gl::Created<gl::ProgramHandle> create_program(const gl::ProgramDesc& d) override {
        return recording.create_program(d);
    }
    gl::Created<gl::TargetHandle> create_target(const gl::TargetDesc& d) override { return recording.create_target(d); }
    void destroy(gl::TextureHandle h) override {
        std::erase_if(maps_, [&](const Map& map) { return map.texture == h; });
        recording.destroy(h);
    }
    void destroy(gl::SamplerHandle h) override { recording.destroy(h); }
    void destroy(gl::BufferHandle h) override { recording.destroy(h); }
    void destroy(gl::ProgramHandle h) override { recording.destroy(h); }
    void destroy(gl::TargetHandle h) override { recording.destroy(h); }
    gl::SubmitResult submit(const gl::CommandList& list) override {
        time(list);
        const gl::SubmitResult result = recording.submit(list);
        for (gl::Timing& timing : timings_) timing.submission = result.submission;
        answers_.push_back(timings_);
        recording.forget();
        return result;
    }
    bool read_texture(gl::TextureHandle t, std::uint32_t l, std::span<std::byte> out) override {
        return recording.read_texture(t, l, out);
    }
    gl::Readback read_buffer(gl::BufferHandle b, std::span<std::byte> out) override {
        return recording.read_buffer(b, out);
    }
    void set_timing(gl::TimingMode mode) override { recording.set_timing(mode); }
    std::vector<gl::Timing> take_timings() override {
        if (!answers || answers_.size() <= late) return {};
        const std::vector<gl::Timing> oldest = std::move(answers_.front());
        answers_.pop_front();
        return oldest;
    }
    void finish() override { recording.finish(); }
    std::uint64_t compiled_programs() const override { return recording.compiled_programs(); }

    std::uint64_t map_bytes() const {
        std::uint64_t sum = 0;
        for (const Map& map : maps_) sum += map.bytes;
        return sum;
    }

private:
    struct Map {
        gl::TextureHandle texture;
        std::uint64_t bytes;
    };

    bool is_decided(gl::ProgramHandle program) const {
        return program && recording.program(program)->label.starts_with("decided light ");
    }
    double lookup_ns(gl::ProgramHandle program) const {
        const std::string& label = recording.program(program)->label;
        if (label.find("filters/pcf/hard") != std::string::npos) return speeds.plain_pixel;
        return label.find("filters/") != std::string::npos ? speeds.filtered_pixel : 0.0;
    }
    void time(const gl::CommandList& list) {
        timings_.clear();
        drawing_us = lookup_us = 0.0;
        bool timed = false;
        gl::ProgramHandle program{};
        double pixels = 0.0, ns = 0.0, lookups_ns = 0.0;
        for (const gl::Command& command : list.commands) {
            if (const auto* begin = std::get_if<gl::BeginTimer>(&command)) {
                timed = begin->id < kSurfaceTimer;
                ns = lookups_ns = 0.0;
            } else if (const auto* end = std::get_if<gl::EndTimer>(&command); end && timed) {
                timed = false;
                timings_.push_back({end->id, 0, ns * 1.0e-3});
                (end->id % 2 == 0 ? drawing_us : lookup_us) += (end->id % 2 == 0 ? ns : lookups_ns) * 1.0e-3;
            }
            if (!timed) continue;
            if (const auto* pass = std::get_if<gl::BeginPass>(&command)) {
                program = {};
                pixels = static_cast<double>(pass->viewport.width) * pass->viewport.height;
                if (pass->clear_depth) ns += speeds.pass + pixels * speeds.texel;
            } else if (const auto* scissor = std::get_if<gl::SetScissor>(&command)) {
                pixels = static_cast<double>(scissor->rect.width) * scissor->rect.height;
            } else if (const auto* state = std::get_if<gl::SetPipeline>(&command)) {
                if (is_decided(program)) pixels *= speeds.left;
                program = state->state.program;
            } else if (std::holds_alternative<gl::DrawTriangle>(command)) {
                lookups_ns += pixels * lookup_ns(program);
                ns += pixels * (speeds.shaded_pixel + lookup_ns(program));
            }
            draws_.clear();
            gl::append_mesh_draws(list, command, draws_);
            for (const gl::DrawMeshes& draw : draws_)
                ns += speeds.draw + speeds.triangle * draw.index_count / 3 * draw.item_count;
        }
    }

    std::vector<Map> maps_;
    std::vector<gl::DrawMeshes> draws_;            // draws of one command
    std::vector<gl::Timing> timings_;              // times of the last submission
    std::deque<std::vector<gl::Timing>> answers_;  // not yet taken
};

}  // namespace gnomon
