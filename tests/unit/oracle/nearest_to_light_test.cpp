#include <gtest/gtest.h>

#include "tests/unit/oracle/analytic_scene.h"

// A map shows the caster that is nearest to the light, of several one above the other.
namespace gnomon::oracle {
namespace {

class NearestToLight : public ::testing::Test {
protected:
    /// Places a floor, and squares of 4 m above its middle, one for each metre up to 60 and in no order of height. They
    /// fill several leaves of the tree, so that what a search meets first is not the highest.
    NearestToLight() {
        scene.place_floor(20.0);
        const std::uint32_t square = scene.add_square();
        for (int i = 1; i <= kHighest_m; ++i)
            scene.place(square, {0.0, i * 37 % (kHighest_m + 1), 0.0}, glm::dmat3({4, 0, 0}, {0, 0, -4}, {0, 4, 0}));
    }
    /// Returns the height of what is nearest to the light above a place near the floor's middle, metres. 0: nothing.
    double height_m(const LightItem& light, double least_m = 0.0) const {
        const ReferenceTracer tracer = scene.tracer();
        const std::uint32_t floor = 0;
        EXPECT_EQ(tracer.source_of(floor).instance, 0u);
        const std::uint32_t found = tracer.nearest_to_light({0.3, 0.0, 0.2}, floor, light, least_m);
        if (found == kNoTriangle) return 0.0;
        return scene.snapshot.instances[tracer.source_of(found).instance].translation_ws_m.y;
    }
    static constexpr int kHighest_m = 60;  // one less than a prime, for each height to come once
    AnalyticScene scene;
};

TEST_F(NearestToLight, UnderASunIsTheHighest) {
    EXPECT_EQ(height_m(scene.sun({0.0, 1.0, 0.0})), kHighest_m);
    EXPECT_EQ(height_m(scene.sun({0.01, 1.0, 0.0})), kHighest_m);
    EXPECT_EQ(height_m(scene.sun({0.2, 1.0, 0.0})), 8.0) << "the ray leaves the stack at 8.5 m";
    EXPECT_EQ(height_m(scene.sun({1.0, 0.1, 0.0})), 0.0);
}

TEST_F(NearestToLight, UnderALampLiesBelowIt) {
    for (const int below : {1, 4, 17, 33, 59}) EXPECT_EQ(height_m(scene.lamp({0.3, below + 0.5, 0.2})), below);
    EXPECT_EQ(height_m(scene.lamp({0.3, 0.5, 0.2})), 0.0);
    EXPECT_EQ(height_m(scene.lamp({0.3, 400.0, 0.2})), kHighest_m);
}

TEST_F(NearestToLight, IsNoNearerToThePlaceThanRequired) {
    EXPECT_EQ(height_m(scene.sun({0.0, 1.0, 0.0}), 59.5), kHighest_m);
    EXPECT_EQ(height_m(scene.sun({0.0, 1.0, 0.0}), 60.5), 0.0);
    EXPECT_EQ(height_m(scene.lamp({0.3, 4.5, 0.2}), 4.2), 0.0);
    EXPECT_EQ(height_m(scene.lamp({0.3, 4.5, 0.2}), 5.0), 0.0) << "farther than the lamp";
}

TEST_F(NearestToLight, CastsUnderTheLight) {
    for (InstanceItem& item : scene.snapshot.instances)
        if (item.translation_ws_m.y > 41.5) item.cast_layers = 0x02;
    LightItem sun = scene.sun({0.0, 1.0, 0.0});
    sun.shadow.layers = 0x01;
    EXPECT_EQ(height_m(sun), 41.0) << "all above are of another layer";
}

}  // namespace
}  // namespace gnomon::oracle
