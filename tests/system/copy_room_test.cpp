#include "systems/shadow/update/static_caster_copy.h"
#include "tests/system/frame_fixture.h"

/// Copies of static casters under a limit on bytes: where one saves much, the maps of all leave it room.
namespace gnomon {
namespace {

constexpr std::uint32_t kMap_px = 512;
constexpr int kLamps = 16;

class CopyRoom : public FrameTest {
protected:
    /// Makes a field of boxes of `triangles` each, lamps over plain boxes beside it, a sun, and a caster that moves.
    void make(std::size_t triangles) {
        assets::Mesh fine = library.meshes[kBox];
        const std::vector<std::uint32_t> box = fine.indices;
        while (fine.indices.size() < 3 * triangles) fine.indices.insert(fine.indices.end(), box.begin(), box.end());
        fine.submeshes = {{0, static_cast<std::uint32_t>(fine.indices.size()), 0}};
        const auto mesh = static_cast<std::uint32_t>(library.meshes.size());
        library.meshes.push_back(std::move(fine));
        FrameTest::start();
        world.add_stage();
        for (int i = 0; i < kBoxes; ++i) world.add_mesh(mesh, {-9.0 + 1.2 * (i % 6), 1.0, 1.2 * (i / 6) - 3.0}, true);
        mover = world.add_mesh(kBox, {0.0, 3.0, 0.0}, true);
        add_sized(LightKind::directional, {3.0, 9.0, 2.0}, "sun");
        for (int i = 0; i < kLamps; ++i) {
            const glm::dvec3 at_m(3.0 + 1.6 * (i % 4), 0.6, 1.6 * (i / 4) - 3.0);
            world.add_mesh(kBox, at_m, true);
            const ecs::Entity lamp =
                add_sized(LightKind::spot, at_m + glm::dvec3(0.0, 3.0, 0.0), "lamp" + std::to_string(i));
            world.registry.patch<Transform>(lamp, [](Transform& t) {
                t.rotation = {0.70710678118654752, -0.70710678118654752, 0, 0};  // straight down
            });
            world.registry.patch<Light>(lamp, [](Light& l) { l.outer_cone_rad = 0.3f, l.inner_cone_rad = 0.2f; });
        }
        world.look_lights_up();  // kept visibility takes what is left
    }
    ecs::Entity add_sized(LightKind kind, const glm::dvec3& at_m, const std::string& name) {
        const ecs::Entity light = world.add_light(kind, at_m, name);
        world.registry.patch<LightShadow>(light, [](LightShadow& s) { s.resolution_px = kMap_px; });
        return light;
    }
    void play(int frames) {
        for (int i = 0; i < frames; ++i) {
            world.move(mover, {0.0, 3.0 + 0.001 * ++moves, 0.0});
            step();
        }
    }
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const LightReport& l : frame->report().lights) sum += l.counts.bytes;
        return sum;
    }
    int shrunk() const {
        int lights = 0;
        for (const LightReport& l : frame->report().lights) lights += l.reason == Reason::budget_shrunk ? 1 : 0;
        return lights;
    }
    void SetUp() override {}  // the library comes first

    static constexpr int kBoxes = 36;
    static constexpr std::size_t kFine = 60'000;  // triangles of a box; all have two million
    ecs::Entity mover;
    int moves = 0;
};

TEST_F(CopyRoom, IsLeftByTheMapsOfAllToASunThatSavesMuch) {
    make(kFine);
    settings.shadow_budget.bytes = shadow::ShadowBudget::kUnlimited;
    play(5);
    const std::uint64_t all = bytes(), copy = light("sun").counts.parts.static_copies;
    ASSERT_GT(copy, 0u) << "without a limit there is a copy";
    ASSERT_LT(light("sun").counts.triangles, 1000u);
    settings.shadow_budget.bytes = all - copy;  // as much as the maps alone take
    ASSERT_LT(copy, settings.shadow_budget.bytes / 4);
    play(70);
    EXPECT_EQ(light("sun").counts.parts.static_copies, copy);
    EXPECT_LT(light("sun").counts.triangles, 1000u) << "the mover alone is drawn";
    EXPECT_GT(shrunk(), 0);
    EXPECT_LE(bytes(), settings.shadow_budget.bytes);
    // It stays so while nothing moves, and maps do not change with it.
    const std::uint64_t maps = bytes() - copy;
    for (int i = 0; i < 100; ++i) step();
    EXPECT_EQ(light("sun").counts.parts.static_copies, 0u);
    EXPECT_EQ(bytes(), maps);
    EXPECT_GT(shrunk(), 0);
}

TEST_F(CopyRoom, IsNotLeftToOneThatSavesLittleOrDoesNotFit) {
    make(kFine / 60);  // 36 000 triangles
    play(5);
    const std::uint64_t copy = light("sun").counts.parts.static_copies;
    ASSERT_GT(copy, 0u) << "without a limit that binds there is a copy";
    settings.shadow_budget.bytes = bytes() - copy;
    play(70);
    EXPECT_EQ(shrunk(), 0) << "the limit has room for all maps";
}

TEST_F(CopyRoom, IsNotLeftToOneOfMoreThanAQuarter) {
    make(kFine);
    play(5);
    const std::uint64_t copy = light("sun").counts.parts.static_copies;
    settings.shadow_budget.bytes = 3 * copy;
    play(70);
    EXPECT_EQ(light("sun").counts.parts.static_copies, 0u);
    EXPECT_LE(bytes(), settings.shadow_budget.bytes);
}

}  // namespace
}  // namespace gnomon
