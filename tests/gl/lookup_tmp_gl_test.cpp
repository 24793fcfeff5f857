#include <chrono>
#include <cstdio>
#include "tests/gl/lookup_fixture.h"
namespace gnomon {
class Tmp : public LookupTest {};
TEST_F(Tmp, Times) {
    const std::uint32_t plane = add_mesh(game::make_card({0, 0, 0}, {0, 0, 6}, {6, 0, 0}));
    place(plane, {}, false);
    add_camera({}, {0.0, 5.0, 7.0}, {0.0, -5.0, -7.0});
    settings.viewport_px = {32, 32};
    add_light({.kind = LightKind::spot, .intensity = 100.0f}, {0, 3, 0}, {0, -1, 0.1});
    using enum ShadowFilter;
    const auto ms = [](auto a, auto b) { return std::chrono::duration<double, std::milli>(b - a).count(); };
    for (const std::vector<ShadowFilter>& set : std::vector<std::vector<ShadowFilter>>{{hard}, {hardware_2x2}, {pcf_bilinear}, {sharp_4x4}, {triangles}, {pcss}}) {
        table.reset(); lighting.reset(); shadows.reset(); scene.reset();
        start(set);
        run();
        const auto t0 = std::chrono::steady_clock::now();
        const gl::ProgramHandle program = surface_program();
        device().finish();
        const auto t1 = std::chrono::steady_clock::now();
        looked_up(program);
        const auto t2 = std::chrono::steady_clock::now();
        printf("%d: text %zu link %g first %g\n", int(set.size() == 1 ? set[0] : count), text.size(), ms(t0, t1), ms(t1, t2));
        fflush(stdout);
    }
}
}
