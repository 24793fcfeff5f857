#include "systems/shadow/publish/lookup_accuracy.h"

#include <gtest/gtest.h>

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

constexpr double kExtent_px = 0.75, kWideTexel_m = 0.25, kFarRounding_px = 0.01;

/// One light with one view, in a map of the size that it was fitted for. The view's errors are those of `filter`.
struct Case {
    explicit Case(ShadowFilter filter) : fitted{std::vector<FitChoice>(1), std::vector<ShadowView>(1), {}, {}, {}} {
        const FilterRow& row = filter_row(filter);
        decision.request.map.filter = filter;
        decision.request.map.resolution_px = 512;
        decision.request.rays.used = row.rays;
        fitted.lights[0].views.count = 1;
        view().error.extent_px = kExtent_px;
        const auto reach_texel = static_cast<double>(row.reach_texel - row.still_texel);
        view().error.texel_m = kWideTexel_m;
        view().error.rounding_px = kFarRounding_px;
        view().error.texel_edge_px = edge_error_px(kExtent_px, reach_texel);
        view().error.resolved_m = resolved_width_texel(reach_texel) * kWideTexel_m;
        state_edges(row.storage.triangle_ids, view());
        map.texture = {1};
        map.size_px = 512;
    }
    ShadowView& view() { return fitted.views[0]; }
    DrawnViews drawn() const { return {fitted, {&decision, 1}, {&map, 1}, {&plan, 1}, {&status, 1}}; }
    LookupAccuracy by(ShadowFilter filter) const {
        LookupAccuracy accuracy{filter, 0.0, false, {}};
        add_view(light, drawn(), 0, accuracy);
        return accuracy;
    }
    ShadowFilter published(bool rays) const { return published_filter(drawn(), 0, rays); }
    Case without_map() const {
        Case bare = *this;
        bare.map = {};
        return bare;
    }
    LightItem light;
    FittedViews fitted;
    BudgetDecision decision;
    MapAssignment map;
    UpdatePlan plan;
    LightStatus status;
};

TEST(LookupAccuracy, OfOneTapIsWhatAFitForOneTapSays) {
    const double plain_px = Case(kCheapestFilter).view().error.edge_px;
    for (const FilterRow& row : filter_table())
        EXPECT_DOUBLE_EQ(Case(row.id).by(kCheapestFilter).predicted_error_px, plain_px) << row.name;
    EXPECT_DOUBLE_EQ(plain_px, kExtent_px + 1.0);
}

TEST(LookupAccuracy, OfItsOwnFilterIsWhatItsFitSays) {
    const Case wide(ShadowFilter::hardware_2x2);
    EXPECT_DOUBLE_EQ(wide.by(wide.decision.request.map.filter).predicted_error_px, 1.5 * kExtent_px + 1.0);
    EXPECT_FALSE(wide.by(wide.decision.request.map.filter).keeps_max_error) << "of one pixel";
    EXPECT_TRUE(wide.by(kCheapestFilter).keeps_max_error);
}

TEST(LookupAccuracy, OfWalksDependsOnNoTexelButOnThoseThatFindACaster) {
    Case walks(ShadowFilter::triangles);
    const LookupAccuracy fine = walks.by(ShadowFilter::triangles);
    EXPECT_DOUBLE_EQ(fine.predicted_error_px, walk_error_px(kFarRounding_px));
    EXPECT_LT(fine.predicted_error_px, 1.0);
    EXPECT_TRUE(fine.keeps_max_error);
    EXPECT_DOUBLE_EQ(fine.resolved.px, kExtent_px / kSteepestReceiver);
    EXPECT_DOUBLE_EQ(fine.resolved.m, kWideTexel_m);
    walks.map.size_px = 128;
    const LookupAccuracy coarse = walks.by(ShadowFilter::triangles);
    EXPECT_DOUBLE_EQ(coarse.predicted_error_px, walk_error_px(kFarRounding_px));
    EXPECT_DOUBLE_EQ(coarse.resolved.px, 4.0 * fine.resolved.px);
    EXPECT_DOUBLE_EQ(coarse.resolved.m, 4.0 * fine.resolved.m);
    walks.map.size_px = 512;
    state_edges(false, walks.view());
    EXPECT_DOUBLE_EQ(walks.by(ShadowFilter::triangles).predicted_error_px, kExtent_px + 1.0) << "casters by depth";
}

TEST(LookupAccuracy, SaysWhetherTheNarrowestCasterThatMustCountIsResolved) {
    Case c(ShadowFilter::triangles);
    EXPECT_TRUE(c.by(ShadowFilter::triangles).resolved.keeps_narrowest) << "no wish";
    for (const float wish_px : {0.5f, 0.3f}) {
        c.light.shadow.narrowest_caster_px = wish_px;
        EXPECT_EQ(c.by(ShadowFilter::triangles).resolved.keeps_narrowest, wish_px > 0.4f) << wish_px;
        EXPECT_TRUE(c.by(ShadowFilter::triangles).keeps_max_error) << "another wish";
    }
    EXPECT_FALSE(Case(ShadowFilter::triangles).without_map().by(ShadowFilter::triangles).resolved.keeps_narrowest);
}

TEST(LookupAccuracy, GrowsWithTexelsThatAreMissingAndWithCastersThatMoved) {
    Case c(ShadowFilter::exact);
    c.map.size_px = 256;
    EXPECT_DOUBLE_EQ(c.by(kCheapestFilter).predicted_error_px, 2.0 * kExtent_px + 1.0);
    EXPECT_FALSE(c.by(kCheapestFilter).keeps_max_error);
    c.map.size_px = 512;
    c.plan.stale.error_px = 0.25;
    EXPECT_DOUBLE_EQ(c.by(kCheapestFilter).predicted_error_px, kExtent_px + 1.25);
    c.decision.refresh_frames = 2;
    EXPECT_FALSE(c.by(kCheapestFilter).keeps_max_error) << "it may wait longer";
}

TEST(LookupAccuracy, OfWhatIsNotLookedUpIsNothing) {
    Case lit(ShadowFilter::triangles), none(ShadowFilter::triangles), unseen(ShadowFilter::triangles);
    lit.view().lit = true;
    none.map.texture = {};
    unseen.view().error = {};
    for (const Case& c : {lit, none, unseen}) EXPECT_EQ(c.by(kCheapestFilter).predicted_error_px, 0.0);
    EXPECT_FALSE(lit.by(kCheapestFilter).keeps_max_error);
}

TEST(LookupAccuracy, OfMapsThatWereLostIsNothing) {
    Case lost(ShadowFilter::triangles);
    lost.status.lose_maps(Reason::depth_program_failed, false);
    EXPECT_EQ(lost.by(kCheapestFilter).predicted_error_px, 0.0);
    EXPECT_EQ(lost.published(false), ShadowFilter::automatic);
}

TEST(LookupAccuracy, IsOfTheFilterThatIsPublished) {
    const Case exact(ShadowFilter::exact), moments(ShadowFilter::vsm), usual(ShadowFilter::triangles);
    EXPECT_EQ(exact.published(true), ShadowFilter::exact);
    EXPECT_EQ(exact.without_map().published(true), ShadowFilter::exact) << "rays do without a map";
    EXPECT_EQ(exact.published(false), kCheapestFilter);
    EXPECT_EQ(exact.without_map().published(false), ShadowFilter::automatic);
    EXPECT_EQ(moments.published(true), kCheapestFilter) << "no moments were made";
    EXPECT_EQ(usual.published(false), ShadowFilter::triangles);
    EXPECT_EQ(usual.without_map().published(false), ShadowFilter::automatic);
}

}  // namespace
}  // namespace gnomon::shadow
