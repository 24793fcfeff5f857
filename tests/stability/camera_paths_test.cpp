#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "bench/flicker/camera_path.h"
#include "bench/flicker/map_readback.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/fitting/directional/split_transition.h"
#include "systems/shadow/request/decide_requests.h"
#include "tests/long_run.h"
#include "tests/oracle/fit_stages.h"

/// A sun's fits along the whole paths of the flicker bench, in the built-in scene, without a GPU. Tests when views
/// step, and how points pass from one cascade to the next.
namespace gnomon {
namespace {

using shadow::ShadowView;

constexpr int kFrames = 300;
constexpr int kPlayed = kSanitized ? 40 : kFrames;  // the beginning of each path runs all of the code
constexpr std::size_t kPoints = kSanitized ? 500 : 4000;
constexpr std::size_t kLayers = shadow::kMaxViews;
/// The shader's share is a float.
constexpr double kRounding = 1e-6;

struct Walk {
    int stepped_frames = 0, moved_frames = 0;
    int parted = 0;              // moves that were no step, and no whole number of texels
    int in_bands = 0;            // points that two cascades share, summed over frames
    int outside = 0;             // points outside the map of the cascade that decides them
    double greatest_fade = 0.0;  // greatest change, between two frames, of a cascade's share in a point's visibility
};

class CameraPaths : public ::testing::Test {
protected:
    void SetUp() override { start(std::nullopt); }
    void start(const std::optional<std::filesystem::path>& file) {
        auto scene = game::load_scene(file);
        ASSERT_TRUE(scene);
        spawned_ = game::spawn_scene(std::move(scene).value(), world_, library_);
        game::apply_motion(spawned_.moving, 0.0, world_);
        look_from(0);
        add_points();
    }
    void look_from(std::size_t camera) {
        game::activate_camera(spawned_, camera, world_);
        extract();
        start_ = snapshot_.consumers.front();
        distance_m_ = bench::seen_distance_m(snapshot_, library_, start_);
    }
    Walk go(const std::string& path, const std::vector<std::string>& settings) {
        for (const game::NamedEntity& light : spawned_.lights)
            for (const std::string& setting : settings)
                game::change_settings(world_, light.entity,
                                      [&](game::LightSettings& s) { EXPECT_FALSE(game::apply_setting(s, setting)); });
        extract();
        Walk walk;
        shadow::History history;
        std::vector<ShadowView> known;
        std::vector<Shares> last(points_ws_.size());
        for (int i = 0; i < kPlayed; ++i) {
            snapshot_.consumers.front() = bench::on_path(start_, path, i / double{kFrames - 1}, distance_m_);
            // The first pose until sizes and holds have settled.
            for (int settling = i == 0 ? 3 : 1; settling > 0; --settling) {
                fit(history);
                std::swap(history, frame_.next_history);
            }
            compare_views(known, walk);
            compare_points(i == 0, last, walk);
        }
        return walk;
    }

private:
    /// Shares of the layers in what a point shows; all 0 out of view.
    using Shares = std::array<double, kLayers>;

    void extract() {
        Extractor extractor;
        TransformSystem transforms;
        extractor.update(world_, library_, transforms.update(world_), {1280, 720}, snapshot_);
    }
    void fit(const shadow::History& history) {
        frame_ = shadow::fitted(snapshot_, history);
    }
    std::vector<const ShadowView*> cascades() const {
        std::vector<const ShadowView*> views;
        for (const ShadowView& view : frame_.fitted.views)
            if (snapshot_.lights[view.light].kind == LightKind::directional)
                views.push_back(&view);
        return views;
    }
    /// Adds random points of the receivers' boxes.
    void add_points() {
        std::mt19937_64 random(20260418);
        std::uniform_real_distribution<double> share(0.0, 1.0);
        std::vector<math::Aabb> boxes;
        for (const InstanceItem& item : snapshot_.instances)
            if (item.visible && item.receives) boxes.push_back(item.bounds_ws);
        while (points_ws_.size() < kPoints) {
            const math::Aabb& box = boxes[points_ws_.size() % boxes.size()];
            points_ws_.push_back(glm::mix(box.min, box.max, glm::dvec3(share(random), share(random), share(random))));
        }
    }
    static bool same_size(const ShadowView& a, const ShadowView& b) {
        const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-9 * std::abs(x); };
        return near(a.plane.texel_u, b.plane.texel_u) && near(a.plane.texel_v, b.plane.texel_v) && a.pose.axis_u == b.pose.axis_u &&
               near(a.depth.far_m - a.depth.near_m, b.depth.far_m - b.depth.near_m);
    }
    static bool by_whole_texels(const ShadowView& a, const ShadowView& b) {
        const glm::dvec3 shift = b.pose.anchor_ws_m - a.pose.anchor_ws_m;
        const double u = (glm::dot(shift, a.pose.axis_u) + b.plane.centre_ls_m.x - a.plane.centre_ls_m.x) / a.plane.texel_u;
        const double v = (glm::dot(shift, a.pose.axis_v) + b.plane.centre_ls_m.y - a.plane.centre_ls_m.y) / a.plane.texel_v;
        return std::abs(u - std::round(u)) < 1e-6 && std::abs(v - std::round(v)) < 1e-6;
    }
    void compare_views(std::vector<ShadowView>& known, Walk& walk) const {
        bool stepped = false, moved = false;
        for (const ShadowView* view : cascades()) {
            const auto before =
                std::find_if(known.begin(), known.end(), [&](const ShadowView& k) { return k.layer == view->layer; });
            if (before == known.end()) {
                known.push_back(*view);
                continue;
            }
            const bool same =
                before->clip_from_anchor == view->clip_from_anchor && before->pose.anchor_ws_m == view->pose.anchor_ws_m;
            moved |= !same;
            if (!same_size(*before, *view))
                stepped = true;
            else if (!same)
                walk.parted += !by_whole_texels(*before, *view);
            *before = *view;
        }
        walk.stepped_frames += stepped;
        walk.moved_frames += moved;
    }
    static bool holds(const ShadowView& view, const glm::dvec3& p_ws) {
        const glm::dvec3 q = glm::dvec3(view.map_from_anchor * glm::vec4(glm::vec3(p_ws - view.pose.anchor_ws_m), 1.0f));
        return q.x >= 0.0 && q.y >= 0.0 && q.z >= 0.0 && q.x <= 1.0 && q.y <= 1.0 && q.z <= 1.0;
    }
    /// Computes the cascades' shares as shaders/shadow/lookup/kinds/directional.glsl chooses them.
    static Shares shares_at(const std::vector<const ShadowView*>& views, const glm::dvec3& p_ws, double distance_m,
                            Walk& walk) {
        Shares shares{};
        std::size_t i = 0;
        while (i + 1 < views.size() && distance_m > views[i]->cascade.seen_to_m) ++i;
        const double from_m = views[i]->cascade.fades_from_m, to_m = views[i]->cascade.seen_to_m;
        double share = to_m > from_m ? std::clamp((distance_m - from_m) / (to_m - from_m), 0.0, 1.0) : 0.0;
        if (i + 1 == views.size() || (share > 0.0 && !holds(*views[i + 1], p_ws))) share = 0.0;
        walk.in_bands += share > 0.0;
        walk.outside += !holds(*views[i], p_ws);
        shares[views[i]->layer] = 1.0 - share;
        if (i + 1 < views.size()) shares[views[i + 1]->layer] += share;
        return shares;
    }
    void compare_points(bool first, std::vector<Shares>& last, Walk& walk) const {
        const auto views = cascades();
        const ConsumerItem& camera = snapshot_.consumers.front();
        for (std::size_t k = 0; k < points_ws_.size(); ++k) {
            const bool was_seen = !first && last[k] != Shares{};
            const Shares before = last[k];
            last[k] = {};
            if (views.empty() || !bench::in_view(camera, points_ws_[k])) continue;
            const double distance_m = -glm::dot(points_ws_[k] - camera.position_ws_m, camera.rotation_ws[2]);
            last[k] = shares_at(views, points_ws_[k], distance_m, walk);
            if (!was_seen) continue;
            for (std::size_t l = 0; l < kLayers; ++l)
                walk.greatest_fade = std::max(walk.greatest_fade, std::abs(last[k][l] - before[l]));
        }
    }

    ecs::Registry world_;
    assets::MeshLibrary library_;
    game::SpawnedScene spawned_;
    SceneSnapshot snapshot_;
    ConsumerItem start_;
    double distance_m_ = 1.0;
    std::vector<glm::dvec3> points_ws_;
    shadow::ShadowFrame frame_;
};

TEST_F(CameraPaths, AStableSunStepsNowhereAndMovesByWholeTexels) {
    for (const char* path : {"pan", "walk", "roll"}) {
        SCOPED_TRACE(path);
        const Walk walk = go(path, {"fit=stable"});
        EXPECT_EQ(walk.stepped_frames, 0);
        EXPECT_EQ(walk.parted, 0);
        EXPECT_LT(walk.moved_frames, kPlayed / 2);
        EXPECT_EQ(walk.outside, 0);
    }
}

TEST_F(CameraPaths, AQuantisedSunStepsFourTimesAtMostAndMovesByWholeTexelsBetween) {
    for (const char* path : {"pan", "walk", "roll", "zoom"}) {
        SCOPED_TRACE(path);
        const Walk walk = go(path, {"fit=quantised"});
        EXPECT_LE(walk.stepped_frames, 4);
        EXPECT_EQ(walk.parted, 0);
        EXPECT_EQ(walk.outside, 0);
    }
}

class PathsOverKilometres : public CameraPaths {
protected:
    void SetUp() override { start(game::kValleyScene); }
};

TEST_F(PathsOverKilometres, AQuantisedSunStepsFourTimesAtMost) {
    for (const std::size_t camera : {0u, 1u, 2u}) {
        look_from(camera);
        for (const char* path : {"pan", "walk", "roll", "zoom"}) {
            SCOPED_TRACE(std::to_string(camera) + " " + path);
            const Walk walk = go(path, {"fit=quantised"});
            EXPECT_LE(walk.stepped_frames, 4);
            EXPECT_EQ(walk.parted, 0);
            EXPECT_EQ(walk.outside, 0);
        }
    }
}

TEST_F(CameraPaths, AQuantisedSunOfAsManyCascadesAsWishedStepsFourTimesAtMost) {
    for (const std::string cascades : {"2", "3", "4", "8"})
        for (const char* path : {"pan", "walk", "roll", "zoom"}) {
            SCOPED_TRACE(path + (" " + cascades));
            const Walk walk = go(path, {"fit=quantised", "cascades=" + cascades});
            std::printf("%s %s: steps %d, moves %d\n", path, cascades.c_str(), walk.stepped_frames, walk.moved_frames);
            EXPECT_LE(walk.stepped_frames, 4);
            EXPECT_EQ(walk.parted, 0);
            EXPECT_EQ(walk.outside, 0);
        }
}

TEST_F(CameraPaths, ATightSunStepsInNearlyEveryFrame) {
    EXPECT_GT(go("walk", {"fit=tight"}).stepped_frames, kPlayed * 9 / 10) << "or steps are not seen";
}

TEST_F(CameraPaths, APointPassesFromOneCascadeToTheNextByAnEighthPerFrameAtMost) {
    for (const char* fit : {"fit=quantised", "fit=stable"}) {
        int in_bands = 0;
        for (const char* splits : {"splits=practical", "splits=uniform", "splits=logarithmic", "splits=seen"})
            for (const char* path : {"pan", "walk", "roll", "zoom"}) {
                SCOPED_TRACE(std::string(fit) + " " + splits + " " + path);
                const Walk walk = go(path, {fit, splits, "cascades=4", "cascade_blend=0.2"});
                EXPECT_LE(walk.greatest_fade, shadow::kMostFade + kRounding);
                EXPECT_EQ(walk.outside, 0);
                in_bands += walk.in_bands;
            }
        EXPECT_GT(in_bands, kPlayed * static_cast<int>(kPoints) / 40) << fit << ": hardly anything fades";
    }
}

TEST_F(CameraPaths, WithoutABlendAPointJumps) {
    EXPECT_EQ(go("walk", {"fit=quantised", "cascades=4", "cascade_blend=0"}).greatest_fade, 1.0);
}

}  // namespace
}  // namespace gnomon
