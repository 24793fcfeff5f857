#include "tests/gl/device_fixture.h"

namespace gnomon {
namespace {

using DeviceDepth = DeviceTest;

TEST_F(DeviceDepth, ATriangleAtADepthLeavesOutWhatLiesThereAndBehindAndMayReadTheDepthItTests) {
    // Columns of depth 0, 1/16, 2/16 and so on; the triangle counts those it reaches, and reads them meanwhile.
    const auto columns = full_screen("gl_FragDepth = floor(gl_FragCoord.x) / 16.0; result = vec4(0.0);");
    const auto reads = full_screen("result = vec4(1.0, texelFetch(stored, ivec2(gl_FragCoord.xy), 0).r, 0.0, 1.0);",
                                   "layout(binding = 0) uniform sampler2D stored;", "0.9");
    for (const std::uint32_t from : {0u, 5u, 15u}) {
        gl::CommandList list;
        list.add(clearing(target));
        list.add(gl::SetPipeline{{.program = columns, .depth_write = true}});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        list.add(keeping(target));
        list.add(gl::SetPipeline{{.program = reads, .depth_test = gl::DepthTest::less, .blend = gl::Blend::add}});
        list.add(gl::BindTexture{0, depth, {}});
        list.add(gl::DrawTriangle{static_cast<float>(from) / 16.0f});
        list.add(gl::SetPipeline{{.program = reads, .depth_test = gl::DepthTest::less}});
        list.add(gl::SetScissor{{0, 0, 1, 1}});
        list.add(gl::DrawTriangle{});  // at its own depth again, 0.9: nothing lies before that but the last column
        list.add(gl::EndPass{});
        run(list);
        const std::vector<Rgba> image = pixels();
        for (std::uint32_t x = 0; x < kSize_px; ++x) {
            const Rgba pixel = at(image, x, 7);
            EXPECT_EQ(pixel[0], x > from ? 255 : 0) << "column " << x << " from " << from;
            EXPECT_NEAR(pixel[1], x > from ? 255.0 * x / 16.0 : 0.0, 1.0);
        }
        EXPECT_EQ(at(image, 0, 0)[0], 0);
    }
}

}  // namespace
}  // namespace gnomon
