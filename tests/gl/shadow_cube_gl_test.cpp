#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/gl/room_fixture.h"

// A point light amid a room: every face of its cube and every seam between them.
namespace gnomon {
namespace {

constexpr double kRoomHalf_m = 4.0;
constexpr std::size_t kSomeOfFace = 200;

class ShadowCube : public RoomTest {
protected:
    /// Adds a camera near the wall behind, aside of the light so that casters do not hide their shadows.
    void look(const glm::dvec3& direction) {
        const glm::dvec3 aside(direction.y + direction.z, direction.z + direction.x, direction.x + direction.y);
        add_camera({.fov_y_rad = 1.6}, -0.85 * kRoomHalf_m * direction + 0.5 * kRoomHalf_m * aside, direction);
    }
};

class ShadowCubeAlong : public ShadowCube, public ::testing::WithParamInterface<int> {
protected:
    static glm::dvec3 direction() {
        glm::dvec3 d(0.0);
        d[GetParam() / 2] = GetParam() % 2 == 0 ? 1.0 : -1.0;
        return d;
    }
    /// Returns a third of the table: each filter is seen along both directions of one axis.
    static std::vector<shadow::FilterRow> filters() {
        std::vector<shadow::FilterRow> some;
        for (const shadow::FilterRow& row : shadow::filter_table())
            if (static_cast<int>(row.id) % 3 == GetParam() / 2) some.push_back(row);
        return some;
    }
};

TEST_P(ShadowCubeAlong, OneCasterDarkensTheWallBehindItAndNoOther) {
    truth.margin_m = 0.12;
    add_room(kRoomHalf_m);
    const glm::dvec3 at = 1.4 * direction() + 0.2 * glm::dvec3(direction().y, direction().z, direction().x);
    add_box(at - 0.3, at + 0.3);
    add_light({.kind = LightKind::point, .intensity = 1000.0f}, glm::dvec3(0.1, -0.15, 0.05), {0.0, 0.0, -1.0},
              {.filter = ShadowFilter::hard, .resolution_px = 256});
    look(direction());
    draw();
    expect_true(kSomeOfFace, 10 * kSomeOfFace);
    // The same caster on the other side of the light would darken another wall.
    truth.boxes.front().translation_m = -2.0 * at;
    EXPECT_GT(judged().wrong, kSomeOfFace / 2);
}

TEST_P(ShadowCubeAlong, CastersAcrossEverySeamAndCornerDarkenBothSides) {
    truth.margin_m = 0.12;
    add_room(kRoomHalf_m);
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                if (std::abs(x) + std::abs(y) + std::abs(z) < 2) continue;
                const glm::dvec3 at = 1.3 * glm::dvec3(x, y, z);
                add_box(at - 0.22, at + 0.22);
            }
    for (const shadow::FilterRow& filter : filters())
        add_light({.kind = LightKind::point, .intensity = 1000.0f}, glm::dvec3(0.0), {0.0, 0.0, -1.0},
                  {.filter = filter.id, .resolution_px = 256});
    look(direction());
    draw();
    for (std::uint32_t light = 0; light < filters().size(); ++light) {
        SCOPED_TRACE(filters()[light].name);
        expect_true(kSomeOfFace, 10 * kSomeOfFace, light);
    }
}

TEST_P(ShadowCubeAlong, AnEmptyRoomIsLitAcrossTheSeamsOfAVeryCoarseCube) {
    // Off the middle, so that the cube's seams run over the walls. Within a filter's reach of the room's own edges a
    // neighbouring wall may darken, which the margin leaves out.
    truth.margin_m = 0.4;
    add_room(kRoomHalf_m);
    // Something must cast, or no map exists: here the walls cast upon themselves.
    const auto walls = world.entities_with<MeshRef>();
    for (const ecs::Entity wall : std::vector<ecs::Entity>(walls.begin(), walls.end()))
        world.emplace<ShadowCaster>(wall);
    constexpr std::uint32_t kCoarse_px = 64;
    const glm::dvec3 lamp(1.2, 0.9, -0.7);
    for (const shadow::FilterRow& filter : filters())
        add_light({.kind = LightKind::point, .intensity = 1000.0f}, lamp, {0.0, 0.0, -1.0},
                  {.filter = filter.id, .resolution_px = kCoarse_px});
    look(direction());
    draw();
    const double least_m = truth.margin_m;
    for (std::uint32_t light = 0; light < filters().size(); ++light) {
        SCOPED_TRACE(filters()[light].name);
        // The cube lies askew to the room: in its creases a tap that leaves the room is behind the other wall. A tap
        // that is compared on the receiver's plane must not be affected.
        const bool on_plane = filters()[light].reading == shadow::MapReading::depths;
        const double reach =
            static_cast<double>(shadow::filter_settings(filters()[light], LightItem{}, kCoarse_px).widest_texel);
        const double widest_texel_m = 2.0 / kCoarse_px * glm::length(glm::abs(lamp) + kRoomHalf_m);
        truth.margin_m = on_plane ? least_m : std::max(least_m, std::sqrt(2.0) * reach * widest_texel_m);
        EXPECT_GE(frame().report().lights[light].counts.views, 4u);  // as many as the camera sees walls in
        expect_true(0, 50 * kSomeOfFace, light);
    }
}

INSTANTIATE_TEST_SUITE_P(EachAxis, ShadowCubeAlong, ::testing::Range(0, 6), [](const auto& row) {
    return std::string(row.param % 2 == 0 ? "plus_" : "minus_") + "xyz"[row.param / 2];
});

}  // namespace
}  // namespace gnomon
