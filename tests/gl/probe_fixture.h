#pragma once
#include <epoxy/gl.h>

#include <span>
#include <string>
#include <vector>

#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"
#include "tests/gl/device_fixture.h"

namespace gnomon {

/// Probes what shaders read or compute: a compute program, with the project's includes, writes it where C++ reads it.
class ProbeTest : public DeviceTest {
protected:
    /// Storage buffer that a probe writes.
    static constexpr std::uint32_t kOutBinding = 1;

    /// Returns `count` values that `groups` work groups of the shader `text` leave, after the commands in `bound`.
    template <class T>
    std::vector<T> probed(const std::string& text, std::uint32_t groups, std::size_t count, gl::CommandList bound) {
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        files.push_back({"probe.comp", text});
        const auto expanded = gl::expand_shader(files, "probe.comp", {});
        EXPECT_TRUE(expanded);
        if (!expanded) return {};
        const std::uint64_t bytes = count * sizeof(T);
        const auto program = keep(device().create_program({.label = "probe", .compute = expanded.value()}));
        const auto out = keep(device().create_buffer({.label = "out", .size = bytes}, {}));
        const auto back =
            keep(device().create_buffer({.label = "back", .size = bytes, .use = gl::BufferUse::read_back}, {}));
        bound.add(gl::BindStorage{kOutBinding, out});
        bound.add(gl::Dispatch{program, groups, 1});
        bound.add(gl::CopyBuffer{out, back});
        run(bound);
        std::vector<T> found(count);
        glFinish();
        EXPECT_EQ(device().read_buffer(back, std::as_writable_bytes(std::span(found))), gl::Readback::done);
        return found;
    }

    /// Makes a buffer of records that shaders read as texels. Lists may write to it.
    template <class T>
    gl::BufferHandle texels_of(const std::vector<T>& records) {
        return keep(device().create_buffer(
            {.label = "texels", .size = records.size() * sizeof(T), .use = gl::BufferUse::updated, .texels = true},
            std::as_bytes(std::span(records))));
    }
};

}  // namespace gnomon
