#include "tests/gl/embed_fixture.h"
#include "tests/gl/lookup_pass.h"

// One program of the engine's looks up all lights, beside the masks of the same frame.
namespace gnomon {
namespace {

class EmbedLookup : public EmbedTest {
protected:
    ShadowsOptions options() override {
        ShadowsOptions wanted = EmbedTest::options();
        wanted.lookup = lookup_of_triangles();
        return wanted;
    }
    void SetUp() override {
        EmbedTest::SetUp();
        make_engine(Depths::usual_float);
        view.normal_texture = engine->normals;
        add_room();
        look_from({0.5, 2.5, 4.0});
    }
    /// Returns the casters that the fixture added, each with the mesh of the same number.
    std::vector<CasterId> casters_of_room() const {
        std::vector<CasterId> casters;
        for (std::uint32_t i = 0; i < room.size(); ++i) casters.push_back({i, 1});
        return casters;
    }
};

TEST_F(EmbedLookup, ShowsWhatTheMaskShowsForAnyNumberOfLights) {
    std::vector<LightId> lights{add_shadowed(LightKind::directional, {1.5, 3.0, 1.0})};
    lights.push_back(add_shadowed(LightKind::spot, {-1.5, 3.0, 1.0}));
    lights.push_back(add_shadowed(LightKind::point, {0.5, 2.5, 2.0}));
    const auto text = shadows->lookup_glsl();
    ASSERT_TRUE(text) << to_line(text.error());
    const LookupPass pass(text.value());
    for (int more = 0; more < 2; ++more) {
        draw_depths(view, *engine);
        const Mask mask = shadows->render(view);
        ASSERT_EQ(mask.layers, lights.size());
        ASSERT_TRUE(shadows->bind_lookup());
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            const std::vector<std::uint8_t> of_mask = layer_of(mask, i);
            const std::vector<std::uint8_t> of_text = pass.drawn(*engine, view, shadows->lookup_index(lights[i]));
            EXPECT_LT(differing(of_mask, of_text), kFewPixels) << "light " << i << ": " << shadows->lookup_status(lights[i]);
            EXPECT_GT(std::count(of_text.begin(), of_text.end(), 255), 5000);
            const int next = shadows->lookup_index(lights[(i + 1) % lights.size()]);
            EXPECT_GT(differing(of_mask, pass.drawn(*engine, view, next)), 1000u) << "control: another light";
        }
        // Lights come; the program stays.
        for (int k = 0; k < 5; ++k) lights.push_back(add_shadowed(k % 2 == 0 ? LightKind::spot : LightKind::point, {0.6 * k - 1.0, 2.5, 1.1 - 0.43 * k}));
        EXPECT_EQ(shadows->lookup_glsl().value(), text.value());
    }
}

TEST_F(EmbedLookup, ShowsEachViewTheCastersOfItsLayers) {
    const LightId lamp = add_shadowed(LightKind::spot, {-1.5, 3.0, 1.0});
    const LookupPass pass(shadows->lookup_glsl().value());
    const auto lone = shadows->add_mesh({.positions_m = game::make_box({-1.0, 1.0, 0.5}, {-0.5, 1.5, 1.0}).positions,
                                         .indices = game::make_box({-1.0, 1.0, 0.5}, {-0.5, 1.5, 1.0}).indices});
    for (const CasterId caster : casters_of_room()) shadows->set_caster(caster, {.mesh = {caster.index, caster.version}, .cast_layers = 1});
    shadows->add_caster({.mesh = lone.value(), .receives = false, .cast_layers = 2});
    draw_depths(view, *engine);
    View other = view;
    other.cast_layers = 1;
    const View both[] = {view, other};
    std::vector<std::vector<std::uint8_t>> of_masks, of_text;
    for (const Mask& mask : shadows->render(both)) of_masks.push_back(layer_of(mask, 0));
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_TRUE(shadows->bind_lookup(i));
        of_text.push_back(pass.drawn(*engine, view, shadows->lookup_index(lamp)));
        EXPECT_LT(differing(of_masks[i], of_text[i]), kFewPixels) << "view " << i << ": " << shadows->lookup_status(lamp, i);
    }
    EXPECT_GT(differing(of_text[0], of_text[1]), 300u);
}

TEST_F(EmbedLookup, LooksUpPlacesInTheAir) {
    const LightId lamp = add_shadowed(LightKind::point, {0.5, 2.5, 2.0});
    const LookupPass pass(shadows->lookup_glsl().value());
    draw_depths(view, *engine);
    shadows->render(view);
    ASSERT_TRUE(shadows->bind_lookup());
    const std::vector<std::uint8_t> air = pass.drawn(*engine, view, shadows->lookup_index(lamp), true);
    EXPECT_GT(std::count(air.begin(), air.end(), 255), 10000);
    EXPECT_GT(std::count(air.begin(), air.end(), 0), 1000);
}

TEST_F(EmbedLookup, NeedsNoMask) {
    const LightId lamp = add_shadowed(LightKind::spot, {1.5, 3.0, 1.0});
    const LookupPass pass(shadows->lookup_glsl().value());
    draw_depths(view, *engine);
    const std::vector<std::uint8_t> of_mask = layer_of(shadows->render(view), 0);
    View without = view;
    without.wants_mask = false;
    without.depth_texture = without.normal_texture = 0;
    const Mask none = shadows->render(without);
    EXPECT_EQ(none.failure, "");
    EXPECT_EQ(none.texture, 0u);
    ASSERT_TRUE(shadows->bind_lookup());
    EXPECT_LT(differing(of_mask, pass.drawn(*engine, view, shadows->lookup_index(lamp))), kFewPixels);
}

TEST_F(EmbedLookup, SaysWhatItCannot) {
    auto plain = Shadows::create();
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain.value()->lookup_glsl().error().rule, "lookup.off");
    EXPECT_FALSE(plain.value()->bind_lookup());
    EXPECT_FALSE(shadows->bind_lookup()) << "before the first render()";
    EXPECT_EQ(shadows->lookup_index(LightId{}), -1);
    auto few = Shadows::create({.lookup = LookupOptions{.texture_unit_count = 2}});
    ASSERT_TRUE(few);
    EXPECT_EQ(few.value()->lookup_glsl().error().rule, "lookup.bindings");
}

}  // namespace
}  // namespace gnomon
