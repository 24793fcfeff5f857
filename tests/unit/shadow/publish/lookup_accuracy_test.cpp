#include "systems/shadow/publish/lookup_accuracy.h"

#include <gtest/gtest.h>

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

constexpr double kExtent_px = 0.75;

/// A view whose fit counts with `filter`, in a map of its own size.
struct Case {
    explicit Case(ShadowFilter filter) {
        const FilterRow& row = filter_row(filter);
        demand.filter = filter;
        demand.resolution_px = 512;
        demand.asks_rays = asks_rays(row);
        view.texel_extent_px = kExtent_px;
        view.predicted_error_px = edge_error_px(kExtent_px, static_cast<double>(row.reach_texel - row.still_texel));
        slot.texture = {1};
        slot.size_px = 512;
    }
    LookupAccuracy by(ShadowFilter filter) const {
        LookupAccuracy accuracy{filter, 0.0, false};
        add_view(light, demand, view, slot, accuracy);
        return accuracy;
    }
    LightItem light;
    ShadowDemand demand;
    ShadowView view;
    ShadowSlot slot;
};

TEST(LookupAccuracy, OfOneTapIsWhatAFitForOneTapSays) {
    const double plain_px = Case(kPlainFilter).view.predicted_error_px;
    for (const FilterRow& row : filter_table())
        EXPECT_DOUBLE_EQ(Case(row.id).by(kPlainFilter).predicted_error_px, plain_px) << row.name;
    EXPECT_DOUBLE_EQ(plain_px, kExtent_px + 1.0);
}

TEST(LookupAccuracy, OfItsOwnFilterIsWhatItsFitSays) {
    const Case wide(ShadowFilter::hardware_2x2);
    EXPECT_DOUBLE_EQ(wide.by(wide.demand.filter).predicted_error_px, 1.5 * kExtent_px + 1.0);
    EXPECT_FALSE(wide.by(wide.demand.filter).keeps_max_error) << "of one pixel";
    EXPECT_TRUE(wide.by(kPlainFilter).keeps_max_error);
}

TEST(LookupAccuracy, GrowsWithTexelsThatAreMissingAndWithCastersThatMoved) {
    Case c(ShadowFilter::exact);
    c.slot.size_px = 256;
    EXPECT_DOUBLE_EQ(c.by(kPlainFilter).predicted_error_px, 2.0 * kExtent_px + 1.0);
    EXPECT_FALSE(c.by(kPlainFilter).keeps_max_error);
    c.slot.size_px = 512;
    c.slot.stale.error_px = 0.25;
    EXPECT_DOUBLE_EQ(c.by(kPlainFilter).predicted_error_px, kExtent_px + 1.25);
    c.demand.refresh_frames = 2;
    EXPECT_FALSE(c.by(kPlainFilter).keeps_max_error) << "it may wait longer";
}

TEST(LookupAccuracy, OfWhatIsNotLookedUpIsNothing) {
    Case lit(ShadowFilter::triangles), none(ShadowFilter::triangles), unseen(ShadowFilter::triangles);
    lit.view.lit = true;
    none.slot.texture = {};
    unseen.view.predicted_error_px = unseen.view.texel_extent_px = 0.0;
    for (const Case& c : {lit, none, unseen}) EXPECT_EQ(c.by(kPlainFilter).predicted_error_px, 0.0);
    EXPECT_FALSE(lit.by(kPlainFilter).keeps_max_error);
}

TEST(LookupAccuracy, IsOfTheFilterThatIsPublished) {
    const Case exact(ShadowFilter::exact), moments(ShadowFilter::vsm), usual(ShadowFilter::triangles);
    EXPECT_EQ(published_filter(exact.demand, exact.slot, true), ShadowFilter::exact);
    EXPECT_EQ(published_filter(exact.demand, {}, true), ShadowFilter::exact) << "rays do without a map";
    EXPECT_EQ(published_filter(exact.demand, exact.slot, false), kPlainFilter);
    EXPECT_EQ(published_filter(exact.demand, {}, false), ShadowFilter::automatic);
    EXPECT_EQ(published_filter(moments.demand, moments.slot, true), kPlainFilter) << "no moments were made";
    EXPECT_EQ(published_filter(usual.demand, usual.slot, false), ShadowFilter::triangles);
    EXPECT_EQ(published_filter(usual.demand, {}, false), ShadowFilter::automatic);
}

}  // namespace
}  // namespace gnomon::shadow
