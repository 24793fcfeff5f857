#include "bench/check/check_programs.h"

#include <atomic>
#include <chrono>
#include <map>
#include <set>
#include <thread>

#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"
#include "tests/gl/program_sources.h"

namespace gnomon::bench {
namespace {

constexpr std::string_view kVertexLayer = "#define LAYER_BY_VERTEX 1";

void add(std::vector<gl::ProgramDesc>& programs, const std::string& label, const std::string& vertex_file,
         const std::string& fragment_file, const std::vector<std::string>& defines, bool layer_by_geometry = false) {
    const auto vertex = gl::expand_shader(shader_files(), vertex_file, defines);
    const auto fragment = gl::expand_shader(shader_files(), fragment_file, defines);
    const auto layer = gl::expand_shader(shader_files(), "shadow/passes/depth/layer.geom", defines);
    const bool whole = vertex && fragment && layer;
    programs.push_back({label, whole ? vertex.value() : "", whole ? fragment.value() : "",
                        whole && layer_by_geometry ? layer.value() : ""});
}

/// Adds programs of cubes drawn in one pass, with masked casters and maps of triangles.
void add_layered(std::vector<gl::ProgramDesc>& programs) {
    for (const bool by_geometry : {false, true})
        for (const bool masked : {false, true})
            for (const bool triangles : {false, true}) {
                std::vector<std::string> defines;
                if (masked) defines.emplace_back("MASKED 1");
                if (triangles) defines.emplace_back("TRIANGLES 1");
                defines.emplace_back("LAYERED 1");
                if (!by_geometry) defines.emplace_back("LAYER_BY_VERTEX 1");
                add(programs,
                    std::string(masked ? "depth masked" : "depth opaque") + (triangles ? ", triangles" : "") +
                        (by_geometry ? ", layer by geometry" : ", layer by vertex"),
                    "shadow/passes/depth/depth.vert", "shadow/passes/depth/depth.frag", defines, by_geometry);
            }
}

/// Adds the second depth pass of exact maps, and the passes that bound where
/// surfaces end in their texels.
void add_sheets(std::vector<gl::ProgramDesc>& programs) {
    add(programs, "depth opaque, peeled", "shadow/passes/depth/depth.vert", "shadow/passes/depth/depth_peel.frag",
        {"TRIANGLES 1"});
    for (const bool points : {false, true}) {
        const std::vector<std::string> small(points ? 1 : 0, "AS_POINTS 1");
        std::vector<std::string> masked = small;
        masked.insert(masked.begin(), "MASKED 1");
        const std::string suffix = points ? ", small" : "";
        add(programs, "sheet departures" + suffix, "shadow/passes/bounds/depth_range.vert",
            "shadow/passes/bounds/depth_range.frag", small);
        add(programs, "sheet masks" + suffix, "shadow/passes/bounds/depth_range.vert",
            "shadow/passes/bounds/depth_range.frag", masked);
        add(programs, "sheet contours" + suffix, "shadow/passes/bounds/silhouettes.vert",
            "shadow/passes/bounds/silhouettes.frag", small);
    }
}

struct Outcome {
    bool not_here = false;
    gl::Failure failure = gl::Failure::none;
    std::string log;
};

/// Takes the next program until none is left; threads share `next`, and write
/// an outcome each of their own.
void compile_in_turn(gl::Device& device, std::span<const gl::ProgramDesc> programs, std::atomic<std::size_t>& next,
                     std::span<Outcome> outcomes, const CheckProgress& progress) {
    for (std::size_t i = next++; i < programs.size(); i = next++) {
        if (progress) progress("programs", i, programs.size());
        Outcome& outcome = outcomes[i];
        outcome.not_here = is_not_here(programs[i], device.info());
        if (outcome.not_here) continue;
        auto made = device.create_program(programs[i]);
        outcome.failure = made.failure;
        outcome.log = gl::with_paths(made.log, shader_files());
        device.destroy(made.handle);
    }
}

}  // namespace

std::vector<gl::ProgramDesc> check_programs() {
    std::vector<gl::ProgramDesc> programs = all_programs();
    add_layered(programs);
    add_sheets(programs);
    for (gl::ProgramDesc& program : programs_of_rows()) programs.push_back(std::move(program));
    std::set<std::string> sources;
    std::erase_if(programs, [&](const gl::ProgramDesc& p) {
        const std::string source = p.vertex + p.geometry + p.fragment + p.compute;
        return !source.empty() && !sources.insert(source).second;
    });
    std::map<std::string, int> same;
    for (gl::ProgramDesc& program : programs)
        if (const int earlier = same[program.label]++; earlier > 0) program.label += " #" + std::to_string(earlier + 1);
    return programs;
}

bool is_not_here(const gl::ProgramDesc& program, const gl::DeviceInfo& info) {
    return !info.vertex_layer && program.vertex.find(kVertexLayer) != std::string::npos;
}

ProgramChecks compile_programs(gl::Device& device, std::span<const gl::ProgramDesc> programs,
                               const CheckProgress& progress, unsigned others, const OtherDevice& other) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<Outcome> outcomes(programs.size());
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    const auto work = [&](gl::Device& on) { compile_in_turn(on, programs, next, outcomes, {}); };
    for (unsigned i = 0; i < others; ++i) threads.emplace_back([&] { other(work); });
    compile_in_turn(device, programs, next, outcomes, progress);
    for (std::thread& thread : threads) thread.join();
    ProgramChecks checks;
    checks.all = programs.size();
    for (std::size_t i = 0; i < programs.size(); ++i) {
        if (outcomes[i].not_here)
            checks.not_here.push_back(programs[i].label);
        else if (outcomes[i].failure == gl::Failure::none)
            ++checks.compiled;
        else
            checks.failed.push_back(
                {programs[i].label, std::string(gl::to_text(outcomes[i].failure)) + "\n" + outcomes[i].log});
    }
    checks.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return checks;
}

}  // namespace gnomon::bench
