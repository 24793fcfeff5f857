#include <algorithm>
#include <glm/vec4.hpp>
#include <random>
#include <set>

#include "systems/lighting/ray_list.h"
#include "tests/gl/probe_fixture.h"
#include "tests/unit/math/random_seed.h"

/// Where in a picture a list's rays lie. Shaders give each place a texel of its own, and from that texel find the
/// place.
namespace gnomon {
namespace {

const std::string kListProbe = R"(#include "lighting/trace/ray_list_layout.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = 2) buffer Asked { ivec4 asked[]; };
layout(std430, binding = 1) buffer Found { ivec4 found[]; };
void main() {
    uint i = gl_WorkGroupID.x;
    int width = list_width(asked[i].xy);
    ivec2 texel = list_texel(asked[i].z, width);
    found[i] = ivec4(texel, list_place(texel, width), list_rows(asked[i].x * asked[i].y, width) << 16 | width);
}
)";

struct ListFound {
    glm::uvec2 texel{0u};
    std::uint32_t place = 0, size = 0;
};

class RayListTexels : public ProbeTest {
protected:
    std::vector<ListFound> find(glm::uvec2 picture_px, const std::vector<std::uint32_t>& places) {
        std::vector<glm::uvec4> asked;
        for (const std::uint32_t place : places) asked.emplace_back(picture_px, place, 0u);
        gl::CommandList list;
        list.add(gl::BindStorage{2, fixed_buffer(asked)});
        return probed<ListFound>(kListProbe, static_cast<std::uint32_t>(asked.size()), asked.size(), std::move(list));
    }
};

TEST_F(RayListTexels, EachPlaceHasATexelOfItsOwn) {
    for (const glm::uvec2 picture_px :
         {glm::uvec2(1, 1), glm::uvec2(3, 5), glm::uvec2(64, 64), glm::uvec2(1, 700), glm::uvec2(257, 129)}) {
        std::vector<std::uint32_t> places(std::size_t{picture_px.x} * picture_px.y);
        for (std::uint32_t i = 0; i < places.size(); ++i) places[i] = i;
        const glm::uvec2 size_px = lighting::ray_list_size_px(picture_px);
        std::set<std::pair<std::uint32_t, std::uint32_t>> texels;
        const auto found = find(picture_px, places);
        for (std::uint32_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].place, i);
            EXPECT_TRUE(found[i].texel.x < size_px.x && found[i].texel.y < size_px.y) << i;
            texels.insert({found[i].texel.x, found[i].texel.y});
        }
        EXPECT_EQ(texels.size(), places.size()) << picture_px.x << " x " << picture_px.y;
    }
}

TEST_F(RayListTexels, LargePicturesHaveRoomWithinWhatOpenGlPromises) {
    std::mt19937_64 random(print_seed());
    for (const glm::uvec2 picture_px : {glm::uvec2(1280, 720), glm::uvec2(1283, 719), glm::uvec2(7680, 4320),
                                        glm::uvec2(16384, 1), glm::uvec2(16384, 16384)}) {
        const std::uint32_t count = picture_px.x * picture_px.y;
        std::vector<std::uint32_t> places = {0, 1, 7, 8, count / 2, count - 1};
        for (int i = 0; i < 200; ++i) places.push_back(static_cast<std::uint32_t>(random() % count));
        const glm::uvec2 size_px = lighting::ray_list_size_px(picture_px);
        EXPECT_LE(std::max(size_px.x, size_px.y), 16384u);
        for (std::size_t i = 0; const ListFound& found : find(picture_px, places)) {
            EXPECT_EQ(found.place, places[i++]);
            EXPECT_EQ(found.size, size_px.y << 16 | size_px.x);
            EXPECT_TRUE(found.texel.x < size_px.x && found.texel.y < size_px.y) << found.place;
        }
    }
}

}  // namespace
}  // namespace gnomon
