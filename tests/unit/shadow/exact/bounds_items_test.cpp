#include "systems/shadow/exact/bounds_items.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <set>
#include <string>

#include "engine/gl/device_recording.h"
#include "engine/math/frustum.h"
#include "shaders/embedded.h"
#include "systems/shadow/exact/error_margins.h"
#include "systems/shadow/projection/orthographic_view.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/occluder_pyramid.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/oracle/analytic_scene.h"
#include "tests/unit/rays/triangle_soup.h"

namespace gnomon::test {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr std::uint32_t kMap_px = 512;

/// One instance of one mesh before a light.
class SheetItemsOf {
public:
    explicit SheetItemsOf(oracle::AnalyticScene& scene) : scene_(scene) {
        auto made = GpuScene::create(device_, scene.library);
        EXPECT_TRUE(made);
        if (made) gpu_.emplace(std::move(made).value());
    }
    /// Gathers the items before a view. `max_point_px` 1: quads alone, so that all items are large.
    shadow::BoundsItems before(const shadow::ShadowView& view, std::uint32_t max_point_px = 1) {
        shadow::BoundsItems items;
        shadow::BoundsGatherer gatherer(max_point_px);
        for (const InstanceItem& item : scene_.snapshot.instances)
            gatherer.append(*gpu_, surfaces_.of(*gpu_, item.mesh), item, view, kMap_px, items);
        return items;
    }

private:
    oracle::AnalyticScene& scene_;
    gl::RecordingDevice device_;
    std::optional<GpuScene> gpu_;
    shadow::CasterTopologies surfaces_;
};

shadow::ShadowView sun(const glm::dvec3& toward) {
    shadow::OrthographicBox box;
    box.axes = math::basis_from_back(toward);
    box.half_extent_m = glm::dvec2(2.0);
    box.near_m = -10.0;
    box.far_m = 10.0;
    return shadow::orthographic_view(box, kMap_px);
}
shadow::ShadowView lamp(const glm::dvec3& at) {
    return shadow::perspective_view(at, math::basis_from_back(at), shadow::TangentRectangle{}, {0.1, 50.0}, kMap_px);
}

std::set<std::array<std::uint32_t, 2>> edges_of(const shadow::BoundsItems& items) {
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const shadow::BoundsItem& item : items.large[shadow::BoundsItems::contours])
        edges.insert({std::min(item.a, item.b), std::max(item.a, item.b)});
    return edges;
}

TEST(BoundsItems, OfACubeAreSixContoursHoweverItIsTurned) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        oracle::AnalyticScene scene;
        const glm::dmat3 turn =
            glm::mat3_cast(glm::normalize(glm::dquat(share(random), share(random), share(random), share(random))));
        scene.place(scene.add_cube(), {0.1, 0.2, 0.3}, turn);
        const glm::dvec3 toward = glm::normalize(glm::dvec3(share(random), share(random), share(random)));
        // Not within 1e-3 of edge-on.
        const glm::dvec3 seen = glm::abs(toward * turn);
        if (std::min({seen.x, seen.y, seen.z}) < 1e-3) continue;
        EXPECT_THAT(SheetItemsOf(scene).before(sun(toward)).large[shadow::BoundsItems::contours], SizeIs(6)) << i;
    }
}

TEST(BoundsItems, HoldAllEdgesOfAFaceSeenEdgeOn) {
    oracle::AnalyticScene scene;
    scene.place(scene.add_cube(), {});
    // The light lies in the planes of four faces.
    EXPECT_THAT(SheetItemsOf(scene).before(sun({0.0, 1.0, 0.0})).large[shadow::BoundsItems::contours],
                SizeIs(4 + 4 + 4 + 4));
    EXPECT_THAT(SheetItemsOf(scene).before(sun({1e-9, 1.0, 0.0})).large[shadow::BoundsItems::contours],
                SizeIs(4 + 4 + 4 + 4));
}

TEST(BoundsItems, OfAMirrorImageAreThoseOfTheThing) {
    const auto contours = [](double side) {
        oracle::AnalyticScene scene;
        std::mt19937_64 random(5);
        scene.library.meshes.push_back(soup(Soup::closed_sheet, 200, 1.0, random));
        scene.place(0, {}, glm::dmat3({side, 0, 0}, {0, 2.0, 0}, {0.2 * side, 0, 1}));
        return edges_of(SheetItemsOf(scene).before(sun({side, 0.3, 0.2})));
    };
    EXPECT_THAT(contours(1.0), SizeIs(testing::Ge(50)));
    EXPECT_EQ(contours(1.0), contours(-1.0));
}

TEST(BoundsItems, OfAnOpenSheetAreItsBordersAndNoFoldThatIsSeenFromOneSide) {
    for (const std::vector<std::uint32_t>& indices :
         {std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, {0, 1, 2, 2, 0, 3}, {0, 1, 2, 0, 3, 2}}) {
        // The last one disagrees about its front.
        oracle::AnalyticScene scene;
        scene.place(scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {1, 0.1f, 1}, {0, 0, 1}}, indices), {});
        EXPECT_THAT(SheetItemsOf(scene).before(sun({0.3, 1.0, 0.2})).large[shadow::BoundsItems::contours], SizeIs(4));
    }
}

TEST(BoundsItems, HoldAFoldBetweenFrontAndBackHoweverItIsWound) {
    for (const std::vector<std::uint32_t>& indices :
         {std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, {0, 1, 2, 0, 3, 2}}) {
        // Bent over 0-2 so far that the sun sees one triangle from above and one from below.
        oracle::AnalyticScene scene;
        scene.place(scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {1, -1, 0}}, indices), {});
        EXPECT_THAT(SheetItemsOf(scene).before(sun({0.1, 1.0, -0.3})).large[shadow::BoundsItems::contours], SizeIs(5));
    }
}

/// Checks every border and fold against corners in the world, in double.
TEST(BoundsItems, AreWhatTheCornersSayWheneverTheySayItClearly) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const auto point = [&] { return glm::dvec3(share(random), share(random), share(random)); };
    std::size_t contours = 0, folds = 0;
    for (int world = 0; world < 60; ++world) {
        oracle::AnalyticScene scene;
        if (world % 3 == 0) scene.offset_m = {1e8, 2e7, -3e7};
        scene.library.meshes.push_back(soup(Soup::closed_sheet, 200, 1.0, random));
        const glm::dmat3 basis(point(), point(), point());
        const InstanceItem item = scene.place(0, point(), basis);
        const bool parallel = world % 2 == 0;
        const glm::dvec3 from = 3.0 * point();
        shadow::ShadowView view = parallel ? sun(from) : lamp(from);
        view.pose.anchor_ws_m += scene.offset_m;
        const auto found = edges_of(SheetItemsOf(scene).before(view));
        const assets::Mesh& mesh = scene.library.meshes[0];
        const auto corner = [&](std::uint32_t v) {
            return basis * glm::dvec3(mesh.vertices[v].position_ms) + (item.translation_ws_m - scene.offset_m);
        };
        // What lies beside the map is left out.
        const auto is_beside = [&](std::uint32_t a, std::uint32_t b) {
            const glm::dmat4 m(view.clip_from_anchor);
            const glm::dvec3 anchor = view.pose.anchor_ws_m - scene.offset_m;
            const glm::dvec4 p = m * glm::dvec4(corner(a) - anchor, 1.0), q = m * glm::dvec4(corner(b) - anchor, 1.0);
            bool beside = p.w < 0.0 && q.w < 0.0;
            for (int i = 0; i < 2; ++i) beside = beside || (p[i] > p.w && q[i] > q.w) || (-p[i] > p.w && -q[i] > q.w);
            return beside;
        };
        const std::vector<bool> all(mesh.indices.size() / 3, true);
        const assets::SurfaceEdges edges = assets::surface_edges(mesh.vertices, mesh.indices, all);
        for (const auto& border : edges.borders)
            if (!is_beside(border.a, border.b)) {
                EXPECT_EQ(found.count({std::min(border.a, border.b), std::max(border.a, border.b)}), 1u);
            }
        for (const auto& fold : edges.folds) {
            const auto faces = [&](std::uint32_t t) {
                const glm::dvec3 a = corner(mesh.indices[3 * t]), b = corner(mesh.indices[3 * t + 1]),
                                 c = corner(mesh.indices[3 * t + 2]);
                const glm::dvec3 toward = parallel ? view.pose.axis_back : from - a;
                return glm::dot(glm::normalize(glm::cross(b - a, c - a)), glm::normalize(toward));
            };
            const double first = faces(fold.first), second = faces(fold.second);
            if (std::min(std::abs(first), std::abs(second)) < 1e-5) continue;
            const bool is_contour = (first > 0.0) != (second > 0.0);
            if (is_contour && is_beside(fold.a, fold.b)) continue;
            EXPECT_EQ(found.count({std::min(fold.a, fold.b), std::max(fold.a, fold.b)}) == 1, is_contour);
            contours += is_contour ? 1 : 0;
            ++folds;
        }
    }
    EXPECT_GT(contours, 100u);
    EXPECT_GT(folds, 2 * contours);
}

TEST(BoundsItems, LeaveOutWhatIsFlat) {
    oracle::AnalyticScene scene;
    const std::uint32_t square = scene.add_square();
    scene.place(square, {});
    const auto tilted = [](double tangent) { return sun({tangent, 0.0, 1.0}); };
    EXPECT_THAT(SheetItemsOf(scene).before(tilted(3.9)).large[shadow::BoundsItems::triangles], IsEmpty());
    EXPECT_THAT(SheetItemsOf(scene).before(tilted(6.0)).large[shadow::BoundsItems::triangles], SizeIs(2));
    // The ray that is met most obliquely counts: at the square's corner, of 1.6 m from its middle at most.
    EXPECT_THAT(SheetItemsOf(scene).before(lamp({0.0, 0.0, 2.0})).large[shadow::BoundsItems::triangles], IsEmpty());
    EXPECT_THAT(SheetItemsOf(scene).before(lamp({2.0, 0.0, 0.2})).large[shadow::BoundsItems::triangles], SizeIs(2));
    // What float places coarsely is drawn however flat it is.
    scene.snapshot.instances[0].basis *= 1e6;
    EXPECT_THAT(SheetItemsOf(scene).before(tilted(0.5)).large[shadow::BoundsItems::triangles], SizeIs(2));
}

TEST(BoundsItems, LeaveOutWhatLiesBesideTheMap) {
    oracle::AnalyticScene scene;
    const std::uint32_t cube = scene.add_cube();
    scene.place(cube, {1.0, 0.0, 0.0});
    SheetItemsOf items(scene);
    const auto seen_toward = [&](const glm::dvec3& back) {
        return shadow::perspective_view({}, math::basis_from_back(back), shadow::TangentRectangle{}, {0.1, 50.0},
                                        kMap_px);
    };
    EXPECT_THAT(items.before(seen_toward({-1.0, 0.01, 0.02})).large[shadow::BoundsItems::contours], Not(IsEmpty()));
    for (const glm::dvec3& away : {glm::dvec3(1.0, 0.0, 0.0), {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}}) {
        scene.snapshot.instances[0].translation_ws_m = {3.0, 0.0, 0.0};
        const shadow::BoundsItems beside = items.before(seen_toward(away));
        EXPECT_THAT(beside.large[shadow::BoundsItems::contours], IsEmpty());
        EXPECT_THAT(beside.large[shadow::BoundsItems::triangles], IsEmpty());
    }
}

TEST(BoundsItems, AreSmallWhereAPointOfTheLargestSizeCoversThemAndNoneIsLost) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    std::size_t small = 0, large = 0;
    for (int i = 0; i < 120; ++i) {
        oracle::AnalyticScene scene;
        const std::uint32_t cube = scene.add_cube();
        // Sizes from a hundredth of a texel to all of the map, and some cubes around the lamp itself.
        const double size_m = std::pow(10.0, -4.5 + 2.5 * (1.0 + share(random)));
        scene.place(cube, {2.0 * share(random), 2.0 * share(random), 2.0 * share(random)}, glm::dmat3(size_m));
        const glm::dvec3 at(share(random), share(random), share(random) + 1.5);
        const shadow::ShadowView view = i % 2 == 0 ? sun(at) : lamp(at);
        SheetItemsOf items(scene);
        const shadow::BoundsItems quads = items.before(view), points = items.before(view, shadow::most_point_px());
        const auto& vertices = scene.library.meshes[cube].vertices;
        const InstanceItem& item = scene.snapshot.instances[0];
        for (const auto kind :
             {shadow::BoundsItems::triangles, shadow::BoundsItems::contours, shadow::BoundsItems::masked}) {
            std::vector<shadow::BoundsItem> all = points.large[kind];
            all.insert(all.end(), points.small[kind].begin(), points.small[kind].end());
            EXPECT_THAT(all, ::testing::UnorderedElementsAreArray(quads.large[kind]));
            EXPECT_THAT(quads.small[kind], IsEmpty());
            large += points.large[kind].size();
            for (const shadow::BoundsItem& one : points.small[kind]) {
                ++small;
                glm::dvec2 low(1e9), high(-1e9);
                for (const std::uint32_t v : {one.a, one.b, one.c}) {
                    const glm::dvec3 place =
                        item.basis * glm::dvec3(vertices[v].position_ms) + item.translation_ws_m - view.pose.anchor_ws_m;
                    const glm::dvec4 clip = glm::dmat4(view.clip_from_anchor) * glm::dvec4(place, 1.0);
                    ASSERT_GT(clip.w, 0.0);
                    const glm::dvec2 texel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * static_cast<double>(kMap_px);
                    low = glm::min(low, texel);
                    high = glm::max(high, texel);
                }
                EXPECT_LE(std::max(high.x - low.x, high.y - low.y), shadow::kSmall_texel + 1e-3);
            }
        }
    }
    EXPECT_GT(small, 50u);
    EXPECT_GT(large, 50u);
}

TEST(BoundsItems, AreLargeOnADeviceWithoutPointsOfTheirSize) {
    oracle::AnalyticScene scene;
    scene.place(scene.add_cube(), {}, glm::dmat3(0.01));
    SheetItemsOf items(scene);
    EXPECT_THAT(items.before(sun({0.3, 1.0, 0.2}), shadow::most_point_px()).small[shadow::BoundsItems::contours],
                SizeIs(6));
    EXPECT_THAT(items.before(sun({0.3, 1.0, 0.2}), shadow::most_point_px() - 1).large[shadow::BoundsItems::contours],
                SizeIs(6));
}

TEST(BoundsItems, LeaveOutNoNeedleHoweverFlat) {
    // A rasteriser may give a triangle that is narrower than its own snapping any depth at all.
    const auto drawn = [](float altitude, double scale) {
        oracle::AnalyticScene scene;
        const std::uint32_t mesh = scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {0.5f, altitude, 0}}, {0, 1, 2});
        scene.place(mesh, {}, glm::dmat3(scale));
        return SheetItemsOf(scene).before(sun({0.0, 0.0, 1.0})).large[shadow::BoundsItems::triangles].size();
    };
    constexpr double kTexel_m = 4.0 / kMap_px;
    EXPECT_EQ(drawn(static_cast<float>(0.01 * kTexel_m), 1.0), 1u);
    EXPECT_EQ(drawn(static_cast<float>(10.0 * kTexel_m), 1e-3), 1u);
    EXPECT_EQ(drawn(static_cast<float>(10.0 * kTexel_m), 1.0), 0u);
    EXPECT_EQ(drawn(1e-8f, 1.0), 1u);
}

TEST(BoundsItems, HaveTrianglesOfMasksApartAndEndSheetsAtThem) {
    oracle::AnalyticScene scene;
    scene.library.materials.emplace_back().alpha_mode = assets::AlphaMode::mask;
    scene.library.materials.emplace_back().alpha_mode = assets::AlphaMode::blend;
    const std::uint32_t mesh =
        scene.add_mesh({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {2, 0, 0}}, {0, 2, 1, 0, 3, 2, 1, 2, 4});
    scene.library.meshes[mesh].submeshes = {{0, 3, 0}, {3, 3, 1}, {6, 3, 2}};
    scene.place(mesh, {});
    const shadow::BoundsItems items = SheetItemsOf(scene).before(sun({0.3, 1.0, 0.2}));
    EXPECT_THAT(items.large[shadow::BoundsItems::contours], SizeIs(3));  // the opaque triangle's alone
    EXPECT_THAT(items.large[shadow::BoundsItems::masked], SizeIs(1));
}

/// Reads a margin from the text of shaders/shadow/filters/exact/error_margins.glsl, or of another shader file.
double in_shaders(const std::string& name, const std::string& path = "shadow/filters/exact/error_margins.glsl") {
    for (const gl::ShaderFile& file : shader_files()) {
        if (file.path != path) continue;
        const std::string text(file.text);
        const std::size_t at = text.rfind(' ' + name + " = ");
        if (at != std::string::npos) return std::stod(text.substr(text.find('=', at) + 1));
    }
    ADD_FAILURE() << name << " is not there";
    return 0.0;
}

TEST(SheetMargins, AreTheSameInShaders) {
    EXPECT_EQ(in_shaders("kPlacedUnits", "common/position_error.glsl"), shadow::kPlacedUnits);
    EXPECT_EQ(in_shaders("kProjectedUnits"), shadow::kProjectedUnits);
    EXPECT_NEAR(in_shaders("kSplitUnits", "common/position_error.glsl"), shadow::kSplitUnits, 1e-6 * shadow::kSplitUnits);
    EXPECT_EQ(in_shaders("kMostMoved_texel"), shadow::kMostMoved_texel);
    EXPECT_EQ(in_shaders("kDepartureFactor"), shadow::kDepartureFactor);
    EXPECT_EQ(in_shaders("kFloorTangent"), shadow::kFloorTangent);
    EXPECT_EQ(in_shaders("kEndsAcross", "shadow/filters/exact/occluder_pyramid.glsl"), shadow::kEndsAcross);
    EXPECT_EQ(in_shaders("kMostStretch", "shadow/filters/exact/light_cone.glsl"), shadow::kMostStretch);
    // As docs/explanation/exact_proof.md adds them up.
    EXPECT_GE(in_shaders("kTexelHalf"), 0.508 + 1.0 / 256.0);
    EXPECT_GE(shadow::kDepartureFactor, (0.508 + 1.0 / 256.0 + shadow::kMostMoved_texel) / 0.5 + 0.004);
}

}  // namespace
}  // namespace gnomon::test
