#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "bench/scaling/many_lights_scene.h"
#include "gnomon/components.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/extract/volumes.h"
#include "systems/frame_system.h"
#include "systems/shadow/projection/light_range.h"
#include "systems/shadow/projection/screen_bounds.h"
#include "systems/shadow/publish/publish_lights.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/system/passes.h"

/// A level with 1000 lights, 200 of them with shadows: what is made, drawn and kept, to the last pass and byte.
namespace gnomon {
namespace {

using Names = std::set<std::string>;

class ManyLights : public ::testing::Test {
protected:
    static constexpr std::uint32_t kLights = 1000;
    static constexpr std::uint64_t kSeed = 7;

    void SetUp() override {
        spawned = game::spawn_scene(bench::demand_scene(kLights, kSeed), world, library);
        auto made = FrameSystem::create(device, library);
        ASSERT_TRUE(made);
        frame = std::move(made).value();
    }
    void TearDown() override {
        frame.reset();
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    const FrameReport& step() {
        frame->run(world,
                   {.viewport_px = {320, 180}, .exposure_ev = {}, .shadow_budget = {shadow::ShadowBudget::kUnlimited}});
        return frame->report();
    }
    std::vector<Pass> passes() const { return passes_of(frame->commands(), device); }

    /// Groups of depth passes: "shadow <light> <layer>".
    Names drawn_views() const {
        Names names;
        for (const Pass& pass : passes()) {
            if (!pass.is_depth) continue;
            EXPECT_TRUE(names.insert(pass.group).second) << pass.group << " is drawn twice";
        }
        return names;
    }
    Names light_passes() const {
        Names names;
        for (const Pass& pass : passes()) {
            if (pass.is_depth || !is_light(pass.group)) continue;
            EXPECT_TRUE(names.insert(pass.group).second) << pass.group << " has two passes";
        }
        return names;
    }
    bool is_light(const std::string& group) const {
        return std::any_of(spawned.lights.begin(), spawned.lights.end(),
                           [&](const auto& l) { return l.name == group; });
    }
    /// Returns the groups of the depth passes that draw the caster.
    Names views_with(ecs::Entity caster) const {
        std::uint32_t slot = ~0u;
        for (const InstanceItem& item : frame->snapshot().instances)
            if (item.entity == caster) slot = item.gpu_slot;
        gl::BufferHandle items{};
        std::string group;
        bool is_depth = false;
        Names names;
        for (const gl::Command& command : frame->commands().commands) {
            if (const auto* g = std::get_if<gl::BeginGroup>(&command)) group = g->label.text();
            if (std::get_if<gl::BeginPass>(&command)) is_depth = group.rfind("shadow ", 0) == 0;
            if (const auto* b = std::get_if<gl::BindMeshes>(&command)) items = b->draw_items;
            if (!is_depth) continue;
            std::vector<gl::DrawMeshes> draws;
            gl::append_mesh_draws(frame->commands(), command, draws);
            for (const gl::DrawMeshes& draw : draws)
                for (std::uint32_t i = 0; i < draw.item_count; ++i) {
                    std::uint32_t drawn = 0;
                    std::memcpy(&drawn, device.buffer_bytes(items).data() + (draw.first_item + i) * 8, sizeof drawn);
                    if (drawn == slot) names.insert(group);
                }
        }
        return names;
    }
    ecs::Entity mover() const {
        for (const ecs::Entity node : spawned.nodes)
            if (const Name* name = world.get<Name>(node); name && name->text == bench::kDemandMover) return node;
        ADD_FAILURE() << "no mover";
        return {};
    }

    gl::RecordingDevice device;
    ecs::Registry world;
    assets::MeshLibrary library;
    game::SpawnedScene spawned;
    std::unique_ptr<FrameSystem> frame;
};

TEST_F(ManyLights, HaveViewsAndPassesAsFarAsTheyAreSeenAndNoMore) {
    const FrameReport& report = step();
    ASSERT_EQ(report.lights.size(), kLights);
    std::map<Reason, std::uint32_t> reasons;
    std::uint32_t views = 0, drawn = 0;
    for (const LightReport& light : report.lights) {
        ++reasons[light.reason];
        views += light.counts.views;
        drawn += light.counts.views_drawn;
        EXPECT_EQ(light.counts.views > 0, light.counts.bytes > 0) << light.name;
        EXPECT_EQ(light.counts.views > 0, light.state == LightState::rendered) << light.name;
    }
    EXPECT_EQ(reasons[Reason::no_light_shadow], kLights - bench::kMostShadowedLights);
    EXPECT_EQ(reasons[Reason::none] + reasons[Reason::no_visible_receiver] + reasons[Reason::no_caster],
              bench::kMostShadowedLights);
    EXPECT_GT(reasons[Reason::none], 10u);
    EXPECT_GT(reasons[Reason::no_visible_receiver], 50u) << "most are behind the camera";
    EXPECT_EQ(drawn_views().size(), drawn);
    EXPECT_LE(drawn, views) << "a cascade without casters is cleared alone";

    // A light has a pass if the middle of some instance is both seen and reached. It has none if no instance is, by its
    // bounds.
    const SceneSnapshot& scene = frame->snapshot();
    const ConsumerItem& camera = scene.consumers.at(0);
    const math::Frustum frustum = consumer_frustum(camera);
    const auto meets = [&](const LightItem& light, const math::Aabb& box) {
        return math::overlap(math::planes_of(frustum), box) != math::Overlap::outside &&
               shadow::LightReach(light).overlap(box) != math::Overlap::outside;
    };
    Names by_bounds, by_middles;
    for (const LightItem& light : scene.lights) {
        if (shadow::screen_rectangle(light, camera).width == 0) continue;
        for (const InstanceItem& item : scene.instances) {
            if (!item.visible) continue;
            const glm::dvec3 middle = math::centre(item.bounds_ws);
            if (meets(light, item.bounds_ws)) by_bounds.insert(light.name);
            if (meets(light, {middle, middle})) by_middles.insert(light.name);
        }
    }
    const Names passes = light_passes();
    EXPECT_TRUE(std::includes(by_bounds.begin(), by_bounds.end(), passes.begin(), passes.end()));
    EXPECT_TRUE(std::includes(passes.begin(), passes.end(), by_middles.begin(), by_middles.end()));
    EXPECT_GT(by_middles.size(), 10u);
    EXPECT_LT(by_bounds.size(), kLights / 2u);
}

TEST_F(ManyLights, HoldTheBytesTheySayAndUseAProgramPerRow) {
    const FrameReport& report = step();
    std::uint64_t said = 0, held = 0;
    for (const LightReport& light : report.lights) said += light.counts.bytes;
    Names rows;
    for (const gl::ResourceCall& call : device.resource_calls()) {
        if (call.kind == gl::ResourceCall::Kind::create_texture && call.label.rfind("shadow map", 0) == 0)
            held += call.bytes;
        if (call.kind == gl::ResourceCall::Kind::create_program) rows.insert(call.label);
    }
    EXPECT_EQ(said, held);
    EXPECT_GT(said, 0u);
    const std::string filter(shadow::filter_row(LightShadow{}.filter).file);
    Names wanted = {"surface", "luminance", "tonemap"};
    for (const char* kind : {"LIGHT_DIRECTIONAL", "LIGHT_SPOT", "LIGHT_POINT"}) {
        wanted.insert(std::string("light ") + kind + " " + filter);
        wanted.insert(std::string("decided light ") + kind + " " + filter);
        wanted.insert(std::string("light ") + kind + " ");
    }
    wanted.erase("light LIGHT_DIRECTIONAL ");  // the only sun casts shadows
    Names others;
    for (const std::string& row : rows)
        if (row.rfind("depth ", 0) == 0) others.insert(row);
    EXPECT_EQ(others.size(), 1u) << "one way of drawing depths";
    wanted.insert(others.begin(), others.end());
    EXPECT_EQ(rows, wanted);
    EXPECT_EQ(report.programs_compiled, rows.size());
}

TEST_F(ManyLights, AreDrawnOnceAndThenOnlyWhereSomethingMoves) {
    step();
    const Names all = drawn_views(), with_mover = views_with(mover());
    EXPECT_GE(with_mover.size(), 3u);
    EXPECT_LT(with_mover.size(), all.size() / 2);
    for (int i = 2; i < 80; ++i) {
        const FrameReport& report = step();
        EXPECT_EQ(drawn_views(), Names{}) << "frame " << i;
        // In the second still one, what pixels saw is kept: the visibility of each kind, and a program that reads it.
        EXPECT_EQ(report.programs_compiled, i == 3 ? 6u : 0u) << "frame " << i;
    }
    EXPECT_TRUE(frame->report().still);
    world.patch<Transform>(mover(), [](Transform& t) { t.translation_m.x += 0.02; });
    step();
    Names touched = views_with(mover());
    touched.insert(with_mover.begin(), with_mover.end());
    EXPECT_EQ(drawn_views(), touched) << "those that it left, and those that it is in";
    EXPECT_EQ(frame->report().programs_compiled, 0u);
    step();
    EXPECT_EQ(drawn_views(), Names{});
}

}  // namespace
}  // namespace gnomon
