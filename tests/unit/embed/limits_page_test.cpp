#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "engine/gl/device.h"
#include "gnomon/light.h"
#include "gnomon/shadow_tuning.h"
#include "systems/extract/gpu_scene.h"
#include "systems/lookup/lookup_rows.h"
#include "systems/shadow/frame/index_range.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/source_paths.h"

// The numbers of docs/reference/limits.md are those of the code. That the code keeps them is tested where they apply.
namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string text_of(const char* file) {
    std::ifstream in(test::source_folder() / file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// Returns the second cell of the page's row with that first cell, without its marks of figures. Empty: there is none.
std::string limit(const std::string& what) {
    const std::string page = text_of("docs/reference/limits.md"), start = "\n| " + what + " | ";
    const std::size_t row = page.find(start);
    if (row == std::string::npos) return "";
    const std::size_t from = row + start.size();
    std::string cell = page.substr(from, page.find(" |\n", from) - from);
    const std::string end = "-->";
    for (std::size_t mark = cell.find("<!--"); mark != std::string::npos; mark = cell.find("<!--"))
        cell.erase(mark, cell.find(end, mark) + end.size() - mark);
    return cell;
}

/// Returns the number as pages write it, in groups of three digits.
std::string number(std::uint64_t value) {
    std::string text = std::to_string(value);
    for (std::size_t at = text.size(); value > 9999 && at > 3;) text.insert(at -= 3, " ");
    return text;
}

TEST(LimitsPage, HasTheNumbersOfTheCode) {
    EXPECT_THAT(limit("cascades of a sun"), StartsWith(number(kMaxCascades) + "; "));
    EXPECT_THAT(limit("cascades of a sun"),
                HasSubstr("up to " + number(shadow::light_kind_row(LightKind::directional).layers) + " are chosen"));
    EXPECT_EQ(limit("shadow layers"), number(std::numeric_limits<ShadowLayers>::digits));
    EXPECT_THAT(limit("filter"),
                StartsWith(number(kMostFilterSize) + " texels; " + number(kMostFilterTaps) + " taps; spread of " +
                           number(static_cast<std::uint64_t>(kMostSpread_texel)) + " texels"));
    EXPECT_EQ(kMostSourceRadius_m, 1.0e4f);
    EXPECT_THAT(limit("source of a light"), HasSubstr("radius up to 1e4 m"));
    constexpr double kDegrees = 180.0 / 3.14159265358979;
    const auto disk_deg = std::lround(static_cast<double>(kMostSunRadius_rad) * kDegrees);
    EXPECT_THAT(limit("source of a light"), HasSubstr("disk up to " + std::to_string(disk_deg) + "°"));
    EXPECT_THAT(limit("texture units of lookups"), StartsWith(number(lookup::kLeastTextureUnits) + " at least"));
    constexpr std::uint64_t kGuaranteedTexels = 65536;  // OpenGL's least MAX_TEXTURE_BUFFER_SIZE
    EXPECT_THAT(limit("casters and meshes"),
                HasSubstr(number(kGuaranteedTexels * gl::kTexelBytes / sizeof(InstanceRecord)) + " instances"));
    std::uint32_t own = 0;  // views with a bit of their own
    while (shadow::consumer_bit(own) != shadow::consumer_bit(own + 1)) ++own;
    EXPECT_THAT(limit("views"), HasSubstr("from the " + std::to_string(own + 1) + "nd on"));
}

TEST(LimitsPage, HasTheVersionsOfTheBuild) {
    const std::string build = text_of("CMakeLists.txt"), least = limit("CMake");
    EXPECT_THAT(build, HasSubstr("cmake_minimum_required(VERSION " + least.substr(0, least.find(' ')) + ")"));
    EXPECT_THAT(build, HasSubstr("set(CMAKE_CXX_STANDARD " + limit("C++") + ")"));
}

TEST(LimitsPage, IsReadRowByRow) {
    EXPECT_EQ(limit("no such row"), "");
    EXPECT_THAT(limit("filter"), Not(HasSubstr("source")));
    EXPECT_EQ(number(2048), "2048");
    EXPECT_EQ(number(16384), "16 384");
    EXPECT_EQ(number(1234567), "1 234 567");
}

}  // namespace
}  // namespace gnomon
