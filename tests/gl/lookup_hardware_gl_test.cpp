#include <string_view>

#include "tests/gl/lights_fixture.h"

/// The text for hardware, which picks its array at each read, on whatever device there is.
namespace gnomon {
namespace {

/// The same as textureGather, which Mesa 22.3's llvmpipe lacks beside texel buffers.
constexpr std::string_view kGatheredOneByOne = R"(
ivec3 low_texel(ivec3 size, vec3 place) { return ivec3(floor(place.xy * vec2(size.xy) - 0.5), int(place.z + 0.5)); }
ivec3 inside(ivec3 size, ivec3 texel) { return ivec3(clamp(texel.xy, ivec2(0), size.xy - 1), texel.z); }
vec4 gathered(sampler2DArray map, vec3 place) {
    ivec3 size = textureSize(map, 0), low = low_texel(size, place);
    return vec4(texelFetch(map, inside(size, low + ivec3(0, 1, 0)), 0).x, texelFetch(map, inside(size, low + ivec3(1, 1, 0)), 0).x,
                texelFetch(map, inside(size, low + ivec3(1, 0, 0)), 0).x, texelFetch(map, inside(size, low), 0).x);
}
uvec4 gathered(usampler2DArray map, vec3 place, int component) {
    ivec3 size = textureSize(map, 0), low = low_texel(size, place);
    return uvec4(texelFetch(map, inside(size, low + ivec3(0, 1, 0)), 0)[component], texelFetch(map, inside(size, low + ivec3(1, 1, 0)), 0)[component],
                 texelFetch(map, inside(size, low + ivec3(1, 0, 0)), 0)[component], texelFetch(map, inside(size, low), 0)[component]);
}
)";

TEST_F(AllLights, AreSeenTheSameByTheTextForHardware) {
    add_eight();
    start({.filters = kFew, .for_hardware = true});
    if (device().info().is_software) {
        const std::string_view call = "textureGather(", own = "gathered(";
        std::size_t gathers = 0;
        for (std::size_t at = text.find(call); at != std::string::npos; at = text.find(call, at), ++gathers)
            text.replace(at, call.size(), own);
        EXPECT_GE(gathers, 3u * kBindings.texture_unit_count / 5);
        text.insert(0, kGatheredOneByOne);
    }
    run();
    expect_alike(surface_program());
}

}  // namespace
}  // namespace gnomon
