#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "bench/check/check.h"
#include "bench/check/check_judge.h"
#include "engine/gl/device_recording.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/extract/light_facts.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

constexpr std::size_t kLine = 120, kRoutes = 3;

CheckRow made_up_row(CheckVerdict verdict) {
    CheckRow row;
    row.setup = check_row_setups().back();
    row.verdict = verdict;
    row.why = verdict == CheckVerdict::ok ? "" : "made up";
    row.errors.scored = 1234;
    row.drawn_us = spread_of({10.0, 12.0, 11.0});
    return row;
}

Check well() {
    Check check;
    check.device = check_device({}, gl::RecordingDevice::default_info());
    check.programs.all = check.programs.compiled = 7;
    check.rows.rows = {made_up_row(CheckVerdict::ok), made_up_row(CheckVerdict::ok),
                       made_up_row(CheckVerdict::not_judged)};
    check.first_frames = {.drawn = 4, .differ = 0, .most_px = 0, .dark_px = 9, .took_s = 0.0};
    return check;
}

std::string last_line(const std::string& text) {
    const std::string whole = text.substr(0, text.size() - 1);
    return whole.substr(whole.rfind('\n') + 1);
}

TEST(Check, SaysInItsLastLineThatAllIsWell) {
    const Check check = well();
    EXPECT_TRUE(is_well(check));
    EXPECT_EQ(last_line(check_text(check)), "all is well here: 7 programs, 2 of 3 rows");
}

TEST(Check, IsNotWellByAnyOneThingThatIsNot) {
    Check limit = well(), program = well(), row = well(), none = well(), unopened = well(), lost = well(), lit = well();
    gl::DeviceFacts facts;
    facts.limits = {{"LOW", 7, 8}, {"HIGH", 9, 8, true}, {"RIGHT", 8, 8}, {"AS_WELL", 8, 8, true}};
    limit.device = check_device(facts, gl::RecordingDevice::default_info());
    program.programs.failed.push_back({"a program", "line 3: no"});
    row.rows.rows.push_back(made_up_row(CheckVerdict::failed));
    none.rows.rows.clear();
    unopened.rows.error = "no memory";
    lost.first_frames.differ = 1;
    lit.first_frames.dark_px = 0;
    EXPECT_EQ(limit.device.short_of.size(), 2u);
    for (const Check* check : {&limit, &program, &row, &none, &unopened, &lost, &lit}) {
        EXPECT_FALSE(is_well(*check));
        EXPECT_EQ(last_line(check_text(*check)).rfind("not all is well here: ", 0), 0u) << check_text(*check);
        EXPECT_FALSE(nlohmann::json::parse(check_json(*check)).at("well").get<bool>());
    }
}

TEST(Check, FitsIntoItsColumnsWhateverADriverSays) {
    Check check = well();
    check.device.facts.renderer = std::string(300, 'r') + "\x1b[2J";
    check.programs.failed.push_back({std::string(200, 'p'), std::string(500, 'e') + "\n\x07second\nthird"});
    CheckRow failed = made_up_row(CheckVerdict::failed);
    failed.why = std::string(400, 'w');
    failed.errors = {123456, 123456, 123456, 123456, 0, 123456, {}};
    failed.drawn_us = failed.kept_us = spread_of({9.9e8, 1.0e8});
    check.rows.rows.push_back(failed);
    std::istringstream text(check_text(check));
    for (std::string line; std::getline(text, line);) {
        EXPECT_LE(line.size(), kLine) << line;
        for (const char c : line) EXPECT_GE(c, ' ') << line;
    }
}

TEST(Check, HasARowForEveryKindFilterAndWayOfACube) {
    std::set<std::string> names;
    for (const CheckRowSetup& setup : check_row_setups()) {
        EXPECT_TRUE(names.insert(setup.name).second) << setup.name;
        game::LightSettings settings;
        for (const std::string& setting : setup.settings)
            EXPECT_FALSE(game::apply_setting(settings, setting)) << setting;
        EXPECT_EQ(settings.shadow.filter, setup.filter->id);
        EXPECT_EQ(settings.tuning.maps.cube_route, setup.route);
    }
    const auto kinds = shadow::light_kind_table();
    const auto filters = shadow::filter_table();
    const auto area = static_cast<std::size_t>(
        std::count_if(kinds.begin(), kinds.end(), [](const auto& row) { return light_facts(row.kind).area(); }));
    const auto soft = static_cast<std::size_t>(std::count_if(
        filters.begin(), filters.end(), [](const auto& row) { return row.width == shadow::FilterWidth::source; }));
    EXPECT_EQ(area, 4u);
    EXPECT_EQ(names.size(), (kinds.size() - area - 1 + kRoutes) * filters.size() + area * soft);
}

TEST(Check, AllowsNothingThatNeitherAnEdgeNorTheFilterExplains) {
    const shadow::FilterRow& hard = shadow::filter_row(ShadowFilter::hard);
    const shadow::FilterRow& exact = shadow::filter_row(ShadowFilter::exact);
    const shadow::FilterRow& soft = shadow::filter_row(ShadowFilter::exact_soft);
    CheckErrors errors;
    errors.scored = 100;
    errors.wrong = 3;
    EXPECT_EQ(broken_bound(hard, 16, errors), "");
    EXPECT_NE(broken_bound(exact, 16, errors), "");
    EXPECT_EQ(broken_bound(soft, 16, errors), "");
    errors.penumbra_error = 0.11;  // half of sqrt((1/16 + 1/256) 2/pi) is 0.103
    EXPECT_NE(broken_bound(soft, 16, errors), "");
    EXPECT_EQ(broken_bound(soft, 8, errors), "");
    errors = {100, 0, 0, 0, 1, 0, {}};
    EXPECT_NE(broken_bound(hard, 16, errors), "");
    errors = {100, 0, 0, 0, 0, 1, {}};
    EXPECT_NE(broken_bound(hard, 16, errors), "");
    EXPECT_NE(broken_bound(hard, 16, {}), "") << "nothing was judged";
}

TEST(Check, SaysWhichProgramFailedAndGoesOn) {
    gl::DeviceInfo info = gl::RecordingDevice::default_info();
    info.vertex_layer = true;
    gl::RecordingDevice device(info);
    const std::vector<gl::ProgramDesc> programs = check_programs();
    device.fail_label("depth masked, triangles, layer by vertex", gl::Failure::compile_failed);
    std::size_t steps = 0;
    const ProgramChecks checks =
        compile_programs(device, programs, [&](const std::string&, std::size_t, std::size_t) { ++steps; });
    EXPECT_EQ(steps, programs.size());
    ASSERT_EQ(checks.failed.size(), 1u);
    EXPECT_EQ(checks.failed[0].label, "depth masked, triangles, layer by vertex");
    EXPECT_EQ(checks.compiled, programs.size() - 1);
}

TEST(Check, AsksForNoProgramThatTheDeviceCannotHave) {
    gl::DeviceInfo info = gl::RecordingDevice::default_info();
    info.vertex_layer = false;
    gl::RecordingDevice device(info);
    const ProgramChecks checks =
        compile_programs(device, check_programs(), [](const std::string&, std::size_t, std::size_t) {});
    EXPECT_EQ(checks.not_here.size(), 4u);
    EXPECT_EQ(checks.compiled + checks.not_here.size(), checks.all);
}

TEST(Check, CompilesEachProgramOnceThoseOfItsRowsIncluded) {
    const auto source = [](const gl::ProgramDesc& p) { return p.vertex + p.geometry + p.fragment + p.compute; };
    std::set<std::string> sources, labels;
    for (const gl::ProgramDesc& program : check_programs()) {
        EXPECT_NE(source(program), "") << program.label;
        EXPECT_TRUE(sources.insert(source(program)).second) << program.label;
        EXPECT_TRUE(labels.insert(program.label).second) << program.label;
    }
    std::set<std::string> asked;
    for (const gl::ProgramDesc& program : programs_of_rows()) {
        EXPECT_EQ(sources.count(source(program)), 1u) << program.label;
        asked.insert(program.label);
    }
    for (const char* label : {"depth opaque", "depth masked, layer by vertex", "depth opaque, layer by geometry",
                              "decided light LIGHT_DIRECTIONAL shadow/filters/triangles/triangles.glsl"})
        EXPECT_EQ(asked.count(label), 1u) << label << ": rows are drawn as they ask";
}

}  // namespace
}  // namespace gnomon::bench
