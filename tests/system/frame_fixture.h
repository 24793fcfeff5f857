#pragma once
#include <gmock/gmock.h>

#include <memory>

#include "systems/frame_system.h"
#include "systems/shadow/maps/map_cache.h"
#include "tests/system/passes.h"
#include "tests/system/test_world.h"

namespace gnomon {

/// A world and the real frame on a recording device. Every test ends by checking that nothing was misused and that,
/// with the frame gone, nothing is left on the device.
class FrameTest : public ::testing::Test {
protected:
    void SetUp() override { start(); }
    void TearDown() override {
        frame.reset();
        device.check_leaks();
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    void start() {
        auto made = FrameSystem::create(device, library);
        ASSERT_TRUE(made) << to_line(made.error());
        frame = std::move(made).value();
    }
    const FrameReport& step() {
        frame->run(world.registry, settings);
        return frame->report();
    }
    ecs::Entity add_light(LightKind kind, const std::string& name, ShadowFilter filter) {
        const ecs::Entity light = world.add_light(kind, kLightPlace_m, name);
        choose(light, filter);
        return light;
    }
    void choose(ecs::Entity light, ShadowFilter filter) {
        world.registry.patch<LightShadow>(light, [&](LightShadow& s) {
            s.filter = filter;
            s.resolution_px = 256;
        });
    }
    std::vector<Pass> passes() const { return passes_of(frame->commands(), device); }
    std::vector<Pass> depth_passes() const { return depth_passes_of(frame->commands(), device); }
    const LightReport& light(const std::string& name) const {
        static const LightReport kNone{};
        for (const LightReport& l : frame->report().lights)
            if (l.name == name) return l;
        ADD_FAILURE() << "no light " << name;
        return kNone;
    }
    /// Returns the instance slots that a pass draws, in order, from the device's buffer of draw items. `label`: that
    /// buffer, if the pass is no depth pass.
    std::vector<std::uint32_t> drawn_slots(const Pass& pass, const char* label = "shadow draw items") const {
        std::vector<std::uint32_t> slots;
        gl::BufferHandle items{};
        for (const gl::Command& c : frame->commands().commands) {
            const auto* bind = std::get_if<gl::BindMeshes>(&c);
            if (bind && device.buffer(bind->draw_items)->label == label) items = bind->draw_items;
        }
        const auto bytes = device.buffer_bytes(items);
        for (const gl::DrawMeshes& draw : pass.draws)
            for (std::uint32_t i = 0; i < draw.item_count; ++i) {
                std::uint32_t slot = 0;
                std::memcpy(&slot, bytes.data() + (draw.first_item + i) * 8, sizeof slot);
                slots.push_back(slot);
            }
        return slots;
    }
    std::uint32_t slot_of(ecs::Entity e) const {
        for (const InstanceItem& item : frame->snapshot().instances)
            if (item.entity == e) return item.gpu_slot;
        return 0xffffffffu;
    }

    gl::RecordingDevice device;
    assets::MeshLibrary library = test_library();
    TestWorld world;
    std::unique_ptr<FrameSystem> frame;
    static inline const FrameSettings kSettings{{640, 360}, {}, true, false};
    FrameSettings settings = kSettings;
};

}  // namespace gnomon
