#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "engine/gl/device_recording.h"

namespace gnomon {

/// One pass of a list, and the innermost group it lies in.
struct Pass {
    std::string group;
    gl::BeginPass begin;
    bool is_depth = false;                    // its target has no colours but triangles
    std::vector<gl::PipelineState> pipelines; // as set, in order
    std::vector<gl::DrawMeshes> draws;        // in order, whatever command makes them
    std::vector<std::size_t> draws_by_command;  // number of draws of each command that draws meshes
};

inline std::vector<Pass> passes_of(const gl::CommandList& list, const gl::RecordingDevice& device) {
    std::vector<Pass> passes;
    std::vector<std::string> groups;
    for (const gl::Command& command : list.commands) {
        if (const auto* g = std::get_if<gl::BeginGroup>(&command)) groups.emplace_back(g->label.text());
        if (std::get_if<gl::EndGroup>(&command) && !groups.empty()) groups.pop_back();
        if (const auto* b = std::get_if<gl::BeginPass>(&command)) {
            const gl::TargetDesc* target = device.target(b->target);
            const auto is_triangles = [&](const gl::Attachment& colour) {
                return device.texture(colour.texture)->label.ends_with(", triangles");
            };
            const bool is_depth = target && std::all_of(target->colours.begin(), target->colours.end(), is_triangles);
            passes.push_back({groups.empty() ? "" : groups.back(), *b, is_depth, {}, {}, {}});
        }
        if (const auto* p = std::get_if<gl::SetPipeline>(&command); p && !passes.empty()) passes.back().pipelines.push_back(p->state);
        if (passes.empty()) continue;
        const std::size_t before = passes.back().draws.size();
        gl::append_mesh_draws(list, command, passes.back().draws);
        if (const std::size_t added = passes.back().draws.size() - before; added > 0)
            passes.back().draws_by_command.push_back(added);
    }
    return passes;
}

inline std::vector<Pass> depth_passes_of(const gl::CommandList& list, const gl::RecordingDevice& device) {
    std::vector<Pass> passes = passes_of(list, device);
    std::erase_if(passes, [](const Pass& p) { return !p.is_depth; });
    return passes;
}

/// Labels of all programs that were made, in order.
inline std::vector<std::string> compiled_labels(const gl::RecordingDevice& device) {
    std::vector<std::string> labels;
    for (const gl::ResourceCall& call : device.resource_calls())
        if (call.kind == gl::ResourceCall::Kind::create_program) labels.push_back(call.label);
    return labels;
}

/// Labels of living textures that hold shadow maps, sorted.
inline std::vector<std::string> map_labels(const gl::RecordingDevice& device, const std::string& kind = "shadow map") {
    std::vector<std::string> labels = device.live_labels();
    std::erase_if(labels, [&](const std::string& label) { return label.rfind(kind, 0) != 0; });
    return labels;
}

}  // namespace gnomon
