#include <gmock/gmock.h>

#include <cstring>

#include "systems/debug/debug_view.h"
#include "systems/debug/depth_tiles.h"

namespace gnomon::debug {
namespace {

using ::testing::HasSubstr;

/// A sun with two cascades and a lantern with six faces; a third light that has no map.
struct DepthView : ::testing::Test {
    DepthView() {
        for (const char* name : {"sun", "lantern", "dark"}) scene.lights.emplace_back().name = name;
        frame.fitted.lights.resize(3);
        frame.sets.lights.resize(3);
        frame.decisions.resize(3);
        frame.statuses.resize(3);
        frame.statuses[2].skip(Reason::no_caster);
        add_views(0, 2, shadow::ViewProjection::orthographic, {7});
        add_views(1, 6, shadow::ViewProjection::cube_face, {9});
        request.view = find_view("depth");
    }
    void add_views(std::uint32_t light, std::uint32_t count, shadow::ViewProjection projection,
                   gl::TextureHandle map) {
        frame.fitted.lights[light].views = {static_cast<std::uint32_t>(frame.fitted.views.size()), count};
        for (std::uint32_t i = 0; i < count; ++i) {
            shadow::ShadowView& view = frame.fitted.views.emplace_back();
            view.light = light;
            view.layer = i;
            view.projection = projection;
            view.depth.near_m = projection == shadow::ViewProjection::orthographic ? -3.0 : 0.25;
            view.depth.far_m = 12.5;
            frame.maps.emplace_back().texture = map;
            frame.updates.emplace_back();
        }
    }
    std::optional<Drawing> draw(const std::string& light) {
        request.light = light;
        return request.view->drawer->draw({scene, frame, request, {0, 0, 400, 320}});
    }
    static DepthTiles tiles_of(const Drawing& drawing) {
        DepthTiles tiles;
        EXPECT_EQ(drawing.block.size(), sizeof tiles);
        std::memcpy(&tiles, drawing.block.data(), sizeof tiles);
        return tiles;
    }

    SceneSnapshot scene;
    shadow::ShadowFrame frame;
    Request request;
};

TEST_F(DepthView, EveryViewIsFoundByItsOwnNameAndNoOther) {
    for (const ViewRow& row : view_table()) EXPECT_EQ(find_view(row.name), &row);
    EXPECT_EQ(find_view("Depth"), nullptr);
    EXPECT_EQ(find_view(""), nullptr);
}

TEST_F(DepthView, ASunShowsItsCascadesAndTheirDepthInMetres) {
    const auto drawing = draw("sun");
    ASSERT_TRUE(drawing);
    EXPECT_EQ(drawing->maps[0], (gl::TextureHandle{7}));
    EXPECT_FALSE(drawing->maps[1]);
    EXPECT_EQ(tiles_of(*drawing).options.x, 2);
    ASSERT_EQ(drawing->labels.size(), 3u);
    EXPECT_THAT(drawing->labels[0].text, HasSubstr("sun"));
    EXPECT_EQ(drawing->labels[2].text, "map 1: 0 ... 15.5 m");
}

TEST_F(DepthView, ACubeShowsSixNamedFacesWithTheirRange) {
    const auto drawing = draw("lantern");
    ASSERT_TRUE(drawing);
    EXPECT_FALSE(drawing->maps[0]);
    EXPECT_EQ(drawing->maps[1], (gl::TextureHandle{9}));
    ASSERT_EQ(drawing->labels.size(), 7u);
    for (std::size_t face = 0; face < 6; ++face) {
        const char* names[] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
        EXPECT_EQ(drawing->labels[face + 1].text, std::string("face ") + names[face] + ": 0.25 ... 12.5 m");
        const glm::vec4 place = tiles_of(*drawing).tiles[face].place;
        EXPECT_EQ(drawing->labels[face + 1].at_px, glm::ivec2(place.x, place.y + place.z)) << "not on its own tile";
    }
}

TEST_F(DepthView, OneChosenMapIsShownAlone) {
    request.layer = 4;
    const auto drawing = draw("lantern");
    ASSERT_TRUE(drawing);
    EXPECT_EQ(tiles_of(*drawing).options.x, 1);
    EXPECT_EQ(tiles_of(*drawing).tiles[0].place.w, 4.0f);
    request.layer = 2;
    EXPECT_EQ(tiles_of(*draw("sun")).options.x, 0);
}

TEST_F(DepthView, ALightWithoutAMapSaysWhy) {
    const auto drawing = draw("dark");
    ASSERT_TRUE(drawing);
    EXPECT_EQ(tiles_of(*drawing).options.x, 0);
    ASSERT_EQ(drawing->labels.size(), 1u);
    EXPECT_THAT(drawing->labels[0].text, HasSubstr(reason_code(Reason::no_caster)));
}

TEST_F(DepthView, AViewThatGotNoMapIsLeftOut) {
    frame.maps[0].texture = {};
    EXPECT_EQ(tiles_of(*draw("sun")).options.x, 1);
}

TEST_F(DepthView, ALightThatIsNotThereShowsNothing) { EXPECT_FALSE(draw("nobody")); }

}  // namespace
}  // namespace gnomon::debug
