#include <gmock/gmock.h>

#include <algorithm>

#include "bench/audit/audit_command.h"
#include "tests/gl/hard_case_fixture.h"
#include "tests/gl/truth_scenes.h"
#include "tests/source_paths.h"

// The judge judged: two ways to find the truth must agree, and what the judge sees must be what is drawn.
namespace gnomon {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;

constexpr glm::uvec2 kSize_px{320, 180};

std::size_t compared(const std::vector<bench::Audit>& audits) {
    std::size_t pixels = 0;
    for (const bench::Audit& audit : audits)
        for (const bench::AuditedLight& light : audit.lights) pixels += light.compared_px;
    return pixels;
}

void expect_sound(const std::vector<bench::Audit>& audits) {
    for (const bench::Audit& audit : audits) EXPECT_TRUE(bench::is_sound(audit)) << bench::audit_table(audit);
    std::printf("%s", bench::audit_summary(audits).c_str());
}

class AuditOfTruth : public TruthTest {
protected:
    static std::vector<bench::Audit> audits(glm::uvec2 size_px, const std::vector<std::filesystem::path>& scenes = {}) {
        bench::AuditCommand command;
        command.stage.size_px = size_px;
        command.scenes = scenes;
        auto found = bench::run_audit(command);
        if (found) return std::move(found).value();
        ADD_FAILURE() << to_line(found.error());
        return {};
    }
    /// Draws the courtyard and audits the picture against a snapshot that `change` has altered.
    template <class Change>
    static bench::Audit audit_of_another(const Change& change) {
        bench::StageOptions options;
        options.size_px = kSize_px;
        const auto stage = open(options);
        if (!stage) return {};
        stage->run_frame();
        SceneSnapshot traced = stage->frame().snapshot();
        change(traced);
        auto audit = bench::audit_frame(stage->device(), stage->frame(), stage->library(), traced);
        if (audit) return std::move(audit).value();
        ADD_FAILURE() << to_line(audit.error());
        return {};
    }
    /// Returns the index of the caster with the largest bounds.
    static std::uint32_t largest_caster(const SceneSnapshot& scene) {
        std::uint32_t largest = 0;
        const auto size = [&](std::uint32_t i) {
            return scene.instances[i].casts ? glm::length(math::half_extent(scene.instances[i].bounds_ws)) : 0.0;
        };
        for (std::uint32_t i = 1; i < scene.instances.size(); ++i)
            if (size(i) > size(largest)) largest = i;
        return largest;
    }
};

TEST_F(AuditOfTruth, BothWaysSayTheSameOfTheBuiltInScenesAndSeeWhatIsDrawn) {
    const std::vector<bench::Audit> all = audits(kSize_px);
    EXPECT_GE(all.size(), 5u);
    EXPECT_GT(compared(all), 300000u);
    expect_sound(all);
}

TEST_F(AuditOfTruth, BothWaysSayTheSameOfSponzaAndSeeWhatIsDrawn) {
    const auto file = test::data_folder() / "sponza-crytek/Sponza.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    // In a smaller picture more pixels lie within the rasteriser's snapping of an edge between its triangles.
    const std::vector<bench::Audit> all = audits({1280, 720}, {file});
    EXPECT_GT(compared(all), 300000u);
    expect_sound(all);
}

TEST_F(AuditOfTruth, ListsEachPixelThatCastersDarkenOfWhichTheTracerIsNotTold) {
    const bench::Audit audit = audit_of_another([](SceneSnapshot& traced) {
        for (InstanceItem& item : traced.instances) item.casts = false;
    });
    EXPECT_FALSE(bench::is_sound(audit));
    EXPECT_LE(bench::other_surface_share(audit), bench::kMostOtherSurface) << "it is still seen";
    std::size_t listed = 0;
    for (const bench::AuditedLight& light : audit.lights) {
        listed += light.disagreements.size();
        EXPECT_THAT(light.disagreements, Each(Field(&bench::ShadowDisagreement::traced_lit, true)));
        EXPECT_THAT(light.disagreements, Each(Field(&bench::ShadowDisagreement::queried_lit, false)));
    }
    EXPECT_GT(listed, 10000u);
    const std::string table = bench::audit_table(audit), json = bench::audit_json({audit});
    EXPECT_THAT(table, HasSubstr("ABOVE ITS BOUND"));
    EXPECT_GT(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), listed);
    EXPECT_THAT(json, HasSubstr("\"asked\": \"dark\""));
    EXPECT_THAT(bench::audit_summary({audit}), HasSubstr("NOT SOUND"));
}

TEST_F(AuditOfTruth, ListsEachPixelThatShowsWhatTheTracerIsNotTold) {
    std::uint32_t hidden = 0;
    const bench::Audit audit = audit_of_another([&](SceneSnapshot& traced) {
        hidden = largest_caster(traced);
        traced.instances[hidden].visible = false;
    });
    EXPECT_FALSE(bench::is_sound(audit));
    std::size_t of_hidden = 0, others = 0;
    for (const bench::OtherTriangle& at : audit.other_triangles)
        if (!at.in_one_plane) ++(at.drawn.instance == hidden ? of_hidden : others);
    EXPECT_GT(of_hidden, 100u);
    EXPECT_LE(static_cast<double>(others), bench::kMostOtherSurface * static_cast<double>(audit.surface_px));
    for (const bench::AuditedLight& light : audit.lights)
        EXPECT_LE(bench::disagreeing_share(light), bench::kMostDisagreeing) << "nothing is compared there";
}

/// Worlds in which geometry is at its worst, at sizes and places that they are made for.
class AuditOfHardCases : public hard::HardCaseGl {};

TEST_F(AuditOfHardCases, BothWaysSayTheSameAndSeeWhatIsDrawn) {
    std::vector<bench::Audit> all;
    for (const hard::HardCase& row : hard::hard_cases()) {
        if (row.on_gpu == hard::OnGpu::no) continue;
        hard::World world;
        row.build(world);
        draw(world, 1);
        if (HasFatalFailure()) return;
        auto audit = bench::audit_frame(device(), frame(), world.library, scene());
        ASSERT_TRUE(audit) << row.name << ": " << to_line(audit.error());
        audit.value().scene = row.name;
        all.push_back(std::move(audit).value());
    }
    EXPECT_GE(all.size(), 20u);
    EXPECT_GT(compared(all), 300000u);
    expect_sound(all);
}

}  // namespace
}  // namespace gnomon
