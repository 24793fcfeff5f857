#include "systems/shadow/culling/static_dynamic_casters.h"
#include "tests/gl/traced_frame_fixture.h"

/// What is kept of a map while others move must be what drawing it again would give, bit for bit.
namespace gnomon {
namespace {

constexpr int kFrames = 6;

/// What moves, and whether maps are kept.
enum class Change { one_moves, all_are_touched, nothing_is_kept };

class MovedCasters : public TracedFrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    void make_world(const LightShadow& shadow) {
        const std::uint32_t box = add_analysed(game::make_box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}));
        twin = add_analysed(game::make_box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}));
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 16.0}, {16.0, 0.0, 0.0})), {}, false);
        for (int i = 0; i < 5; ++i) still.push_back(place(box, {.translation_m = {1.3 * i - 2.6, 0.8, -1.0}}));
        still.push_back(place(box, {.translation_m = {-6.0, 0.8, -1.0}}));  // a point light's other face
        mover = place(box, {.translation_m = {0.0, 0.7, 1.2}});
        lamp = add_light_of(GetParam(), {1.0, 5.0, 0.5}, shadow);
        add_camera({.fov_y_rad = 1.0}, {0.0, 7.0, 6.0}, {0.0, -7.0, -6.0});
    }
    /// Moves one caster in every other frame. In `all_are_touched` every caster becomes its twin, or itself again, in
    /// each frame. For a map that is as if it had moved.
    void step(int frame_index, Change change) {
        world.patch<Transform>(mover, [&](Transform& t) { t.translation_m.x = 0.3 * (frame_index / 2); });
        if (change == Change::all_are_touched)
            for (const ecs::Entity e : casters())
                world.patch<MeshRef>(e, [&](MeshRef& m) { m.mesh = m.mesh == twin ? twin - 1 : twin; });
        edit_light(world, lamp, [&](ShadowTuning& t) { t.reuse.economy = change != Change::nothing_is_kept; });
        draw();
    }
    std::vector<ecs::Entity> casters() const {
        std::vector<ecs::Entity> all = still;
        all.push_back(mover);
        return all;
    }
    struct Walk {
        std::vector<std::vector<float>> visibility;  // one per frame
        std::uint32_t views = 0, drawn = 0, cleared = 0;
    };
    Walk walk(Change change) {
        Walk result;
        step(0, change);
        for (int i = 0; i < kFrames; ++i) {
            step(i, change);
            result.visibility.push_back(visibility());
            result.views += frame().report().lights.at(0).counts.views;
            result.drawn += frame().report().lights.at(0).counts.views_drawn;
            result.cleared += frame().report().lights.at(0).counts.clears;
        }
        return result;
    }
    std::uint32_t twin = 0;  // looks like the mesh before it
    ecs::Entity mover, lamp;
    std::vector<ecs::Entity> still;
};

INSTANTIATE_TEST_SUITE_P(Kinds, MovedCasters,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(MovedCasters, AmongStillOnesGiveTheBitsOfAllMovingAndOfNothingKept) {
    make_world({.resolution_px = 512});
    const bool is_sun = GetParam() == LightKind::directional;
    for (const ShadowFit fit : {ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised}) {
        if (fit != ShadowFit::tight && !is_sun) continue;
        edit_light(world, lamp, [&](ShadowTuning& t) { t.cascades.fit = fit; });
        walk(Change::one_moves);  // makes fit histories the same for all
        const Walk kept = walk(Change::one_moves);
        EXPECT_GT(kept.drawn, 0u);
        EXPECT_LT(kept.drawn, kept.views) << "some maps were kept, or this shows nothing";
        EXPECT_NE(kept.visibility.front(), kept.visibility.back()) << "the shadow moved";
        for (const Change change : {Change::all_are_touched, Change::nothing_is_kept}) {
            const Walk anew = walk(change);
            EXPECT_GT(anew.drawn, kept.drawn);
            if (change == Change::nothing_is_kept) {
                EXPECT_EQ(anew.drawn, anew.views);
            }
            for (std::size_t i = 0; i < kFrames; ++i)
                EXPECT_EQ(anew.visibility[i], kept.visibility[i]) << "frame " << i;
        }
    }
}

TEST_P(MovedCasters, DrawnOverACopyOfStillOnesGiveTheBitsOfAllDrawnInEveryKindOfMap) {
    // So few texels that copying them is less than drawing a box or two.
    make_world({.resolution_px = 32});
    int moved = 0;
    for (const ShadowFilter filter : {ShadowFilter::hardware_2x2, ShadowFilter::triangles, ShadowFilter::vsm}) {
        world.patch<LightShadow>(lamp, [&](LightShadow& s) { s.filter = filter; });
        step(0, Change::one_moves);
        for (std::uint64_t i = 0; i < shadow::DynamicCasters::kStaticFrames; ++i) draw();  // all stand still
        walk(Change::one_moves);
        const Walk kept = walk(Change::one_moves);
        EXPECT_LT(kept.cleared, kept.drawn) << "some were drawn over a copy, or this shows nothing";
        moved += kept.visibility.front() != kept.visibility.back() ? 1 : 0;
        for (const Change change : {Change::nothing_is_kept, Change::all_are_touched}) {
            const Walk anew = walk(change);
            EXPECT_EQ(anew.cleared, anew.drawn);
            for (std::size_t i = 0; i < kFrames; ++i)
                EXPECT_EQ(anew.visibility[i], kept.visibility[i]) << "frame " << i << " of filter " << int(filter);
        }
    }
    EXPECT_GE(moved, 2) << "a sun's moments are blurred too far to show it with so few texels";
}

}  // namespace
}  // namespace gnomon
