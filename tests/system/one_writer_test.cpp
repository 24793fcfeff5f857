#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>

#include "engine/core/signature.h"
#include "engine/gl/device_recording.h"
#include "systems/extract/extract.h"
#include "systems/shadow/fitting/fit_light.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"
#include "tests/economy/changing_world.h"
#include "tests/system/test_world.h"
#include "tests/unit/math/random_seed.h"

/// Each column of a frame is as its stage left it when the frame ends: one writer, whatever happens.
namespace gnomon {
namespace {

template <class T>
std::uint64_t hash(const std::vector<T>& items) {
    Signature s;
    s.add(std::as_bytes(std::span(items)));
    return s.value();
}

/// Hashes of what the fits write into the next history: all but the budget's part.
std::uint64_t hash_of_fits(const shadow::History& history) {
    Signature s;
    const auto add = [&s](const auto& member) { s.add(std::as_bytes(std::span(&member, 1))); };
    for (const shadow::LightFitHistory& light : history.lights) {
        add(light.light);
        add(light.splits);
        add(light.views);
        add(light.cone);
        add(light.aim);
        add(light.sampled_splits);
        add(light.size);
        add(light.count);
        add(light.filter);
        add(light.rays);
    }
    s.add(history.pictures);
    return s.value();
}

/// Hashes of all columns that stand after `stage`, by the name of column and stage.
using Columns = std::map<std::string, std::uint64_t>;

void add_columns(std::string_view stage, const shadow::ShadowFrame& f, Columns& columns) {
    const auto add = [&](const char* name, std::uint64_t value) { columns.emplace(name, value); };
    if (stage == "request") {
        add("requests", hash(f.requests));
        add("limited", hash(f.limited));
    }
    if (stage == "culling") {
        add("lamps", hash(f.lamps_ws_m));
        add("sets", hash(f.sets.lights));
        add("receivers", hash(f.sets.receiver_items));
        add("casters", hash(f.sets.caster_items));
        add("points", hash(f.sets.receiver_points_ws));
        add("error points", hash(f.sets.error_points_ws));
        add("hulls", hash(f.sets.hulls));
        add("outlines", hash(f.sets.outlines));
    }
    if (stage == "fitting") {
        add("choices", hash(f.fitted.lights));
        add("views", hash(f.fitted.views));
        add("view casters", hash(f.fitted.casters));
        add("resized hulls", hash(f.fitted.resized_sets.hulls));
        add("history", hash_of_fits(f.next_history));
    }
    if (stage == "budget") add("decisions", hash(f.decisions));
    if (stage == "maps") add("maps", hash(f.maps));
    if (stage == "update") add("updates", hash(f.updates));
    if (stage == "publish") {
        add("clearances", hash(f.clearances_m));
        for (const shadow::LightingInputs& inputs : f.inputs)
            add(("inputs " + std::to_string(inputs.consumer)).c_str(), hash(inputs.lights));
    }
}

constexpr const char* kStages[] = {"request", "culling", "fitting", "budget", "maps", "update", "publish"};

class OneWriter : public ::testing::Test {
protected:
    OneWriter() {
        auto made = GpuScene::create(device, library);
        EXPECT_TRUE(made);
        gpu = std::make_unique<GpuScene>(std::move(made).value());
        shadows = std::make_unique<shadow::ShadowSystem>(device);
        shadows->watch_stages([this](std::string_view stage, const shadow::ShadowFrame& frame) {
            ++stages[std::string(stage)];
            add_columns(stage, frame, columns);
            if (meddle) meddle(stage, const_cast<shadow::ShadowFrame&>(frame));
        });
    }
    /// Runs frames; returns how many columns differ at the end of their frame from what their stage left.
    int run(int frames) {
        int changed = 0;
        for (int i = 0; i < frames; ++i) {
            world.change();
            const TransformReport& transforms = moved.update(world.registry());
            extractor.update(world.registry(), library, transforms, {96, 64}, scene);
            commands.clear();
            columns.clear();
            gpu->update(scene, commands);
            const shadow::ShadowBudget budget{i % 3 == 0 ? 3000000u : 0u, i % 5 == 0 ? 0.2f : 0.0f,
                                              i % 7 == 0 ? 1000u : 0u};
            const shadow::ShadowFrame& frame = shadows->update(scene, *gpu, {true, budget, {}}, commands, report);
            Columns last;
            for (const char* stage : kStages) add_columns(stage, frame, last);
            if (!report.still)
                for (const auto& [name, value] : columns)
                    if (last.at(name) != value) ++changed, changed_columns.insert(name);
            for (const shadow::FitChoice& light : frame.fitted.lights) {
                most_fits = std::max(most_fits, light.fits);
                EXPECT_LE(light.fits, shadow::kMaxFits);
            }
            shadows->commit(scene, device.submit(commands).failure == gl::Failure::none);
            device.forget();
        }
        return changed;
    }

    static std::vector<ShadowFilter> filters() {
        return {ShadowFilter::automatic,  ShadowFilter::triangles, ShadowFilter::exact,
                ShadowFilter::exact_soft, ShadowFilter::vsm,       ShadowFilter::hard};
    }
    gl::RecordingDevice device;
    const assets::MeshLibrary library = test_library();
    ChangingWorld world{print_seed(), filters()};
    TransformSystem moved;
    Extractor extractor;
    SceneSnapshot scene;
    std::unique_ptr<GpuScene> gpu;
    std::unique_ptr<shadow::ShadowSystem> shadows;
    gl::CommandList commands;
    FrameReport report;
    Columns columns;
    std::map<std::string, int> stages;
    std::set<std::string> changed_columns;
    std::uint32_t most_fits = 0;
    std::function<void(std::string_view, shadow::ShadowFrame&)> meddle;
};

TEST_F(OneWriter, EachColumnIsAtTheEndAsItsStageLeftIt) {
    EXPECT_EQ(run(400), 0);
    for (const char* stage : kStages) EXPECT_GT(stages[stage], 100) << stage;
    EXPECT_GT(most_fits, 0u);
    std::cout << "at most " << most_fits << " fits of a light in a frame\n";
}

/// Writes one column after a later stage than its own.
struct SecondWriter {
    const char* column;
    const char* stage;
    void (*write)(shadow::ShadowFrame&);
};
constexpr SecondWriter kSecondWriters[] = {
    {"requests", "culling", [](shadow::ShadowFrame& f) { f.requests.at(0).map.resolution_px += 1; }},
    {"hulls", "fitting", [](shadow::ShadowFrame& f) { f.sets.hulls.at(0).far_m += 1.0; }},
    {"sets", "publish", [](shadow::ShadowFrame& f) { f.sets.lights.at(0).casters.count += 1; }},
    {"choices", "budget", [](shadow::ShadowFrame& f) { f.fitted.lights.at(0).fits += 1; }},
    {"views", "budget", [](shadow::ShadowFrame& f) { f.fitted.views.at(0).error.edge_px += 1.0; }},
    {"history", "budget", [](shadow::ShadowFrame& f) { f.next_history.lights.at(0).size.map_px += 1; }},
    {"decisions", "publish", [](shadow::ShadowFrame& f) { f.decisions.at(0).request.map.resolution_px += 1; }},
    {"maps", "publish", [](shadow::ShadowFrame& f) { f.maps.at(0).size_px += 1; }},
    {"updates", "publish", [](shadow::ShadowFrame& f) { f.updates.at(0).waited_frames += 1; }},
};

TEST_F(OneWriter, ASecondWriterOfEachColumnWouldBeSeen) {
    for (const SecondWriter& second : kSecondWriters) {
        meddle = [&second](std::string_view now, shadow::ShadowFrame& frame) {
            if (now == second.stage && !frame.fitted.views.empty() && !frame.sets.hulls.empty()) second.write(frame);
        };
        changed_columns.clear();
        // A random world may for a while have no light with a view.
        for (int round = 0; round < 20 && changed_columns.empty(); ++round) run(60);
        EXPECT_TRUE(changed_columns.contains(second.column)) << second.column;
        EXPECT_EQ(changed_columns.size(), 1u) << second.column;
    }
}

}  // namespace
}  // namespace gnomon
