#include <glm/geometric.hpp>

#include "tests/gl/debug_picture.h"

// FrameSettings::freeze_fits: shadows stay as one camera needs them while another looks.
namespace gnomon {
namespace {

constexpr int kNoMap = -1, kUnknown = -2;
constexpr double kFrozenTint = 0.4;  // shaders/debug/cascades.frag

class FrozenFits : public DebugPictureTest, public ::testing::WithParamInterface<ShadowFit> {
protected:
    void SetUp() override {
        DebugPictureTest::SetUp();
        truth.margin_m = 0.05;
        add_ground(40.0);
        for (const double z : {-2.0, -6.0, -12.0, -20.0}) add_box({-0.9, 0.0, z - 0.5}, {-0.2, 1.2, z + 0.4});
        add_light({.kind = LightKind::directional, .intensity = 10000.0f}, {}, {-0.5, -1.0, -0.3},
                  {.filter = ShadowFilter::hard, .resolution_px = 512},
                  {.cascades = {.fit = GetParam(), .blend = 0.0f}});
        camera_ = add_camera({.fov_y_rad = 0.9, .near_m = 0.1}, {0.3, 2.2, 3.0}, {0.0, -0.35, -1.0});
    }
    void move_camera() {
        world.patch<Transform>(camera_, [](Transform& t) {
            t.translation_m = {6.0, 7.0, -2.0};
            t.rotation = looking_along({-0.7, -0.8, -0.5});
        });
    }
    /// What a picture shows in each of its pixels.
    struct Seen {
        std::vector<int> maps;
        std::vector<float> visible;
        ConsumerItem camera;
    };
    Seen look() {
        show_plain();
        Seen seen{{}, visibility(), camera()};
        show("cascades", frame().snapshot().lights.front().name);
        for (std::uint32_t y = 0; y < size_px().y; ++y)
            for (std::uint32_t x = 0; x < size_px().x; ++x) seen.maps.push_back(map_at(x, y));
        return seen;
    }
    /// Numbers of points of the ground at which the newest picture shows what an earlier one showed, or something else.
    struct Comparison {
        std::size_t maps_alike = 0, maps_other = 0, shadows_alike = 0, shadows_other = 0, new_without_map = 0;
    };
    Comparison compare(const Seen& before, const Seen& after) {
        Comparison found;
        for (std::uint32_t y = 0; y < size_px().y; ++y)
            for (std::uint32_t x = 0; x < size_px().x; ++x) {
                const auto p = ground_at(x, y);
                if (!p || std::max(std::abs(p->x), std::abs(p->z)) > 39.0) continue;
                const std::size_t i = std::size_t{y} * size_px().x + x;
                const auto then = seen_by(before.camera, *p);
                if (!then) {
                    found.new_without_map += after.maps[i] == kNoMap ? 1 : 0;
                    continue;
                }
                const int map = around(before.maps, *then, kUnknown);
                const float visible = around(before.visible, *then, -2.0f);
                if (map != kUnknown && after.maps[i] != kUnknown)
                    ++(map == after.maps[i] ? found.maps_alike : found.maps_other);
                if (visible == 0.0f || visible == 1.0f)
                    ++(visible == after.visible[i] ? found.shadows_alike : found.shadows_other);
            }
        return found;
    }

    ecs::Entity camera_{};

private:
    int map_at(std::uint32_t x, std::uint32_t y) {
        if (shown_at(x, y) == plain_at(x, y)) return kNoMap;
        for (std::size_t i = 1; i < labels().size(); ++i)
            if (near(shown_at(x, y), over(plain_at(x, y), labels()[i], kFrozenTint))) return static_cast<int>(i);
        return kUnknown;
    }
    /// Returns the pixel of an earlier picture that saw a point of the ground, if no box stood before it.
    std::optional<glm::ivec2> seen_by(const ConsumerItem& then, const glm::dvec3& p_ws) {
        for (const boxes::Box& box : truth.boxes)
            if (boxes::meets(box, then.position_ws_m, p_ws, truth.margin_m)) return std::nullopt;
        const glm::dvec3 p = (p_ws - then.position_ws_m) * then.rotation_ws;
        const glm::dvec2 size(size_px());
        const double half_y = std::tan(0.5 * then.fov_y_rad);
        if (!(p.z < -then.near_m)) return std::nullopt;
        const glm::ivec2 at((glm::dvec2(p.x * size.y / size.x, p.y) / (-p.z * half_y) * 0.5 + 0.5) * size);
        const glm::ivec2 most = glm::ivec2(size_px()) - 2;
        const bool inside = at.x >= 1 && at.y >= 1 && at.x <= most.x && at.y <= most.y;
        return inside ? std::optional(at) : std::nullopt;
    }
    /// Returns the value that nine pixels agree on; `none` if they do not.
    template <class T>
    T around(const std::vector<T>& field, const glm::ivec2& at, T none) const {
        const auto value = [&](int x, int y) {
            return field[static_cast<std::size_t>(y) * size_px().x + static_cast<std::size_t>(x)];
        };
        for (int y = at.y - 1; y <= at.y + 1; ++y)
            for (int x = at.x - 1; x <= at.x + 1; ++x)
                if (value(x, y) != value(at.x, at.y)) return none;
        return value(at.x, at.y);
    }
};

TEST_P(FrozenFits, WhileTheCameraStandsStillNothingChangesByABit) {
    draw();
    draw();
    const auto plain = picture();
    const auto visible = visibility();
    settings.freeze_fits = true;
    for (int i = 0; i < 3; ++i) {
        draw();
        EXPECT_EQ(picture(), plain);
        EXPECT_EQ(visibility(), visible);
    }
    EXPECT_EQ(frame().report().lights.front().state, LightState::reused);
}

TEST_P(FrozenFits, AnotherCameraSeesTheSameMapsServeTheSamePlacesWithTheSameShadows) {
    constexpr std::size_t kMany = 3000;
    draw();
    const Seen before = look();
    settings.freeze_fits = true;
    draw();
    move_camera();
    const Comparison frozen = compare(before, look());
    EXPECT_GT(frozen.maps_alike, kMany);
    EXPECT_EQ(frozen.maps_other, 0u);
    EXPECT_GT(frozen.shadows_alike, kMany);
    EXPECT_EQ(frozen.shadows_other, 0u);
    EXPECT_EQ(frame().report().lights.front().state, LightState::reused) << "no map is drawn for what is not fitted";
    // Thawed, the new camera has maps of its own.
    settings.freeze_fits = false;
    draw();
    const Comparison thawed = compare(before, look());
    EXPECT_GT(thawed.maps_other, kMany / 3);
    EXPECT_EQ(thawed.new_without_map, 0u);
    if (GetParam() == ShadowFit::tight) {
        EXPECT_GT(frozen.new_without_map, 0u) << "what the frozen camera did not see has no map";
    }
}

TEST_P(FrozenFits, CastersGoOnAndTheirShadowsWithThem) {
    const ecs::Entity box = add_box({0.5, 0.0, -3.5}, {1.1, 1.0, -2.9});
    draw();
    settings.freeze_fits = true;
    draw();
    const auto before = visibility();
    world.patch<Transform>(box, [](Transform& t) { t.translation_m.x += 0.7; });
    draw();
    EXPECT_NE(visibility(), before);
    EXPECT_EQ(frame().report().lights.front().state, LightState::rendered);
}

INSTANTIATE_TEST_SUITE_P(EachFit, FrozenFits,
                         ::testing::Values(ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised));

}  // namespace
}  // namespace gnomon
