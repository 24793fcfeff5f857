#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::oracle {
namespace {

TEST(ReferenceTracer, LayersDecideWhoCastsUnderALightAndWhoTakesItsShadow) {
    AnalyticScene scene;
    scene.place_floor(20.0);
    scene.place(scene.add_cube(), {0.1, 2.3, -0.2});
    const auto dark = [&](int caster, int light, int receiver) {
        scene.snapshot.instances[0].receive_layers = static_cast<ShadowLayers>(receiver);
        scene.snapshot.instances[1].cast_layers = static_cast<ShadowLayers>(caster);
        scene.snapshot.instances[1].visible = false;
        const ReferenceTracer tracer = scene.tracer();
        LightItem sun = scene.sun({0.0, 1.0, 0.0});
        sun.shadow.layers = static_cast<ShadowLayers>(light);
        const auto v = tracer.visibility(tracer.trace_primary(scene.view_from_above(64, 8.0)), sun);
        return std::count(v.begin(), v.end(), 0.0f);
    };
    const auto shadow = dark(0xff, 0xff, 0xff);
    EXPECT_GT(shadow, 0);
    EXPECT_EQ(dark(0x01, 0x03, 0x02), shadow) << "each meets the light, not the other";
    EXPECT_EQ(dark(0x01, 0x02, 0x02), 0) << "the caster is of no layer of the light";
    EXPECT_EQ(dark(0x02, 0x02, 0x01), 0) << "the receiver is of no layer of the light";
    EXPECT_EQ(dark(0x80, 0x80, 0x80), shadow);
    EXPECT_EQ(dark(0xff, 0x00, 0xff), 0);
}

}  // namespace
}  // namespace gnomon::oracle
