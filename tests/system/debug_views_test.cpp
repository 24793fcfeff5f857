#include "systems/retry.h"
#include "tests/system/frame_fixture.h"

/// Debug views cost nothing until one is shown, and then one pass over the picture.
namespace gnomon {
namespace {

class DebugViews : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        world.add_stage();
        world.add_light(LightKind::spot, kLightPlace_m, "lamp");
        world.add_light(LightKind::point, {0, 5, 1}, "bulb");
        world.look_lights_up();
    }
    void show(const std::string& light) { settings.debug = {.view = debug::find_view("depth"), .light = light}; }
    std::size_t made(const std::string& label) const {
        std::size_t count = 0;
        for (const gl::ResourceCall& call : device.resource_calls())
            if (call.label.find(label) != std::string::npos && !call.failed) ++count;
        return count;
    }
    std::uint32_t id_of(const std::string& label) const {
        for (const gl::ResourceCall& call : device.resource_calls())
            if (call.label == label) return call.id;
        return 0;
    }
    /// Returns the commands that the last frame has beyond `without`.
    std::vector<gl::Command> added_to(const gl::CommandList& without) const {
        const auto& all = frame->commands().commands;
        EXPECT_GE(all.size(), without.commands.size());
        EXPECT_TRUE(std::equal(without.commands.begin(), without.commands.end(), all.begin())) << "the rest changed";
        return {all.begin() + static_cast<std::ptrdiff_t>(without.commands.size()), all.end()};
    }
    const gl::BindTexture* bound(const std::vector<gl::Command>& commands) const {
        const gl::BindTexture* found = nullptr;
        for (const gl::Command& c : commands)
            if (const auto* bind = std::get_if<gl::BindTexture>(&c)) {
                EXPECT_EQ(found, nullptr);
                found = bind;
            }
        return found;
    }
};

TEST_F(DebugViews, WhatIsNotShownChangesNoCommandAndMakesNothing) {
    step();
    step();
    const gl::CommandList plain = frame->commands();
    EXPECT_EQ(made("debug"), 0u);
    show("lamp");
    step();
    EXPECT_NE(frame->commands(), plain);
    settings.debug = {};
    step();
    EXPECT_EQ(frame->commands(), plain);
    EXPECT_TRUE(frame->debug_labels().empty());
}

TEST_F(DebugViews, AShownOneIsOnePassOverThePictureThatReadsTheMapRaw) {
    step();
    step();
    const gl::CommandList plain = frame->commands();
    show("lamp");
    step();
    const std::vector<gl::Command> added = added_to(plain);
    ASSERT_EQ(added.size(), 9u);
    EXPECT_EQ(added.front(), gl::Command(gl::BeginGroup{"debug depth"}));
    const auto* pass = std::get_if<gl::BeginPass>(&added[2]);
    ASSERT_TRUE(pass);
    EXPECT_EQ(pass->target, frame->picture_target());
    EXPECT_FALSE(pass->clear_colour || pass->clear_depth);
    EXPECT_EQ(pass->viewport, (gl::Rect{0, 0, 640, 360}));
    const gl::BindTexture* bind = bound(added);
    ASSERT_TRUE(bind);
    EXPECT_EQ(bind->unit, 0u);
    EXPECT_EQ(device.texture(bind->texture)->label, "shadow map lamp");
    EXPECT_EQ(bind->sampler.id, id_of("debug raw"));
    EXPECT_FALSE(frame->debug_labels().empty());
}

TEST_F(DebugViews, AReusedMapIsShownWithoutBeingDrawnAgain) {
    show("lamp");
    step();
    step();
    EXPECT_EQ(light("lamp").state, LightState::reused);
    EXPECT_TRUE(depth_passes().empty());
    EXPECT_EQ(made("debug/depth.frag"), 1u) << "the program was made anew";
    EXPECT_EQ(frame->debug_labels().size(), 2u);
}

TEST_F(DebugViews, AViewOfLookupsBindsWhatTheLightsOwnPassDoesAndBlendsOverThePicture) {
    step();
    step();
    const gl::CommandList plain = frame->commands();
    for (const debug::ViewRow& row : debug::view_table()) {
        if (row.drawer->medium != debug::ViewMedium::lookups) continue;
        SCOPED_TRACE(row.name);
        settings.debug = {.view = &row, .light = "bulb", .area = {10, 20, 100, 50}};
        step();
        const std::vector<gl::Command> added = added_to(plain);
        std::vector<gl::Command> bound_here;
        for (const gl::Command& c : added) {
            if (std::holds_alternative<gl::BindTexture>(c)) bound_here.push_back(c);
            if (const auto* pass = std::get_if<gl::BeginPass>(&c)) {
                EXPECT_EQ(pass->target, frame->picture_target());
                EXPECT_FALSE(pass->clear_colour || pass->clear_depth);
            }
            if (const auto* scissor = std::get_if<gl::SetScissor>(&c)) {
                EXPECT_EQ(scissor->rect, settings.debug.area);
            }
            if (const auto* state = std::get_if<gl::SetPipeline>(&c)) {
                EXPECT_EQ(state->state.blend, gl::Blend::alpha);
            }
        }
        EXPECT_THAT(bound_here, ::testing::IsSubsetOf(plain.commands)) << "the light's own pass binds other textures";
        EXPECT_GE(bound_here.size(), 5u);
        EXPECT_FALSE(frame->debug_labels().empty());
    }
}

TEST_F(DebugViews, LinesAreOneDrawOverThePictureThatReadsItsDepths) {
    step();
    step();
    const gl::CommandList plain = frame->commands();
    settings.debug = {.view = debug::find_view("frusta"), .area = {10, 20, 100, 50}};
    step();
    const std::vector<gl::Command> added = added_to(plain);
    std::size_t draws = 0;
    for (const gl::Command& c : added) {
        if (const auto* lines = std::get_if<gl::DrawLines>(&c)) {
            ++draws;
            EXPECT_GE(lines->vertex_count, 24u);
            EXPECT_EQ(lines->vertex_count % 2, 0u);
        }
        if (const auto* storage = std::get_if<gl::BindStorage>(&c)) {
            EXPECT_EQ(storage->buffer.id, id_of("debug lines"));
        }
        if (const auto* scissor = std::get_if<gl::SetScissor>(&c)) {
            EXPECT_EQ(scissor->rect, settings.debug.area);
        }
        if (const auto* pass = std::get_if<gl::BeginPass>(&c)) {
            EXPECT_EQ(pass->target, frame->picture_target());
            EXPECT_FALSE(pass->clear_colour || pass->clear_depth);
        }
    }
    EXPECT_EQ(draws, 1u);
    EXPECT_EQ(made("debug/lines.frag"), 1u);
    settings.debug.view = debug::find_view("sets");
    settings.debug.light = "lamp";
    step();
    EXPECT_EQ(made("debug/lines.frag"), 1u) << "both views of lines share one program";
}

TEST_F(DebugViews, WithoutTheirProgramOrBufferLinesAndLookupsAreLeftOut) {
    for (const char* view : {"frusta", "texels"})
        for (std::uint64_t call = 0; call < 2; ++call) {
            SCOPED_TRACE(std::string(view) + " " + std::to_string(call));
            frame.reset();
            start();
            settings.debug = {};
            step();
            step();
            const gl::CommandList plain = frame->commands();
            device.fail_call(device.calls() + call, gl::Failure::out_of_memory);
            settings.debug = {.view = debug::find_view(view), .light = "lamp"};
            step();
            EXPECT_EQ(frame->commands(), plain);
            EXPECT_TRUE(frame->debug_labels().empty());
            device.stop_failing();
            for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
            EXPECT_FALSE(frame->debug_labels().empty()) << "it does not come back";
        }
}

TEST_F(DebugViews, ALightWithoutAMapIsNotLookedUpAndSaysWhy) {
    settings.shadows = false;
    settings.debug = {.view = debug::find_view("cascades"), .light = "lamp"};
    step();
    EXPECT_EQ(made("lookups"), 0u);
    ASSERT_EQ(frame->debug_labels().size(), 1u);
    EXPECT_THAT(frame->debug_labels().front().text, ::testing::HasSubstr(reason_code(Reason::shadows_off)));
}

TEST_F(DebugViews, ACubeIsBoundToTheCubesUnit) {
    step();
    step();
    const gl::CommandList plain = frame->commands();
    show("bulb");
    step();
    const std::vector<gl::Command> added = added_to(plain);
    const gl::BindTexture* bind = bound(added);
    ASSERT_TRUE(bind);
    EXPECT_EQ(bind->unit, 1u);
    EXPECT_EQ(device.texture(bind->texture)->kind, gl::TextureKind::cube);
}

TEST_F(DebugViews, TheAreaIsKeptWithinThePicture) {
    const auto viewport = [&](const gl::Rect& area) {
        show("lamp");
        settings.debug.area = area;
        step();
        gl::Rect last{};
        bool debug = false;
        for (const gl::Command& c : frame->commands().commands) {
            if (const auto* group = std::get_if<gl::BeginGroup>(&c)) debug = group->label == "debug depth";
            if (const auto* pass = std::get_if<gl::BeginPass>(&c); pass && debug) last = pass->viewport;
        }
        return last;
    };
    EXPECT_EQ(viewport({100, 50, 200, 100}), (gl::Rect{100, 50, 200, 100}));
    EXPECT_EQ(viewport({600, -20, 100, 100}), (gl::Rect{600, 0, 40, 80}));
    EXPECT_EQ(viewport({700, 0, 100, 100}), gl::Rect{});  // nothing of it is visible: nothing is drawn
    EXPECT_TRUE(frame->debug_labels().empty());
}

TEST_F(DebugViews, LightsWithoutAMapAndUnknownOnesHarmNothing) {
    settings.shadows = false;
    show("lamp");
    step();
    ASSERT_EQ(frame->debug_labels().size(), 1u);
    EXPECT_THAT(frame->debug_labels().front().text, ::testing::HasSubstr(reason_code(Reason::shadows_off)));
    show("nobody");
    step();
    EXPECT_TRUE(frame->debug_labels().empty());
}

TEST_F(DebugViews, WithoutItsSamplerProgramOrBufferTheFrameIsDeliveredWithoutTheView) {
    for (std::uint64_t call = 0; call < 3; ++call) {  // what a warm frame makes for its first view, in this order
        SCOPED_TRACE(call);
        frame.reset();
        start();
        settings.debug = {};
        step();
        step();
        const gl::CommandList plain = frame->commands();
        const std::size_t made_before = device.resource_calls().size();
        device.fail_call(device.calls() + call, gl::Failure::out_of_memory);
        show("lamp");
        step();
        EXPECT_EQ(frame->commands(), plain);
        EXPECT_TRUE(frame->debug_labels().empty());
        ASSERT_GT(device.resource_calls().size(), made_before + call);
        EXPECT_TRUE(device.resource_calls()[made_before + call].failed);
        device.stop_failing();
        for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
        EXPECT_FALSE(frame->debug_labels().empty()) << "it does not come back";
    }
}

}  // namespace
}  // namespace gnomon
