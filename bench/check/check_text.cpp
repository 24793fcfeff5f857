#include <cinttypes>
#include <sstream>

#include "bench/check/check.h"
#include "bench/text/printf_string.h"
#include "sample_game/support/settings/parse_number.h"

namespace gnomon::bench {
namespace {

constexpr std::size_t kLine = 120, kLogLines = 4, kFailuresShown = 10;

std::string cut(std::string line) {
    line = game::on_one_line(line);
    if (line.size() > kLine) line.replace(kLine - 3, std::string::npos, "...");
    return line + "\n";
}

std::string device_text(const DeviceCheck& device) {
    std::string text = "device\n";
    for (const auto& [name, value] :
         {std::pair("vendor  ", &device.facts.vendor), std::pair("renderer", &device.facts.renderer),
          std::pair("version ", &device.facts.version), std::pair("GLSL    ", &device.facts.glsl)})
        text += cut(std::string("  ") + name + "  " + *value);
    text += "limits\n";
    std::string line;
    for (const gl::DeviceLimit& limit : device.facts.limits) {
        const std::string part =
            formatted("  %-34s %12" PRId64 "%s", limit.name, limit.value, limit.serves() ? "  " : " !");
        line += part;
        if (line.size() + part.size() <= kLine) continue;
        text += cut(line);
        line.clear();
    }
    if (!line.empty()) text += cut(line);
    for (const std::string& short_of : device.short_of) text += cut("  ! " + short_of);
    text += "extensions\n";
    for (const gl::DeviceExtension& extension : device.facts.extensions)
        text +=
            cut(formatted("  %-36s %-7s (%s)", extension.name, extension.there ? "there" : "missing", extension.use));
    text += "what follows\n";
    for (const std::string& sentence : device.follow) text += cut("  " + sentence);
    return text;
}

std::string programs_text(const ProgramChecks& programs) {
    std::string text =
        cut(formatted("programs: %zu compiled and linked, %zu "
                      "failed, %zu not for this device, %.1f s",
                      programs.compiled, programs.failed.size(), programs.not_here.size(), programs.took_s));
    for (std::size_t i = 0; i < programs.failed.size() && i < kFailuresShown; ++i) {
        text += cut("  FAIL " + programs.failed[i].label);
        std::istringstream log(programs.failed[i].log);
        std::string line;
        for (std::size_t n = 0; n < kLogLines && std::getline(log, line); ++n)
            if (!line.empty()) text += cut("    " + line);
    }
    if (programs.failed.size() > kFailuresShown)
        text += formatted("  and %zu more, all of them in --json\n", programs.failed.size() - kFailuresShown);
    return text;
}

std::string time_words(const Spread& us) {
    if (us.count == 0) return "-";
    constexpr double kMs_us = 1000.0, kShownInMs_us = 10000.0;
    const double spread = us.median > 0.0 ? 50.0 * (us.max - us.min) / us.median : 0.0;
    return us.median < kShownInMs_us ? formatted("%.0f us +-%.0f%%", us.median, spread)
                                     : formatted("%.1f ms +-%.0f%%", us.median / kMs_us, spread);
}

std::string row_text(const CheckRow& row) {
    const CheckErrors& e = row.errors;
    std::string text = formatted("  %-39s", row.setup.name.c_str());
    if (row.verdict != CheckVerdict::not_judged)
        text += formatted(" %6zu %5zu %5zu %5zu %5zu  %-13s %-13s %s", e.scored, e.wrong, e.acne, e.leak, e.unexplained,
                          time_words(row.drawn_us).c_str(), time_words(row.kept_us).c_str(), to_text(row.verdict));
    else
        text += std::string(" ") + to_text(row.verdict) + ": " + row.why;
    text = cut(text);
    if (row.verdict == CheckVerdict::failed) text += cut("    " + row.why);
    return text;
}

std::string rows_text(const RowChecks& rows) {
    if (!rows.error.empty()) return cut("rows: none: " + rows.error);
    std::string text = cut(formatted("rows: %u x %u pixels against rays, %.1f s, of that %.1f s for the truth",
                                     rows.size_px.x, rows.size_px.y, rows.took_s, rows.trace_s));
    text += cut(formatted("  %-39s %6s %5s %5s %5s %5s  %-13s %-13s", "kind, filter, way of a cube", "pixels", "wrong",
                          "acne", "leak", "far", "maps redrawn", "maps reused"));
    for (const CheckRow& row : rows.rows) text += row_text(row);
    text +=
        "  far: wrong where neither an edge nor the map's texels explain it; "
        "times: median, half of what they spread\n";
    return text;
}

std::string first_frames_text(const FirstFrames& frames) {
    return cut(formatted("first frames: %u drawn, each by a new system, %u differ, by %u pixels at most, %.1f s %s",
                         frames.drawn, frames.differ, frames.most_px, frames.took_s, frames.well() ? " ok" : " FAIL"));
}

}  // namespace

std::string check_text(const Check& check) {
    return device_text(check.device) + programs_text(check.programs) + rows_text(check.rows) + first_frames_text(check.first_frames) +
           check_verdict(check) +
           "\n";
}

}  // namespace gnomon::bench
