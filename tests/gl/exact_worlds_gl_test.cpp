#include <cstdio>
#include <random>

#include "tests/gl/gutter.h"
#include "tests/gl/traced_frame_fixture.h"
#include "tests/oracle/exactness.h"

// filter=exact on small worlds that maps find hard, for each kind of light, against rays in double.
namespace gnomon {
namespace {

constexpr double kMostAmbiguousOfWorld = 0.001;
constexpr std::size_t kLeast = 200;  // pixels that are lit, and that are dark: of fewer nothing is learnt

class ExactWorlds : public TracedFrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    void SetUp() override {
        TracedFrameTest::SetUp();
        add_material({.name = "matt", .metallic = 0.0f, .double_sided = true});
    }
    std::uint32_t box(const glm::dvec3& low, const glm::dvec3& high) { return add_mesh(game::make_box(low, high)); }
    void add_ground(bool casts = true) {
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 8.0}, {8.0, 0.0, 0.0})), {.translation_m = at},
              casts);
    }
    void look() {
        const glm::dvec3 eye(0.9, 3.2, 4.1);
        add_camera({.fov_y_rad = 0.9, .near_m = 0.05}, at + eye, -eye);
    }
    ecs::Entity shine(const LightShadow& shadow = {.filter = ShadowFilter::exact}) {
        const glm::dvec3 from(1.7, 4.0, -1.3);
        return add_light({.kind = GetParam(), .intensity = 1000.0f, .range_m = 0.0f, .outer_cone_rad = 1.0f}, at + from,
                         -from, shadow);
    }
    /// Makes two quads of the plane z = 3.5 x + 1.5 y, with corners that floats represent exactly. One lies upon a part
    /// of the other.
    static game::Shape slanted_quads() {
        game::Shape shape;
        const auto add_quad = [&shape](float low, float high) {
            const auto first = static_cast<std::uint32_t>(shape.positions.size());
            for (const glm::vec2 corner : {glm::vec2(low, low), {high, low}, {low, high}, {high, high}}) {
                shape.positions.emplace_back(corner.x, corner.y, 3.5f * corner.x + 1.5f * corner.y);
                shape.normals.push_back(glm::normalize(glm::vec3(-3.5f, -1.5f, 1.0f)));
                shape.uvs.emplace_back(0.0f);
            }
            for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) shape.indices.push_back(first + corner);
        };
        add_quad(-1.0f, 1.0f);
        add_quad(-0.375f, 0.5f);
        return shape;
    }
    oracle::Exactness judged(const SceneSnapshot& claimed, std::uint32_t light = 0) {
        const ConsumerItem& camera = claimed.consumers.at(0);
        const oracle::ReferenceTracer tracer(claimed, library, camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        const oracle::LightTruth truth = tracer.trace_light(hits, claimed.lights.at(light), true);
        return oracle::exactness(tracer, hits, camera, truth, visibility(light));
    }
    oracle::Exactness judged() { return judged(frame().snapshot()); }
    void expect_exact(const oracle::Exactness& found, double most_ambiguous = kMostAmbiguousOfWorld) {
        EXPECT_EQ(found.wrong, 0u) << "of " << found.scored;
        EXPECT_LE(static_cast<double>(found.ambiguous), most_ambiguous * static_cast<double>(found.scored));
        EXPECT_GT(found.lit, kLeast);
        EXPECT_GT(found.dark, kLeast);
        RecordProperty("ambiguous", static_cast<int>(found.ambiguous));
        RecordProperty("other_surface", static_cast<int>(found.other_surface));
    }
    glm::dvec3 at{0.0};
};

INSTANTIATE_TEST_SUITE_P(Kinds, ExactWorlds,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

/// Places wires of 1 to 6 mm, and boxes that run into each other, stand on each other and touch face to face. Adds a
/// sheet, needles and triangles without area.
TEST_P(ExactWorlds, WiresContactsAndWhatRunsIntoEachOtherAreTheTruth) {
    add_ground();
    for (int i = 0; i < 6; ++i) {
        const double half_m = 0.0005 * (i + 1), x = -1.5 + 0.5 * i;
        place(box({x - half_m, 0.0, -half_m}, {x + half_m, 1.2, half_m}));
        place(box({-1.5, 1.2 - 0.1 * i, -half_m}, {1.0, 1.2 - 0.1 * i + 2.0 * half_m, half_m}));
    }
    place(box({-1.0, 0.0, -1.4}, {0.0, 0.5, -0.6}));
    place(box({-0.6, -0.3, -1.1}, {0.4, 0.9, -0.8}), {.rotation = glm::angleAxis(0.3, glm::dvec3(0.0, 0.0, 1.0))});
    place(box({0.6, 0.0, -1.2}, {1.0, 0.4, -0.8}));
    place(box({1.0, 0.0, -1.2}, {1.4, 0.4, -0.8}));
    place(box({0.7, 0.4, -1.1}, {1.2, 0.7, -0.9}));
    place(add_mesh(game::make_card({-1.4, 0.6, 1.0}, {0.0, 0.1, 0.5}, {0.5, 0.2, 0.0})));
    game::Shape needles = game::make_card({1.2, 0.3, 1.0}, {0.0, 0.0, 0.6}, {0.001, 0.5, 0.0});
    needles.positions[1] = needles.positions[0];
    place(add_mesh(needles));
    look();
    shine();
    draw();
    expect_exact(judged(), 0.002);  // wires are narrower than pixels: there are edges in every one
}

TEST_P(ExactWorlds, MirroredStretchedAndTurnedInstancesAreTheTruthHereAndFarAway) {
    for (const double far_m : {0.0, 1.0e8}) {
        SCOPED_TRACE(far_m);
        start_anew();
        add_material({.name = "matt", .metallic = 0.0f, .double_sided = true});
        at = {far_m, -0.5 * far_m, 0.25 * far_m};
        add_ground();
        const std::uint32_t wedge = box({0.1, 0.0, -0.2}, {0.9, 0.7, 0.5});
        const glm::dquat turn = glm::angleAxis(0.8, glm::normalize(glm::dvec3(0.3, 1.0, -0.4)));
        place(wedge, {.translation_m = at, .scale = {-1.0, 1.0, 1.0}});
        place(wedge, {.translation_m = at + glm::dvec3(0.6, 0.2, 0.4), .rotation = turn, .scale = {0.4, 2.5, -0.7}});
        place(wedge,
              {.translation_m = at + glm::dvec3(-1.0, 0.1, -1.3), .rotation = turn, .scale = {1.0e-3, 1.2, 1.0}});
        look();
        shine();
        draw();
        expect_exact(judged());
    }
}

TEST_P(ExactWorlds, MaskedCastersCutTheirShadowsOut) {
    constexpr std::uint32_t kTexels = 32;
    std::mt19937 random(7);
    for (const bool linear : {true, false}) {
        SCOPED_TRACE(linear ? "linear" : "nearest");
        start_anew();
        add_material({.name = "matt", .metallic = 0.0f, .double_sided = true});
        assets::Texture leaves;
        leaves.name = "leaves";
        leaves.width = leaves.height = kTexels;
        for (std::uint32_t i = 0; i < kTexels * kTexels; ++i)
            leaves.rgba.insert(leaves.rgba.end(), {90, 160, 60, static_cast<std::uint8_t>(random() % 256)});
        leaves.wrap_u = linear ? assets::TextureWrap::repeat : assets::TextureWrap::clamp;
        leaves.wrap_v = linear ? assets::TextureWrap::mirror : assets::TextureWrap::repeat;
        leaves.linear_filter = linear;
        library.textures.push_back(leaves);
        game::Shape card = game::make_card({0.0, 1.0, 0.0}, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0});
        for (glm::vec2& uv : card.uvs) uv = uv * 2.3f - 0.4f;
        const std::uint32_t material = add_material({.name = "leaves",
                                                     .base_colour_texture = 0,
                                                     .metallic = 0.0f,
                                                     .alpha_mode = assets::AlphaMode::mask,
                                                     .double_sided = true});
        add_ground();
        const ecs::Entity canopy = place(add_mesh(card, material));
        world.patch<MeshRef>(canopy, [](MeshRef& m) { m.visible = false; });
        look();
        shine();
        draw();
        expect_exact(judged(), 0.002);  // an edge in most pixels below the leaves
        EXPECT_GT(frame().report().rays.bytes, 0u);
    }
}

TEST_P(ExactWorlds, LayersAndThoseWhoDoNotCastOrReceiveAreKept) {
    add_ground(false);
    const ecs::Entity other = place(box({-1.2, 0.3, -0.4}, {-0.4, 1.0, 0.4}));
    const ecs::Entity ghost = place(box({0.2, 0.3, 0.6}, {0.8, 0.9, 1.2}));
    const ecs::Entity own = place(box({0.2, 0.3, -0.9}, {1.0, 1.1, -0.2}));
    world.patch<ShadowCaster>(other, [](ShadowCaster& c) { c.layers = 2; });
    world.patch<ShadowCaster>(own, [](ShadowCaster& c) { c.layers = 5; });
    world.remove<ShadowCaster>(ghost);
    look();
    shine({.filter = ShadowFilter::exact, .layers = 4});
    draw();
    expect_exact(judged());
    // Negative control: as if all cast under it.
    SceneSnapshot claimed = frame().snapshot();
    for (InstanceItem& item : claimed.instances) item.cast_layers = 0xff;
    EXPECT_GT(judged(claimed).wrong, kLeast);
}

TEST_P(ExactWorlds, WhatMovedIsWhereItIs) {
    add_ground();
    const ecs::Entity moved = place(box({-0.4, 0.2, -0.4}, {0.4, 0.9, 0.4}));
    look();
    shine();
    draw();
    const SceneSnapshot before = frame().snapshot();
    for (const double x : {0.5, -0.7, 30.0, 0.2}) {
        world.patch<Transform>(moved, [&](Transform& t) { t.translation_m = {x, 0.1, 0.0}; });
        draw();
        const oracle::Exactness found = judged();
        EXPECT_EQ(found.wrong, 0u) << x;
        EXPECT_GT(judged(before).wrong, kLeast) << x << ": the picture does not tell where it is";
    }
}

/// Bends facets so little that beside the terminator a receiver lies behind its neighbour's plane by less than a float
/// resolves. Its place comes from the triangle's own plane in double, and the basis is the same.
TEST_P(ExactWorlds, FacetsThatHardlyBendDarkenTheirNeighbours) {
    for (const double turn : {0.0, 0.7}) {
        start_anew();
        const glm::dquat rotation = glm::angleAxis(turn, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
        place(add_mesh(gutter_shape(2000, 0.2f)), {.translation_m = at, .rotation = rotation});
        const glm::dvec3 eye = rotation * glm::dvec3(0.05, 0.5, 0.2), target = rotation * glm::dvec3(0.05, -0.45, 0.0);
        const glm::dvec3 from = rotation * glm::dvec3(6.0, 3.0, 1.0);
        add_camera({.fov_y_rad = 0.6, .near_m = 0.05}, at + eye, target - eye);
        add_light({.kind = GetParam(), .intensity = 1000.0f, .range_m = 0.0f, .outer_cone_rad = 1.0f}, at + from, -from,
                  {.filter = ShadowFilter::exact});
        draw();
        SCOPED_TRACE(turn);
        expect_exact(judged());
    }
}

/// Draws two quads in one plane. A place from a normal that was rounded to floats would lie off that plane, behind the
/// other quad.
TEST_P(ExactWorlds, FacesThatAreOneDoNotDarkenEachOther) {
    constexpr std::uint32_t kFew_px = 64;  // texels as wide as the bars are apart: rays for most
    const glm::dquat rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
    const glm::dvec3 normal = rotation * glm::normalize(glm::dvec3(-3.5, -1.5, 1.0));
    place(add_mesh(slanted_quads()), {.translation_m = at, .rotation = rotation});
    for (int i = -4; i <= 4; ++i)
        place(box({-2.0, -0.02, 0.2 * i - 0.02}, {2.0, 0.02, 0.2 * i + 0.02}), {.translation_m = at + 0.6 * normal});
    const glm::dvec3 eye = 3.0 * normal + rotation * glm::dvec3(1.0, 0.0, 1.0);
    const glm::dvec3 from = 4.0 * normal + rotation * glm::dvec3(0.5, 1.0, 0.0);
    add_camera({.fov_y_rad = 0.9, .near_m = 0.05}, at + eye, -eye);
    add_light({.kind = GetParam(), .intensity = 1000.0f, .range_m = 0.0f, .outer_cone_rad = 1.0f}, at + from, -from,
              {.filter = ShadowFilter::exact, .resolution_px = kFew_px});
    draw();
    expect_exact(judged());
}

}  // namespace
}  // namespace gnomon
