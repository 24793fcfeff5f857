#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/accuracy/air_accuracy.h"
#include "bench/accuracy/default_limits.h"
#include "bench/common/median_range.h"
#include "bench/common/stage.h"
#include "gnomon/frame.h"
#include "gnomon/result.h"
#include "tests/oracle/area_truth.h"
#include "tests/oracle/edge_exceptions.h"
#include "tests/oracle/far_errors.h"
#include "tests/oracle/metrics.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/resolved_edges.h"
#include "tests/oracle/soft_metrics.h"
#include "tests/oracle/tint_truth.h"

namespace gnomon::bench {

/// Against the truth about a source with a size.
struct SoftAccuracy {
    double source = 0.0;  // metres; of a sun the tangent of its angular radius
    oracle::SoftTruth truth;
    oracle::SoftMetrics metrics;
};

/// Against the truth about the lit share of each pixel's area.
struct AreaAccuracy {
    oracle::AreaTruth truth;
    oracle::AreaMetrics metrics;
    bool shown = false;  // the light's filter shows these shares, and no edges of pixels' middles
};

/// Colours that translucent casters let through, against rays.
struct TintAccuracy {
    std::vector<glm::dvec3> truth;
    std::vector<glm::vec4> measured;
    oracle::TintMetrics metrics;
};

/// Against what the light states of its edges.
struct EdgeAccuracy {
    oracle::EdgeExceptions exceptions;  // edges farther off than predicted there, by name
    oracle::EdgeExceptions contract;    // edges farther off than max_error_px, where the report states it is met
    oracle::ResolvedEdges resolved;     // edges of what the map resolves, and how far off they are
    std::size_t needs_wider = 0;        // scored pixels with a texel that resolves only wider casters than is stated: 0
    std::size_t beyond_stated = 0;      // scored pixels with a larger bound than their view states for their slope: 0
};

struct LightAccuracy {
    LightReport report;  // report of the measured frame; is_left_out(): nothing below is counted
    oracle::Metrics metrics;
    std::vector<float> measured;               // visibility per pixel, as --visibility writes it
    oracle::LightTruth truth;                  // ambiguous as well where other_surfaces() are
    std::optional<std::size_t> other_surface;  // scored pixels that are left out for that alone; empty: not known
    oracle::FarErrors far;                     // wrong pixels that neither an edge nor the map's texels there explain
    std::optional<JudgedErrors> judged;  // errors that defaults are judged by; none if the filter shows shares: of the
                                         // source, or of pixels' areas
    std::optional<EdgeAccuracy> edges;  // empty: AccuracyOptions::with_edges is false
    std::optional<SoftAccuracy> soft;   // accuracy about a source with a size; empty: the light has none
    std::optional<AreaAccuracy> area;   // empty: the filter shows no such shares, and AccuracyOptions::area_side is 0
    std::optional<TintAccuracy> tint;   // empty: no translucent caster, or the light leaves them out
    std::optional<AirAccuracy> air;  // accuracy in fog; empty: there is none, or measure_air() cannot judge the light
    Spread gpu_us, cpu_us;              // shadow and lighting pass, economy off: every view drawn in every frame
    /// Pixels that changed when every view was drawn again; must be 0. Not counted for a mean of noise_rounds.
    std::size_t redrawn_differs = 0;
};

/// Returns whether the light's filter shows the lit shares of pixels' areas, so that they alone judge it.
inline bool shows_areas(const LightAccuracy& light) { return light.area && light.area->shown; }

struct Accuracy {
    std::string scene, device;
    glm::uvec2 size_px{0, 0};
    glm::dvec3 camera_ws_m{0.0};
    std::vector<LightAccuracy> lights;    // lights with a LightShadow
    std::vector<std::string> unshadowed;  // names of the other lights
    double trace_s = 0.0;                 // tree, primary rays and all lights
    std::uint32_t gl_complaints = 0;
};

struct AccuracyOptions {
    std::uint32_t timed_frames = 9;  // 0: no timing
    bool with_edges = false;         // edges are judged, by a square of rays at each, which takes longer than all else
    // Places along the side of a pixel's area, oracle::AreaSampling; 0: its default for lights that show areas, others
    // none
    std::uint32_t area_side = 0;
    std::uint32_t noise_rounds =
        1;  // number of frames, each with noise of its own (FrameSettings::noise_frame); their mean is judged
    double telling = 1.0;            // factor on predicted texels, see EdgeBounds::at()
    double stating = 1.0;  // factor on the stated width of what is resolved; below 1 shows how a broken one looks
    double target_factor = 1.0;  // factor on max_error_px, see EdgeBounds::of_target()
};

/// Runs frames of the scene, reads each light's visibility and compares it with ray-traced truth about the very
/// snapshot that was drawn. Errors: "bench.visibility" if a light's visibility cannot be read, "bench.camera".
Result<Accuracy> measure_accuracy(Stage& stage, const AccuracyOptions& options);

/// Returns the meaning of the table's columns, for --help.
std::string accuracy_legend();
/// Returns a table for people.
std::string accuracy_table(const Accuracy& accuracy);
/// Returns all results for scripts: bench/README.md lists the keys.
std::string accuracy_json(const Accuracy& accuracy);

}  // namespace gnomon::bench
