#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/components.h"
#include "tests/gl/recorded_errors.h"
#include "tests/gl/truth_scenes.h"
#include "tests/source_paths.h"

// The regression gate of what is neither lit nor dark: penumbrae, edges within pixels, light through glass. Errors are
// summed up, in pixels of full light. No sum may exceed the recorded one, on the software device that it is of.
namespace gnomon {
namespace {

using test::ErrorCounts;
using test::ErrorsByRow;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Row of the gate.
struct GateRow {
    std::string name;
    const char* scene = nullptr;  // null: the courtyard
    std::vector<std::string> settings = {};
    std::optional<LightKind> kind = {};  // kind of all lamps; empty: their own
    std::uint32_t area_side = 0;         // AccuracyOptions::area_side
    float mist_per_m = 0.0f;             // StageOptions::mist_per_m; above 0: the row judges it
};

std::vector<GateRow> gate_rows() {
    std::vector<GateRow> rows;
    for (const std::string filter : {"pcss", "soft_triangles", "exact_soft"})
        rows.push_back(
            {.name = "disk, " + filter, .settings = {"sun_radius_deg=1", "source_radius_m=0.05", "filter=" + filter}});
    for (const std::string antialias : {"off", "on"})
        rows.push_back(
            {.name = "area, antialias=" + antialias, .settings = {"antialias=" + antialias}, .area_side = 8});
    for (const LightKind kind : {LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube})
        rows.push_back({.name = std::string("lamps of kind ") + to_text(kind), .kind = kind});
    rows.push_back({.name = "glass", .scene = "panes"});
    rows.push_back({.name = "mist", .mist_per_m = 0.06f});
    return rows;
}

GateRow row_named(const std::string& name) {
    for (const GateRow& row : gate_rows())
        if (row.name == name) return row;
    ADD_FAILURE() << name;
    return {};
}

/// Pixels by which a sum may be above the recorded one: both are rounded, and last digits differ between processors.
constexpr std::size_t kRounding_px = 1;

/// Returns the sums that are still as recorded.
ErrorsByRow rounded_up(ErrorsByRow recorded) {
    for (auto& [key, sums] : recorded)
        for (std::size_t* sum : {&sums.wrong, &sums.acne, &sums.leak}) *sum += kRounding_px;
    return recorded;
}

std::size_t whole(double pixels) { return static_cast<std::size_t>(std::llround(std::max(pixels, 0.0))); }
double sum(double mean, std::size_t pixels) { return mean * static_cast<double>(pixels); }

/// Sums of a source with a size: within penumbrae, and of light missing and false beyond them.
ErrorCounts sums_of(const oracle::SoftMetrics& m) {
    return {m.penumbra, whole(sum(m.penumbra_error, m.penumbra)), whole(sum(m.lit_loss, m.lit)),
            whole(sum(m.umbra_leak, m.umbra))};
}
/// Sums over crossed pixels, and of their bias by its sign.
ErrorCounts sums_of(const oracle::AreaMetrics& m) {
    const double bias = sum(m.bias, m.crossed);
    return {m.crossed, whole(sum(m.mean_error, m.crossed)), whole(-bias), whole(bias)};
}
/// Sums over pixels behind glass, and of false colour elsewhere.
ErrorCounts sums_of(const oracle::TintMetrics& m) {
    const double tinted = sum(m.tinted_error, m.tinted);
    return {m.tinted, whole(tinted), whole(sum(m.mean_error, m.scored) - tinted), 0};
}
/// Sums over places in fog, and over view rays.
ErrorCounts sums_of(const bench::AirAccuracy& air) {
    return {air.places, whole(sum(air.way_error, air.ways)), 0, air.wrong};
}

class MeanErrorGate : public TruthTest {
protected:
    static std::filesystem::path record_file() { return test::source_folder() / "tests/gl/recorded_mean_errors.txt"; }

    /// Returns the sums of each light that the row judges.
    ErrorsByRow judge(const GateRow& row) {
        bench::StageOptions options;
        options.size_px = {256, 144};
        options.settings = row.settings;
        options.mist_per_m = row.mist_per_m;
        if (row.scene) options.scene = row.scene;
        const auto stage = open(options);
        if (!stage) return {};
        device_ = stage->device().info().name;
        if (row.kind) give_lamps(*stage, *row.kind);
        ErrorsByRow found;
        for (const bench::LightAccuracy& light :
             measure(*stage, {.timed_frames = 0, .area_side = row.area_side}).lights) {
            const auto add = [&](const ErrorCounts& sums) { found[{light.report.name, row.name}] = sums; };
            if (row.area_side > 0) {
                if (light.area) add(sums_of(light.area->metrics));
            } else if (row.mist_per_m > 0.0f) {
                if (light.air) add(sums_of(*light.air));
            } else if (row.scene) {
                if (light.tint) add(sums_of(light.tint->metrics));
            } else if (light.soft) {
                add(sums_of(light.soft->metrics));
            }
        }
        return found;
    }
    ErrorsByRow judge_all() {
        ErrorsByRow all;
        for (const GateRow& row : gate_rows()) all.merge(judge(row));
        return all;
    }
    /// Returns what was recorded of a row, and fails without.
    static ErrorsByRow recorded(const std::string& name) {
        ErrorsByRow rows = test::read_errors(record_file()).rows;
        std::erase_if(rows, [&](const auto& row) { return row.first.second != name; });
        EXPECT_FALSE(rows.empty()) << name;
        return rows;
    }
    bool counts_as_recorded() const { return device_.find("llvmpipe") != std::string::npos; }

    std::string device_;

private:
    static void give_lamps(bench::Stage& stage, LightKind kind) {
        for (const game::NamedEntity& light : stage.spawned().lights)
            stage.world().patch<Light>(light.entity, [&](Light& lamp) {
                if (lamp.kind == LightKind::directional) return;
                lamp.kind = kind;
                lamp.width_m = kind == LightKind::tube ? 0.6f : 0.4f;
                lamp.height_m = 0.25f;
                lamp.source_radius_m = kind == LightKind::tube ? 0.03f : 0.15f;
            });
    }
};

class MeanErrorGateControls : public MeanErrorGate {};

TEST_F(MeanErrorGate, NoSumIsHigherThanWasRecorded) {
    const ErrorsByRow found = judge_all();
    if (!counts_as_recorded()) GTEST_SKIP() << device_ << " is not llvmpipe, of which the sums are";
    const char* const how = "GNOMON_RECORD_ERRORS=1 gl_truth --gtest_filter='MeanErrorGate.*' records them anew";
    if (std::getenv("GNOMON_RECORD_ERRORS") != nullptr)
        test::write_errors(record_file(), {device_, found},
                           "How far rows are from the truth where it is neither lit nor dark, in pixels of full light\n"
                           "# (tests/gl/mean_error_gate_gl_test.cpp); none may rise.");
    const test::RecordedErrors before = test::read_errors(record_file());
    for (const std::string& line : test::what_rose(rounded_up(before.rows), found)) ADD_FAILURE() << line;
    if (HasFailure())
        std::printf("recorded on %s; this is %s. If that, or a better truth, is the reason: %s\n",
                    before.device.c_str(), device_.c_str(), how);
    const std::vector<std::string> fell = test::what_fell(before.rows, found);
    for (const std::string& line : fell) std::printf("better: %s\n", line.c_str());
    if (!fell.empty()) std::printf("%zu sums fell, and should stay there: %s\n", fell.size(), how);
}

TEST_F(MeanErrorGateControls, IsShutByFewerRaysByStairsByGlassThatLetsNothingThroughAndByCoarseMapsOfMist) {
    const auto rose = [&](const std::string& name, const char* setting) {
        GateRow row = row_named(name);
        row.settings.push_back(setting);
        return test::what_rose(rounded_up(recorded(name)), judge(row));
    };
    if (judge(row_named("glass")); !counts_as_recorded())
        GTEST_SKIP() << device_ << " is not llvmpipe, of which the sums are";
    EXPECT_THAT(rose("disk, exact_soft", "penumbra_rays=4"),
                Contains(HasSubstr("lantern, \"disk, exact_soft\": wrong")));
    EXPECT_THAT(rose("disk, soft_triangles", "source_radius_m=0"), Contains(HasSubstr("is missing")));
    EXPECT_THAT(rose("area, antialias=on", "antialias=off"), Contains(HasSubstr("sun, \"area, antialias=on\": wrong")));
    EXPECT_THAT(rose("glass", "translucent_casters=off"), Contains(HasSubstr("is missing")));
    EXPECT_THAT(rose("glass", "resolution=64"), Contains(HasSubstr("spot, \"glass\": wrong")));
    EXPECT_THAT(rose("mist", "resolution=32"), Contains(HasSubstr("sun, \"mist\": wrong")));
}

}  // namespace
}  // namespace gnomon
