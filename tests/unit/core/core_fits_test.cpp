#include <gtest/gtest.h>

#include <set>

#include "tests/long_run.h"
#include "tests/unit/core/core_scene.h"
#include "tests/unit/math/random_seed.h"

/// What the maps of gnomon/core.h hold, judged by rays against the boxes.
namespace gnomon::core {
namespace {

/// Counts of the judge: points that it looked at, and what was wrong with the maps there.
struct Verdict {
    int points = 0, blocked = 0;
    int outside = 0;   // a visible point lies in no map of its light
    int missing = 0;   // a box on its way to the light is not drawn into that map
    int displaced = 0; // or is drawn elsewhere than where the point is looked up
    bool right() const { return outside + missing + displaced == 0; }
};

/// Looks at points on the boxes' sides that a camera sees and the light reaches.
Verdict judge(const OwnScene& own, std::uint32_t light, std::span<const View> views, const Fits& fits, Random& random,
              std::size_t camera = 0) {
    const Camera& eye = own.cameras[camera];
    Verdict verdict;
    for (const Box& receiver : own.boxes)
        for (int k = 0; k < 60; ++k) {
            glm::dvec3 p = random.inside(receiver.min_ws_m, receiver.max_ws_m);
            const int side = k % 3;
            p[side] = k % 2 == 0 ? receiver.max_ws_m[side] : receiver.min_ws_m[side];
            if (!receiver.receives || !receiver.visible || !sees(eye, p) || !reaches(own.lights[light], p)) continue;
            const Way way = way_to(own.lights[light], p);
            const View* view = serving(views, fits.lights()[light], eye, p);
            std::set<std::uint32_t> drawn;
            if (view) {
                const auto casters = fits.casters_of(*view);
                drawn = {casters.begin(), casters.end()};
            }
            bool blocked = false, missing = false, displaced = false;
            for (std::uint32_t c = 0; c < own.boxes.size(); ++c) {
                const double at_m = entry_m(own.boxes[c], p, way.toward, way.distance_m * (1.0 - 1e-9));
                if (!own.boxes[c].casts || &own.boxes[c] == &receiver || !(at_m > 1e-6 && std::isfinite(at_m))) continue;
                blocked = true;
                missing |= drawn.count(c) == 0;
                if (!view) continue;
                const glm::dvec3 there = map_place(*view, p + way.toward * at_m), here = map_place(*view, p);
                displaced |= !(glm::length(glm::dvec2(there - here)) < 1e-4);
            }
            ++verdict.points;
            verdict.blocked += blocked ? 1 : 0;
            // A lamp's face without a view has no caster that is seen.
            const bool looked_up = blocked || own.lights[light].kind == LightKind::directional;
            verdict.outside += looked_up && !(view && holds(map_place(*view, p))) ? 1 : 0;
            verdict.missing += missing ? 1 : 0;
            verdict.displaced += displaced ? 1 : 0;
        }
    return verdict;
}

class CoreFits : public ::testing::TestWithParam<LightKind> {
protected:
    std::uint32_t light() const { return static_cast<std::uint32_t>(GetParam()); }
    Verdict judged(const OwnScene& own, Random& random) {
        fit_shadows(own.scene(), {}, history, fits);
        return judge(own, light(), fits.views_of(light()), fits, random);
    }
    History history;
    Fits fits;
};

TEST_P(CoreFits, HoldWhatIsSeenAndAllThatDarkensIt) {
    Random random(print_seed());
    OwnScene own = courtyard();
    int blocked = 0;
    for (int frame = 0; frame < 40; ++frame) {
        const double turn = 0.15 * frame;
        own.cameras.clear();
        own.add_camera({14.0 * std::sin(turn), 2.0 + 0.2 * frame, 14.0 * std::cos(turn)}, {0.0, 0.0, 0.05 * frame});
        own.boxes.back().min_ws_m.x += 0.1, own.boxes.back().max_ws_m.x += 0.1;
        const Verdict verdict = judged(own, random);
        ASSERT_EQ(fits.lights()[light()].status, Status::fitted) << frame;
        EXPECT_TRUE(verdict.right()) << "frame " << frame << ": " << verdict.outside << " outside, " << verdict.missing
                                     << " missing, " << verdict.displaced << " displaced of " << verdict.points;
        EXPECT_GT(verdict.points, 300) << frame;
        blocked += verdict.blocked;
    }
    EXPECT_GT(blocked, 1000) << "shadows were looked at";
}

TEST_P(CoreFits, AreJudgedWrongWhereTheyAreWrong) {
    Random random(print_seed());
    const OwnScene own = courtyard();
    ASSERT_TRUE(judged(own, random).right());
    std::vector<View> bad(fits.views_of(light()).begin(), fits.views_of(light()).end());
    for (View& view : bad) view.anchor_ws_m += view.axis_u * 20.0;
    EXPECT_GT(judge(own, light(), bad, fits, random).outside, 0) << "maps beside what is seen";
    bad.assign(fits.views_of(light()).begin(), fits.views_of(light()).end());
    for (View& view : bad) view.casters.count = 0;
    EXPECT_GT(judge(own, light(), bad, fits, random).missing, 0) << "maps without casters";
}

TEST_P(CoreFits, LeaveOutWhatDarkensNothing) {
    OwnScene own = courtyard();
    Box far;
    far.min_ws_m = {-200.0, 0.0, -200.0};
    far.max_ws_m = far.min_ws_m + 1.0;
    const auto index = static_cast<std::uint32_t>(own.boxes.size());
    own.boxes.push_back(far);
    fit_shadows(own.scene(), {}, history, fits);
    const auto casters = fits.casters_of(light());
    EXPECT_FALSE(casters.empty());
    EXPECT_EQ(std::count(casters.begin(), casters.end(), index), 0);
    for (const std::uint32_t i : fits.receivers_of(light())) EXPECT_NE(i, index);
    for (const View& view : fits.views_of(light())) {
        const auto drawn = fits.casters_of(view);
        EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
        EXPECT_EQ(std::adjacent_find(drawn.begin(), drawn.end()), drawn.end());
        EXPECT_EQ(std::count(drawn.begin(), drawn.end(), index), 0);
    }
}

TEST_P(CoreFits, TakeLayersAndFlagsAsTheyAreGiven) {
    OwnScene own = courtyard();
    own.lights[light()].layers = 2;
    for (std::size_t i = 0; i < own.boxes.size(); ++i) own.boxes[i].cast_layers = i % 2 == 0 ? 1 : 2;
    fit_shadows(own.scene(), {}, history, fits);
    EXPECT_FALSE(fits.casters_of(light()).empty());
    for (const std::uint32_t i : fits.casters_of(light())) EXPECT_EQ(i % 2, 1u);
    for (Box& box : own.boxes) box.casts = false;
    fit_shadows(own.scene(), {}, history, fits);
    EXPECT_EQ(fits.lights()[light()].status, Status::no_caster);
    for (Box& box : own.boxes) box.visible = false;
    fit_shadows(own.scene(), {}, history, fits);
    EXPECT_EQ(fits.lights()[light()].status, Status::no_visible_receiver);
}

TEST_P(CoreFits, HaveNoLargerErrorsWhereLessIsAllowed) {
    OwnScene own = courtyard();
    own.lights[light()].shadow.cascades = 4;  // their number is chosen by more than the error
    double before_px = 0.0;
    std::uint32_t smallest_px = 0, first_px = 0;
    for (const float target_px : {8.0f, 2.0f, 0.5f}) {
        own.lights[light()].shadow.max_error_px = target_px;
        History fresh;
        fit_shadows(own.scene(), {}, fresh, fits);
        const LightFit& fit = fits.lights()[light()];
        EXPECT_EQ(fit.status, fit.meets_target ? Status::fitted : Status::error_above_target) << target_px;
        EXPECT_GT(fit.edge_error_px, 1.0);
        EXPECT_TRUE(!fit.meets_target || fit.edge_error_px <= static_cast<double>(target_px) + 1.0) << target_px;
        EXPECT_TRUE(before_px == 0.0 || fit.edge_error_px <= before_px) << target_px;
        EXPECT_GE(fit.map_px, smallest_px);
        before_px = fit.edge_error_px;
        smallest_px = fit.map_px;
        if (first_px == 0) first_px = fit.map_px;
    }
    EXPECT_GT(smallest_px, first_px);
    own.lights[light()].shadow.resolution_px = 64;
    fit_shadows(own.scene(), {}, history, fits);
    EXPECT_EQ(fits.lights()[light()].map_px, 64u);
    EXPECT_EQ(fits.lights()[light()].status, Status::error_above_target);
}

TEST_P(CoreFits, RememberWhatTheyHoldByTheirHistory) {
    OwnScene own = courtyard();
    fit_shadows(own.scene(), {}, history, fits);
    const History copy = history;
    own.cameras[0].position_ws_m += glm::dvec3(0.02, 0.01, 0.0);
    fit_shadows(own.scene(), {}, history, fits);
    EXPECT_FALSE(History() == history);
    std::vector<View> views(fits.views().begin(), fits.views().end());
    ASSERT_FALSE(views.empty());
    History again = copy;
    Fits others;
    fit_shadows(own.scene(), {}, again, others);
    ASSERT_EQ(others.views().size(), views.size());
    for (std::size_t v = 0; v < views.size(); ++v) {
        EXPECT_EQ(others.views()[v].clip_from_anchor, views[v].clip_from_anchor);
        EXPECT_EQ(others.views()[v].anchor_ws_m, views[v].anchor_ws_m);
    }
    EXPECT_TRUE(again == history) << "equal inputs and histories";
}

TEST_P(CoreFits, NameTheirContent) {
    OwnScene own = courtyard();
    const auto contents = [&] {
        fit_shadows(own.scene(), {}, history, fits);
        std::vector<std::uint64_t> found;
        for (const View& view : fits.views_of(light())) found.push_back(view.content);
        return found;
    };
    contents();
    const std::vector<std::uint64_t> before = contents();
    ASSERT_FALSE(before.empty());
    EXPECT_EQ(contents(), before) << "nothing moved";
    EXPECT_EQ(std::count(before.begin(), before.end(), 0u), 0);
    EXPECT_EQ(std::set<std::uint64_t>(before.begin(), before.end()).size(), before.size()) << "maps differ";
    const std::uint32_t caster = fits.casters_of(fits.views_of(light()).front()).back();
    own.boxes[caster].casts = false;
    EXPECT_NE(contents(), before) << "a caster is gone";
    own = courtyard();
    own.lights[light()].position_ws_m.y += 0.5;
    own.lights[light()].rotation_ws = looking(-own.lights[light()].position_ws_m);
    EXPECT_NE(contents(), before) << "the light moved";
}

INSTANTIATE_TEST_SUITE_P(Kinds, CoreFits, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

/// Judges every light of a scene by every camera.
void expect_right(const OwnScene& own, const Fits& fits, Random& random, int frame) {
    for (std::uint32_t light = 0; light < own.lights.size(); ++light)
        for (std::size_t camera = 0; camera < own.cameras.size(); ++camera) {
            ASSERT_TRUE(has_maps(fits.lights()[light].status)) << light << ": " << to_text(fits.lights()[light].status);
            const Verdict verdict = judge(own, light, fits.views_of(light), fits, random, camera);
            EXPECT_TRUE(verdict.right()) << "frame " << frame << ", light " << light << ", camera " << camera << ": "
                                         << verdict.outside << " outside, " << verdict.missing << " missing, "
                                         << verdict.displaced << " displaced of " << verdict.points;
            EXPECT_GT(verdict.blocked, 10) << light;
        }
}

TEST(CoreLights, OfAnyShapeHoldWhatIsSeen) {
    Random random(print_seed());
    OwnScene own = courtyard();
    own.lights.clear();
    own.add_light(LightKind::spot, {3.0, 5.0, 3.0}, {});
    own.add_light(LightKind::point, {900.0, 700.0, 400.0}, {}).range_m = 0.0f;
    own.add_light(LightKind::directional, {20.0, 30.0, 10.0}, {}).shadow.cascades = 4;
    own.add_light(LightKind::directional, {-20.0, 40.0, 10.0}, {}).shadow.fit = Fit::tight;
    own.add_light(LightKind::directional, {-20.0, 40.0, -10.0}, {}).shadow.fit = Fit::stable;
    History history;
    Fits fits;
    std::uint32_t most_layers = 0, both = 0;
    for (int frame = 0; frame < 40; ++frame) {
        own.lights[0].outer_cone_rad = frame < 20 ? 1.0f : 1.2f;  // it gets faces, gradually
        own.cameras[0].position_ws_m.z = 14.0 - 0.1 * frame;
        fit_shadows(own.scene(), {}, history, fits);
        if (!kSanitized || frame % 8 == 0) expect_right(own, fits, random, frame);
        most_layers = std::max(most_layers, fits.lights()[0].layers);
        both += fits.lights()[0].faces_share > 0.0 && fits.lights()[0].faces_share < 1.0 ? 1 : 0;
    }
    EXPECT_EQ(most_layers, 6u) << "five faces and the single view";
    EXPECT_GT(both, 4u);
    EXPECT_EQ(fits.lights()[0].faces_share, 1.0);
    EXPECT_FALSE(fits.lights()[1].cube) << "so far away one view looks at all";
    EXPECT_EQ(fits.lights()[2].layers, 4u);
}

TEST(CoreLights, ServeSeveralCameras) {
    Random random(print_seed());
    OwnScene own = courtyard();
    own.add_camera({-13.0, 5.0, 2.0}, {0.0, 0.0, 0.0});
    own.add_camera({2.0, 18.0, -6.0}, {0.0, 0.0, -1.0});
    own.cameras.back().projection = Projection::orthographic;
    own.cameras.back().half_height_m = 6.0;
    own.cameras.back().far_m = 1.0e5;
    History history;
    Fits fits;
    fit_shadows(own.scene(), {}, history, fits);
    expect_right(own, fits, random, 0);
    std::uint32_t cameras = 0;
    for (const View& view : fits.views()) cameras |= view.cameras;
    EXPECT_EQ(cameras, 7u);
}

TEST(CoreSuns, KeepTheirMapsWhileTheCameraMovesALittle) {
    OwnScene own = courtyard();
    own.lights.resize(1);
    History history;
    Fits fits;
    const auto moves = [&](double step_m) {
        int moved = 0;
        glm::mat4 last(0.0f);
        for (int frame = 0; frame < 100; ++frame) {
            own.cameras[0].position_ws_m.x += step_m;
            fit_shadows(own.scene(), {}, history, fits);
            const glm::mat4 now = fits.views().front().clip_from_anchor;
            moved += now != last ? 1 : 0;
            last = now;
        }
        return moved;
    };
    EXPECT_LT(moves(0.001), 10) << "in steps";
    own.lights[0].shadow.fit = Fit::tight;
    EXPECT_GT(moves(0.001), 90) << "new in every frame";
}

}  // namespace
}  // namespace gnomon::core
