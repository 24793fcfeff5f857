#include <algorithm>

#include "bench/accuracy/accuracy.h"
#include "bench/accuracy/stated_accuracy.h"
#include "bench/common/units.h"
#include "bench/text/printf_string.h"

namespace gnomon::bench {
namespace {

constexpr double kBytesPerMb = 1.0e6;

void append_errors(const LightAccuracy& light, std::string& text) {
    if (is_left_out(light.report)) {
        text += formatted("%-18.18s left out, its shadow could not be seen: %s\n", light.report.name.c_str(),
                          reason_code(light.report.reason));
        return;
    }
    const oracle::Metrics& m = light.metrics;
    const auto percent = [&m](std::size_t pixels) { return kPercent * m.fraction(pixels); };
    const oracle::FarErrors& far = light.far;
    text += formatted("%-18.18s %8zu %8.4f %8.4f %8.4f %8.4f %8.4f %6zu %6zu %6zu %6zu %6zu %6zu\n",
                      light.report.name.c_str(), m.scored, percent(m.wrong), percent(m.false_shadow),
                      percent(m.false_light), percent(m.acne), percent(m.leak), far.false_shadow, far.false_light,
                      far.crease_shadow, far.crease_light, m.ambiguous, m.uncovered);
}

void append_edges(const LightAccuracy& light, std::string& text) {
    if (is_left_out(light.report)) return;
    const oracle::Metrics& m = light.metrics;
    text += formatted("%-16.16s %6.2f %6.2f %6.2f %5zu %6zu %9llu %6.1f", light.report.name.c_str(), m.edge.mean_px,
                      m.edge.p95_px, m.edge.max_px, m.edge.lost, m.coverage_mismatch,
                      static_cast<unsigned long long>(light.report.counts.texels),
                      static_cast<double>(light.report.counts.bytes) / kBytesPerMb);
    if (light.gpu_us.count == 0)
        text += formatted(" %19s", "not measured");
    else
        text += formatted(" %6.2f (%.2f-%.2f)", light.gpu_us.median / kUsPerMs, light.gpu_us.min / kUsPerMs,
                          light.gpu_us.max / kUsPerMs);
    const bool as_requested = light.report.reason == Reason::none;
    text += formatted("  %s\n", as_requested ? to_text(light.report.state) : reason_code(light.report.reason));
}

void append_resolved(const LightAccuracy& light, std::string& text) {
    if (!light.edges) return;
    const oracle::ResolvedEdges& edges = light.edges->resolved;
    const ResolvedWidth& width = light.report.resolved;
    text += formatted("%-18.18s %8zu %7.2f %8.2f %8.2f %8.2f %8.1f %9.2f %9.3g %8zu\n", light.report.name.c_str(),
                      edges.places, edges.p99_px, edges.p999_px, edges.max_px, light.report.predicted_error_px,
                      slack_of(light), width.px, width.m, edges.unresolved);
}

void append_soft(const Accuracy& accuracy, std::string& text) {
    const auto is_soft = [](const LightAccuracy& light) { return light.soft.has_value(); };
    if (std::none_of(accuracy.lights.begin(), accuracy.lights.end(), is_soft)) return;
    text += formatted("\n%-18s %8s %8s %8s %8s %8s %8s %8s %7s %6s %20s\n", "soft light", "source", "error%", "umbra",
                      "leak%", "lit", "loss%", "penumbra", "error%", "widths", "ratio (10-90 %)");
    for (const LightAccuracy& light : accuracy.lights) {
        if (!light.soft) continue;
        const oracle::SoftMetrics& m = light.soft->metrics;
        text +=
            formatted("%-18.18s %8.4f %8.4f %8zu %8.4f %8zu %8.4f %8zu %7.3f %6zu %6.3f (%5.3f-%5.3f)\n",
                      light.report.name.c_str(), light.soft->source, kPercent * m.mean_error, m.umbra,
                      kPercent * m.umbra_leak, m.lit, kPercent * m.lit_loss, m.penumbra, kPercent * m.penumbra_error,
                      m.widths.places, m.widths.median_ratio, m.widths.p10_ratio, m.widths.p90_ratio);
    }
}

void append_area(const Accuracy& accuracy, std::string& text) {
    const auto has_area = [](const LightAccuracy& light) { return light.area.has_value(); };
    if (std::none_of(accuracy.lights.begin(), accuracy.lights.end(), has_area)) return;
    text += formatted("\n%-18s %8s %8s %8s %8s %9s %9s %8s %8s\n", "edges by area", "crossed", "error", "bias", "p99",
                      "uncrossed", "error%", "partial", "error");
    for (const LightAccuracy& light : accuracy.lights) {
        if (!light.area) continue;
        const oracle::AreaMetrics& m = light.area->metrics;
        text += formatted("%-18.18s %8zu %8.4f %+8.4f %8.4f %9zu %9.5f %8zu %8.4f\n", light.report.name.c_str(),
                          m.crossed, m.mean_error, m.bias, m.p99_error, m.uncrossed, kPercent * m.uncrossed_error,
                          m.partial, m.partial_error);
    }
    text +=
        "\ncrossed: pixels with an area of one surface that the light reaches in part. error: mean difference from "
        "that "
        "part;\n"
        "bias: its mean with its sign, above 0 too bright. uncrossed: pixels that it reaches wholly or not at all. "
        "partial:\n"
        "crossed pixels that show another surface, too.\n";
}

void append_what_is_shown(const LightAccuracy& light, std::string& text) {
    if (!shows_areas(light)) return;
    text += light.report.name +
            ": antialiased: 'edges by area' judges it, the tables before compare it with pixels' middles.\n";
}

void append_tint(const Accuracy& accuracy, std::string& text) {
    const auto has_tint = [](const LightAccuracy& light) { return light.tint.has_value(); };
    if (std::none_of(accuracy.lights.begin(), accuracy.lights.end(), has_tint)) return;
    text += formatted("\n%-18s %8s %8s %8s %8s %8s %8s\n", "through glass", "pixels", "tinted", "error%", "tinted%",
                      "most%", "beyond");
    for (const LightAccuracy& light : accuracy.lights) {
        if (!light.tint) continue;
        const oracle::TintMetrics& m = light.tint->metrics;
        text += formatted("%-18.18s %8zu %8zu %8.4f %8.4f %8.3f %8zu\n", light.report.name.c_str(), m.scored, m.tinted,
                          kPercent * m.mean_error, kPercent * m.tinted_error, kPercent * m.max_error, m.beyond);
    }
}

void append_air(const Accuracy& accuracy, std::string& text) {
    const auto has_air = [](const LightAccuracy& light) { return light.air.has_value(); };
    if (std::none_of(accuracy.lights.begin(), accuracy.lights.end(), has_air)) return;
    text += formatted("\n%-18s %8s %8s %8s %8s %8s\n", "in fog", "places", "dark", "wrong%", "ways", "error%");
    for (const LightAccuracy& light : accuracy.lights) {
        if (!light.air) continue;
        const AirAccuracy& air = *light.air;
        text += formatted("%-18.18s %8zu %8zu %8.4f %8zu %8.4f\n", light.report.name.c_str(), air.places, air.dark,
                          kPercent * air.fraction(air.wrong), air.ways, kPercent * air.way_error);
    }
}

}  // namespace

std::string accuracy_legend() {
    return "Columns of the table:\n"
           "  pixels    surfaces that the light reaches and that face it; every % is of them\n"
           "  wrong     shown on the other side of half lit than the truth: fshadow false shadow, flight false light\n"
           "  acne      false shadow more than 2 px from any true edge; leak: false light there\n"
           "  fs, fl    pixels of false shadow and false light. far: farther than half a texel and the filter's "
           "half-width\n"
           "            from true edges and from creases of the surface; cr: near creases alone\n"
           "  ambig     left out: the truth depends on the last digits, or the picture shows another surface than the "
           "ray\n"
           "  uncov     no surface measured, counted as wrong; cover: the same over the whole picture\n"
           "  mean, p95, max  distance of shadow edges from the true ones, px; lost: places with no edge within 8 px\n"
           "  resolved  edges of casters, and of gaps between them, that rays find wide enough for the map's texels; "
           "narrower:\n"
           "            places left out. at most: bound on their distance that the report states, px; slack: that over "
           "p99,\n"
           "            or 0.25 px. from: width at the receiver from which on casters are resolved, as the report "
           "states it\n"
           "  ms        depth and lighting pass, every map redrawn\n"
           "Of lights with a size, against 256 rays to it: source is the radius in metres, or the tangent of a sun's;\n"
           "error the mean difference; leak the mean light where none of it is seen; loss the mean light missing where "
           "all\n"
           "is; widths the places where a penumbra is measured, ratio drawn by true width.\n"
           "Through glass, against what translucent casters let through: error the mean difference over all surfaces,\n"
           "tinted% where the truth is not white, most% the largest of a channel; beyond: pixels off by more than "
           "1/255.\n"
           "In fog, against a ray from each of 16 places along the view ray of every eighth pixel, both ways: places "
           "that\n"
           "the light may reach; dark by rays; ways are view rays with such places, error the mean difference between "
           "a\n"
           "way's mean visibilities. Shaders' own text looks up, compiled as C++.\n";
}

std::string accuracy_table(const Accuracy& accuracy) {
    std::string text;
    text += formatted("scene   %s\ndevice  %s\npicture %u x %u\n\n", accuracy.scene.c_str(), accuracy.device.c_str(),
                      accuracy.size_px.x, accuracy.size_px.y);
    text += formatted("%-18s %8s %8s %8s %8s %8s %8s %6s %6s %6s %6s %6s %6s\n", "errors of light", "pixels", "wrong%",
                      "fshadow%", "flight%", "acne%", "leak%", "fs far", "fl far", "fs cr", "fl cr", "ambig", "uncov");
    for (const LightAccuracy& light : accuracy.lights) append_errors(light, text);
    for (const std::string& name : accuracy.unshadowed) text += formatted("%-18.18s has no shadow\n", name.c_str());
    text += formatted("\n%-16s %6s %6s %6s %5s %6s %9s %6s %19s  %s\n", "edges and cost", "mean", "p95", "max", "lost",
                      "cover", "texels", "MB", "ms (least-most)", "state");
    for (const LightAccuracy& light : accuracy.lights) append_edges(light, text);
    text += formatted("\n%-18s %8s %7s %8s %8s %8s %8s %9s %9s %8s\n", "resolved edges", "places", "p99", "p99.9",
                      "max", "at most", "slack", "from px", "from m", "narrower");
    for (const LightAccuracy& light : accuracy.lights) append_resolved(light, text);
    append_soft(accuracy, text);
    append_area(accuracy, text);
    append_tint(accuracy, text);
    append_air(accuracy, text);
    for (const LightAccuracy& light : accuracy.lights) append_what_is_shown(light, text);
    for (const LightAccuracy& light : accuracy.lights)
        if (light.edges && light.edges->exceptions.beyond() > 0 && !shows_areas(light)) {
            const oracle::EdgeExceptions& e = light.edges->exceptions;
            text += formatted(
                "%s: %zu of %zu places on edges are farther off than is predicted there: sub_texel_caster %zu, "
                "truth_ambiguous %zu, unexplained %zu.\n",
                light.report.name.c_str(), e.beyond(), light.metrics.edge.places, e.sub_texel_caster, e.truth_ambiguous,
                e.unexplained);
        }
    for (const LightAccuracy& light : accuracy.lights)
        if (const std::string broken = broken_words(light); !broken.empty())
            text += light.report.name + ": NOT AS STATED: " + broken + ".\n";
    for (const LightAccuracy& light : accuracy.lights)
        if (const std::string above = light.judged ? missed_limits(*light.judged) : ""; !above.empty())
            text += light.report.name + ": above what defaults are to keep: " + above +
                    ". What reaching it takes: --sweep full.\n";
    for (const LightAccuracy& light : accuracy.lights)
        if (!is_left_out(light.report))
            text +=
                light.other_surface
                    ? formatted(
                          "%s: %zu pixels show another surface than their ray meets (gnomon bench audit lists them).\n",
                          light.report.name.c_str(), *light.other_surface)
                    : formatted("%s: this device does not tell which triangle a pixel shows.\n",
                                light.report.name.c_str());
    for (const LightAccuracy& light : accuracy.lights)
        if (light.redrawn_differs > 0)
            text += formatted("%s: %zu pixels changed when every map was redrawn.\n", light.report.name.c_str(),
                              light.redrawn_differs);
    text += "\nWhat the columns mean: bench accuracy --help\n";
    if (accuracy.gl_complaints > 0) text += formatted("OpenGL complained %u times.\n", accuracy.gl_complaints);
    return text;
}

}  // namespace gnomon::bench
