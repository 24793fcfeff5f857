#include "tests/stability/hard_cases.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/stability/hard_cases_oracle.h"

namespace gnomon::hard {

std::span<const HardCase> hard_cases() {
    static const std::vector<HardCase> all = [] {
        std::vector<HardCase> rows;
        for (const auto part : {light_cases(), camera_cases(), mesh_cases()})
            rows.insert(rows.end(), part.begin(), part.end());
        return rows;
    }();
    return all;
}

std::size_t expect_sound(World& world, const char* what, std::size_t* darkened) {
    Stages stages(world);
    stages.run();
    return expect_sound(stages, what, darkened);
}

std::size_t expect_sound(const Stages& stages, const char* what, std::size_t* darkened) {
    const Verdict verdict = judge(stages);
    EXPECT_EQ(verdict.wrong(), 0u) << what << ": " << verdict.first << "; outside " << verdict.outside << ", missed "
                                   << verdict.missed << ", not finite " << verdict.not_finite << ", without reason "
                                   << verdict.no_reason << ", wrongly skipped " << verdict.wrong_skip << ", audit "
                                   << verdict.audit_wrong << " of " << verdict.seen << " points";
    EXPECT_TRUE(stages.device().findings().empty()) << what;
    if (darkened) *darkened = verdict.darkened;
    return verdict.seen;
}

}  // namespace gnomon::hard
