#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/long_run.h"
#include "tests/stability/random_planes.h"
#include "tests/unit/math/random_seed.h"

/// A plane never shadows itself, and an offset a tenth smaller would not do: for every kind of light, filter and
/// format. 20 000 planes of each in a short run, 50 000 with GNOMON_LONG, any number with GNOMON_PLANES (a million is
/// recorded in docs/contributors/reliability.md).
namespace gnomon {
namespace {

std::uint64_t plane_count() {
    // Nine tenths of a disk's offset, which is looser than need be, fail for one plane of a thousand.
    constexpr std::uint64_t kShort = kSanitized ? 10000 : 20000, kLong = kSanitized ? kShort : 50000;
    if (const char* count = std::getenv("GNOMON_PLANES")) return std::strtoull(count, nullptr, 10);
    return is_long_run() ? kLong : kShort;
}

struct Row {
    PlaneKind kind;
    ShadowFilter filter;
};

class RandomPlanes : public ::testing::TestWithParam<Row> {};

TEST_P(RandomPlanes, AreLitWithTheAutomaticBiasAndDarkInPlacesWithLess) {
    const shadow::FilterRow& filter = shadow::filter_row(GetParam().filter);
    if (!can_judge(filter.id)) GTEST_SKIP() << filter.name << " is not among the rows that are compiled as C++";
    const std::uint64_t count = plane_count(), seed = print_seed();
    std::uint64_t dark_with_less = 0;  // few with `triangles`: its texels decide only where corners cannot
    for (const shadow::DepthFormatRow& format : shadow::kDepthFormats) {
        const PlaneTally tally = judge_planes(GetParam().kind, filter.id, format.id, count, seed);
        char line[160];
        std::snprintf(line, sizeof line,
                      "%-10s %-18s step %-9.3g %8llu planes, dark %llu, with nine tenths %llu (%.1f %%)\n",
                      plane_kind_name(GetParam().kind), std::string(filter.name).c_str(), format.step,
                      static_cast<unsigned long long>(tally.planes), static_cast<unsigned long long>(tally.dark),
                      static_cast<unsigned long long>(tally.dark_with_less),
                      100.0 * static_cast<double>(tally.dark_with_less) / static_cast<double>(tally.planes));
        std::cout << line;
        EXPECT_EQ(tally.dark, 0u);
        dark_with_less += tally.dark_with_less;
        EXPECT_GT(tally.looked_up, count - count / 10) << "most of the planes were outside of their map";
        EXPECT_GT(tally.steep, count / 4) << "steep slopes are hardly tried";
    }
    EXPECT_GT(dark_with_less, 0u) << "a bias that is larger than it need be, or a test that sees nothing";
}

std::vector<Row> rows() {
    std::vector<Row> all;
    for (std::size_t kind = 0; kind < static_cast<std::size_t>(PlaneKind::count); ++kind)
        for (const shadow::FilterRow& filter : shadow::filter_table())
            // Lights here have no size, and without one soft_triangles never reads a depth of the receiver's own
            // surface. SoftShadows.OfAPlaneAlone... (tests/gl) judges it with a size.
            if (filter.id != ShadowFilter::soft_triangles) all.push_back({static_cast<PlaneKind>(kind), filter.id});
    return all;
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, RandomPlanes, ::testing::ValuesIn(rows()), [](const auto& row) {
    return plane_kind_name(row.param.kind) + ("_" + std::string(shadow::filter_row(row.param.filter).name));
});

}  // namespace
}  // namespace gnomon
