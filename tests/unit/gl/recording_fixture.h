#pragma once
#include <gmock/gmock.h>

#include <array>

#include "engine/gl/device_recording.h"

namespace gnomon::gl {

/// A recording device with one of everything: a 64×32 target of colour and depth, a program, meshes and uniforms.
class RecordingTest : public ::testing::Test {
protected:
    RecordingTest() {
        colour = device.create_texture({.label = "colour", .width = 64, .height = 32}, {}).handle;
        depth = device.create_texture({.label = "depth", .format = Format::d32f, .width = 64, .height = 32}, {}).handle;
        other = device.create_texture({.label = "other", .width = 64, .height = 32}, {}).handle;
        target = device.create_target({.label = "target", .colours = {{colour}}, .depth = {depth}}).handle;
        sampler = device.create_sampler({.label = "sampler"}).handle;
        program = device.create_program({"program", "void main() {}", "void main() {}"}).handle;
        vertices = device.create_buffer({.label = "vertices", .size = 4 * 32}, {}).handle;
        const std::array<std::uint32_t, 6> values = {0, 1, 2, 2, 1, 3};
        indices = device
                      .create_buffer({.label = "indices", .size = sizeof values, .use = BufferUse::fixed},
                                     std::as_bytes(std::span{values}))
                      .handle;
        items = device.create_buffer({.label = "items", .size = 2 * 8}, {}).handle;
        uniforms = device.create_buffer({.label = "uniforms", .size = 512}, {}).handle;
    }

    BufferHandle read_back(std::uint64_t size) {
        return device.create_buffer({.label = "back", .size = size, .use = BufferUse::read_back}, {}).handle;
    }
    void begin(CommandList& list) const { list.add(BeginPass{.target = target, .viewport = {0, 0, 64, 32}}); }
    void pipeline(CommandList& list) const { list.add(SetPipeline{{.program = program}}); }
    void meshes(CommandList& list) const { list.add(BindMeshes{vertices, indices, items}); }

    /// Returns what the device finds wrong with the list, without earlier findings.
    std::vector<Misuse> misuses_of(const CommandList& list) {
        device.forget();
        device.submit(list);
        return found();
    }
    std::vector<Misuse> found() const {
        std::vector<Misuse> misuses;
        for (const Finding& finding : device.findings()) misuses.push_back(finding.misuse);
        return misuses;
    }

    RecordingDevice device;
    TextureHandle colour, depth, other;
    TargetHandle target;
    SamplerHandle sampler;
    ProgramHandle program;
    BufferHandle vertices, indices, items, uniforms;
};

}  // namespace gnomon::gl
