#include "tests/gl/traced_frame_fixture.h"

/// Tests which faces of a caster are in the map. An unseen box hides a card. Light that reaches the card has passed the
/// box's near side, so that only its far side can be in the map. The ground below is dark either way.
namespace gnomon {
namespace {

constexpr double kCardHeight_m = 1.5;
constexpr double kHalfHeight_m = 4.0;
constexpr glm::dvec3 kCardLightAt_m{0.3, 9.0, 0.2};

class CasterFacesGl : public TracedFrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    void SetUp() override {
        TracedFrameTest::SetUp();
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 16.0}, {16.0, 0.0, 0.0})), {}, false);
        place(add_mesh(game::make_card({0.0, kCardHeight_m, 0.0}, {0.0, 0.0, 0.6}, {0.6, 0.0, 0.0})), {}, false);
        add_camera({.projection = CameraProjection::orthographic,
                    .half_height_m = kHalfHeight_m,
                    .near_m = 0.1,
                    .far_m = 30.0},
                   {0.0, 20.0, 0.0}, {0.0, -1.0, 0.0});
    }
    /// Places an unseen box around the card, 2 m wide times `scale`.
    ecs::Entity hide_card_in(std::uint32_t mesh, const glm::dvec3& scale = glm::dvec3(1.0)) {
        const ecs::Entity e = place(mesh, {.translation_m = {0.0, kCardHeight_m, 0.0}, .scale = scale});
        world.patch<MeshRef>(e, [](MeshRef& m) { m.visible = false; });
        return e;
    }
    std::uint32_t closed_box() { return add_analysed(game::make_box(glm::dvec3(-1.0), glm::dvec3(1.0))); }
    /// Adds the mesh of closed_box() without its top.
    std::uint32_t open_box() {
        game::Shape shape = game::make_box(glm::dvec3(-1.0), glm::dvec3(1.0));
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < shape.indices.size(); i += 3)
            if (!(shape.normals[shape.indices[i]].y > 0.5f))
                kept.insert(kept.end(), shape.indices.begin() + static_cast<std::ptrdiff_t>(i),
                            shape.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
        shape.indices = kept;
        return add_analysed(shape);
    }
    void set_faces(CasterFaces faces) {
        world.patch<LightShadow>(lamp, [&](LightShadow& s) { s.caster_faces = faces; });
        draw();
    }
    /// Returns the visibility at a place, on the surface that the camera sees there.
    float light_at(double x_m) {
        const glm::uvec2 size = settings.viewport_px;
        const double pixel_m = 2.0 * kHalfHeight_m / size.y;
        const auto column = static_cast<std::size_t>(size.x / 2.0 + x_m / pixel_m);
        return visibility()[std::size_t{size.y} / 2 * size.x + column];
    }
    float on_card() { return light_at(0.05); }
    float beside_card() { return light_at(0.65); }  // the ground under the box
    float in_the_open() { return light_at(3.0); }
    void add_lamp() { lamp = add_light_of(GetParam(), kCardLightAt_m, {.resolution_px = 512}); }

    ecs::Entity lamp;
};

INSTANTIATE_TEST_SUITE_P(Kinds, CasterFacesGl,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(CasterFacesGl, AreTheOnesAskedForWhereTheMeshIsClosed) {
    const ecs::Entity box = hide_card_in(closed_box());
    add_lamp();
    for (const glm::dvec3& scale : {glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 1), glm::dvec3(1, -1, 1),
                                    glm::dvec3(-1, -1, 1), glm::dvec3(-1, -1, -1)}) {
        world.patch<Transform>(box, [&](Transform& t) { t.scale = scale; });
        for (const CasterFaces faces :
             {CasterFaces::automatic, CasterFaces::front, CasterFaces::back, CasterFaces::both}) {
            set_faces(faces);
            SCOPED_TRACE("faces " + std::to_string(static_cast<int>(faces)) + ", scale " + std::to_string(scale.x) +
                         " " + std::to_string(scale.y) + " " + std::to_string(scale.z));
            EXPECT_EQ(on_card(), faces == CasterFaces::back ? 1.0f : 0.0f);
            EXPECT_EQ(beside_card(), 0.0f);
            EXPECT_EQ(in_the_open(), 1.0f);
        }
    }
}

TEST_P(CasterFacesGl, AreBothOfAnOpenMeshWhateverIsAskedFor) {
    hide_card_in(open_box());
    add_lamp();
    for (const CasterFaces faces : {CasterFaces::automatic, CasterFaces::front, CasterFaces::back, CasterFaces::both}) {
        set_faces(faces);
        EXPECT_EQ(on_card(), 1.0f) << "light falls through the missing top";
        EXPECT_EQ(beside_card(), 0.0f) << "the floor of the box, a front or a back face, is in the way";
    }
}

TEST_P(CasterFacesGl, AreBothOfASingleSheetFromEitherSide) {
    // A sheet above the card, facing down: its back is all that the light sees.
    const std::uint32_t sheet = add_analysed(game::make_card(glm::dvec3(0.0), {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0}));
    const ecs::Entity e = hide_card_in(sheet);
    world.patch<Transform>(e, [](Transform& t) { t.translation_m.y = 2.5; });
    add_lamp();
    for (const CasterFaces faces : {CasterFaces::automatic, CasterFaces::front, CasterFaces::back, CasterFaces::both}) {
        set_faces(faces);
        EXPECT_EQ(on_card(), 0.0f);
        EXPECT_EQ(in_the_open(), 1.0f);
    }
}

TEST_P(CasterFacesGl, AreBothOfClosedMeshesThatAreDoubleSided) {
    const std::uint32_t both_sides = add_material({.name = "both sides", .metallic = 0.0f, .double_sided = true});
    hide_card_in(add_analysed(game::make_box(glm::dvec3(-1.0), glm::dvec3(1.0)), both_sides));
    add_lamp();
    set_faces(CasterFaces::back);
    EXPECT_EQ(on_card(), 0.0f);
}

TEST_P(CasterFacesGl, AreThoseOfEachInstanceAmongMirroredOnesOfItsMesh) {
    const std::uint32_t box = closed_box();
    hide_card_in(box);
    for (int i = 0; i < 6; ++i)
        place(box, {.translation_m = {8.0 + 3.0 * i, 1.0, 0.0}, .scale = {i % 2 == 0 ? -1.0 : 1.0, 1.0, 1.0}});
    add_lamp();
    for (const CasterFaces faces : {CasterFaces::front, CasterFaces::back}) {
        set_faces(faces);
        EXPECT_EQ(on_card(), faces == CasterFaces::back ? 1.0f : 0.0f);
        EXPECT_EQ(beside_card(), 0.0f);
    }
}

}  // namespace
}  // namespace gnomon
