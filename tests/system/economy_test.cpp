#include "gnomon/components.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/system/frame_fixture.h"

/// What must cost nothing: counted in commands, bytes and programs.
namespace gnomon {
namespace {

using ::testing::IsEmpty;

class Economy : public FrameTest {
protected:
    /// Returns the labels of all live objects that exist for shadows alone.
    std::vector<std::string> shadow_objects() const {
        std::vector<std::string> labels = device.live_labels();
        std::erase_if(labels, [](const std::string& label) {
            const auto has = [&](const char* word) { return label.find(word) != std::string::npos; };
            return !has("shadow") && !has("filters") && !has("depth opaque") && !has("depth masked") && !has("moments");
        });
        return labels;
    }
    /// Commands between the groups of lights' maps, and between those of their moments.
    std::size_t shadow_commands() const {
        std::size_t commands = 0, depth = 0;
        for (const gl::Command& command : frame->commands().commands) {
            const auto* group = std::get_if<gl::BeginGroup>(&command);
            const bool begins =
                group && (group->label.text().starts_with("shadow ") || group->label.text().starts_with("moments "));
            if (begins || (depth > 0 && group)) ++depth;
            if (depth > 0) ++commands;
            if (depth > 0 && std::get_if<gl::EndGroup>(&command)) --depth;
        }
        return commands;
    }
    void expect_nothing(const char* why) {
        for (int i = 0; i < 3; ++i) step();
        EXPECT_THAT(shadow_objects(), IsEmpty()) << why;
        EXPECT_EQ(shadow_commands(), 0u) << why;
        EXPECT_THAT(depth_passes(), IsEmpty()) << why;
        for (const LightReport& light : frame->report().lights) {
            EXPECT_EQ(light.counts.bytes, 0u) << why;
            EXPECT_EQ(light.state, LightState::skipped) << why;
        }
    }
    void add_lights(bool shadow) {
        for (const shadow::LightKindRow& kind : shadow::light_kind_table())
            world.add_light(kind.kind, kLightPlace_m, std::string(kind.name), shadow);
    }
    template <class Edit>
    void edit_shadows(Edit edit) {
        std::vector<ecs::Entity> lights;
        world.registry.each<LightShadow>([&](ecs::Entity e, const LightShadow&) { lights.push_back(e); });
        for (const ecs::Entity light : lights) world.registry.patch<LightShadow>(light, edit);
    }
};

TEST_F(Economy, LightsThatCastNoShadowCostNoneOfIt) {
    const TestWorld::Stage stage = world.add_stage();
    add_lights(false);
    expect_nothing("no LightShadow");
    world = {};
    frame.reset();
    start();
    const TestWorld::Stage again = world.add_stage();
    add_lights(true);
    edit_shadows([](LightShadow& s) { s.enabled = false; });
    expect_nothing("disabled");
    edit_shadows([](LightShadow& s) { s.enabled = true; });
    settings.shadows = false;
    expect_nothing("all disabled");
    settings.shadows = true;
    world.registry.remove<ShadowCaster>(again.box);
    step();
    EXPECT_EQ(shadow_commands(), 0u) << "without a caster";
    EXPECT_THAT(map_labels(device), IsEmpty()) << "without a caster";
    world.registry.emplace<ShadowCaster>(again.box);
    world.move(again.camera, {0, -4, 8});
    step();
    EXPECT_EQ(shadow_commands(), 0u) << "without a receiver";
    EXPECT_THAT(map_labels(device), IsEmpty()) << "without a receiver";
    world.move(again.camera, {0, 4, 8});
    step();
    EXPECT_GT(shadow_commands(), 0u) << "the count sees shadows";
    EXPECT_FALSE(shadow_objects().empty());
    EXPECT_NE(stage.box, ecs::kNull);
}

TEST_F(Economy, AStillSceneDrawsAndClearsNothingFromTheSecondFrameOnWhateverTheFilter) {
    world.add_stage();
    world.add_mesh(kMaskedBox, {1, 1, 1}, true);
    add_lights(true);
    std::size_t drawn = 0;
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        edit_shadows([&](LightShadow& s) { s.filter = row.id, s.resolution_px = 64; });
        step();
        drawn += shadow_commands();
        for (int i = 0; i < 5; ++i) {
            step();
            EXPECT_EQ(shadow_commands(), 0u) << row.name << ", frame " << i + 2;
            EXPECT_THAT(depth_passes(), IsEmpty()) << row.name;
            for (const LightReport& light : frame->report().lights) {
                EXPECT_EQ(light.counts.draws + light.counts.clears, 0u) << row.name;
                EXPECT_EQ(light.state, LightState::reused) << row.name;
            }
        }
    }
    EXPECT_GT(drawn, 0u) << "the count sees shadows";
}

TEST_F(Economy, NothingIsCompiledOnceAllThatIsSeenHasBeen) {
    world.add_stage();
    add_lights(true);
    for (int i = 0; i < 3; ++i) step();
    device.forget();
    for (int i = 0; i < 10; ++i) step();
    for (const gl::ResourceCall& call : device.resource_calls())
        EXPECT_EQ(call.kind, gl::ResourceCall::Kind::submit) << call.label;
}

}  // namespace
}  // namespace gnomon
