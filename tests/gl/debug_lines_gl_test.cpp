#include "tests/gl/debug_picture.h"

// Lines of debug views in the picture, against the camera's own geometry.
namespace gnomon {
namespace {

class DebugLines : public DebugPictureTest {
protected:
    static constexpr glm::dvec3 kLow{-0.6, 0.0, -4.6}, kHigh{0.6, 1.5, -3.4};

    void SetUp() override {
        DebugPictureTest::SetUp();
        add_ground(20.0);
        add_box(kLow, kHigh);
        add_light({.kind = LightKind::directional, .intensity = 10000.0f}, {}, {-0.5, -1.0, -0.3});
        add_camera({.fov_y_rad = 0.9, .near_m = 0.1}, {2.0, 2.2, 1.0}, {-0.35, -0.3, -1.0});
    }
    std::string light_name() { return frame().snapshot().lights.front().name; }
    /// Returns whether a pixel within one of `place` has the colour of `label` over the picture.
    bool has(const glm::dvec2& place, const debug::Label& label, double share) {
        const glm::ivec2 middle(place);
        for (int y = middle.y - 1; y <= middle.y + 1; ++y)
            for (int x = middle.x - 1; x <= middle.x + 1; ++x) {
                if (x < 0 || y < 0 || x >= static_cast<int>(size_px().x) || y >= static_cast<int>(size_px().y))
                    continue;
                const auto px = static_cast<std::uint32_t>(x), py = static_cast<std::uint32_t>(y);
                if (near(shown_at(px, py), over(plain_at(px, py), label, share))) return true;
            }
        return false;
    }
};

TEST_F(DebugLines, TheEdgesOfACastersBoxLieWhereTheCameraSeesThemAndHiddenOnesAreFainter) {
    constexpr double kHidden = 0.25;  // shaders/debug/lines.frag
    show_plain();
    show("sets", light_name());
    ASSERT_EQ(labels().size(), 4u);
    const debug::Label& both = labels().back();
    EXPECT_EQ(both.text, "1 do both");
    std::size_t clear = 0, faint = 0, missed = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 4; ++side)
            for (const double along : {0.15, 0.45, 0.7}) {
                glm::dvec3 p = kLow;
                p[axis] = glm::mix(kLow[axis], kHigh[axis], along);
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                p[u] = (side & 1) != 0 ? kHigh[u] : kLow[u];
                p[v] = (side & 2) != 0 ? kHigh[v] : kLow[v];
                const auto place = place_of(p);
                ASSERT_TRUE(place);
                // An edge is hidden if both of its faces look away: if the box, shrunk a little, stands before it.
                const glm::dvec3 eye = camera().position_ws_m;
                const bool hidden = boxes::meets(truth.boxes.front(), eye, p, -1.0e-3);
                missed += has(*place, both, hidden ? kHidden : 1.0) ? 0 : 1;
                ++(hidden ? faint : clear);
            }
    EXPECT_EQ(clear, 27u);
    EXPECT_EQ(faint, 9u);
    EXPECT_LE(missed, 2u) << "where one line crosses another, two are mixed";
}

TEST_F(DebugLines, NothingElseOfThePictureChanges) {
    show_plain();
    show("sets", light_name());
    std::size_t changed = 0;
    for (std::uint32_t y = 0; y < size_px().y; ++y)
        for (std::uint32_t x = 0; x < size_px().x; ++x) changed += shown_at(x, y) == plain_at(x, y) ? 0 : 1;
    EXPECT_GT(changed, 300u);
    EXPECT_LT(changed, std::size_t{size_px().x} * size_px().y / 20);
}

TEST_F(DebugLines, FramesOfAllLightsHoldThoseOfEach) {
    add_light({.kind = LightKind::spot, .intensity = 5000.0f, .outer_cone_rad = 0.6f}, {0.5, 4.0, -1.0},
              {0.0, -1.0, -0.5});
    show_plain();
    const auto changed_by = [&](const std::string& light) {
        show("frusta", light);
        std::vector<bool> changed;
        for (std::uint32_t y = 0; y < size_px().y; ++y)
            for (std::uint32_t x = 0; x < size_px().x; ++x) changed.push_back(shown_at(x, y) != plain_at(x, y));
        return changed;
    };
    std::vector<std::vector<bool>> each;
    for (const LightItem& light : frame().snapshot().lights) each.push_back(changed_by(light.name));
    const std::vector<bool> all = changed_by({});
    ASSERT_EQ(each.size(), 2u);
    for (const auto& one : each) EXPECT_GT(std::count(one.begin(), one.end(), true), 50);
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], each[0][i] || each[1][i]) << i;
}

}  // namespace
}  // namespace gnomon
