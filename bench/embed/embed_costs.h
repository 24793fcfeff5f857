#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "bench/common/timed_blocks.h"

namespace gnomon::bench {

/// What is timed. Still ones keep their maps; in moving ones every light moves, so that every map is drawn.
enum class EmbedWay : std::uint8_t {
    passes_without,  // light passes of gnomon::Frame, no shadows
    passes,          // the same with shadows
    mask,            // gnomon::Shadows::render()
    shader_without,  // an engine's shader of all lights, no shadows
    lookup,          // the same, which looks all lights up; its text has what these lights need
    lookup_all,      // the same; its text has all kinds of lights and the usual filters
    moving_frame,    // whole frame of gnomon::Frame
    moving_mask,     // an engine's frame: surfaces, render(), a shader that reads the mask
    moving_lookup,   // an engine's frame: surfaces, render() without a mask, a shader that looks up
    count
};
inline constexpr std::size_t kEmbedWays = static_cast<std::size_t>(EmbedWay::count);

/// One way's name in the file, what it is compared with (count: nothing), and words for people.
struct EmbedWayInfo {
    const char* key;
    EmbedWay base;
    const char* words;
};
const EmbedWayInfo& info_of(EmbedWay way);

struct EmbedOptions {
    std::vector<std::uint32_t> lights{1, 2, 4, 8};
    std::uint32_t rounds = 5, frames = 5;
    bool quick = false;                 // fewer lights, filters and rounds
    std::string only;                   // part of a case's name, as "spots default"; empty: all
    std::vector<std::string> settings;  // KEY=VALUE of every light; a case's own filter stays
    bool whole_text = true;             // measure lookup_all: its text takes long to compile
};

/// Lights of one kind and filter.
struct EmbedRow {
    std::string kind, filter;  // filter: as it was set
    std::uint32_t lights = 0;
    std::string used_filter;  // which its maps are read with
    std::uint32_t maps = 0;   // all lights' together
    double shadowed = 0.0;    // share of the surfaces that lose light to shadows
    double differs = 0.0;     // share of them on which mask and lookup differ by more than rounding
    struct Times {
        TimedFrames device;  // its ratios: per round, to EmbedWayInfo::base
        Spread call_us;
    };
    std::array<Times, kEmbedWays> ways;
    const Times& of(EmbedWay way) const { return ways[static_cast<std::size_t>(way)]; }
};

struct EmbedCosts {
    std::string scene, device, method;
    bool is_software = false;
    glm::uvec2 size_px{0, 0};
    std::uint32_t starved = 0;          // calls during which the device may have been idle
    double whole_text_compile_s = 0.0;  // time to compile the shader of lookup_all; 0: it was not
    std::vector<EmbedRow> rows;
};

/// Measures Gnomon's own light passes, masks and lookups of the same lights, cameras and surfaces in one run. The
/// lights are its own: the scene's are switched off. Errors: those of
/// gnomon::Shadows; "set.*", "bench.program", "bench.only" (no such case).
Result<EmbedCosts> measure_embed(Stage& stage, const EmbedOptions& options);

/// Returns what the ways are, a line each.
std::string embed_legend();
std::string embed_table(const EmbedCosts& costs);
std::string embed_json(const EmbedCosts& costs);

}  // namespace gnomon::bench
