#include <cstring>

#include "systems/debug/shown_scale.h"
#include "systems/debug/words.h"
#include "tests/unit/debug/view_fixture.h"

namespace gnomon::debug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct LookupViews : ViewTest {
    static ShownScale scale_of(const Drawing& drawing) {
        ShownScale scale;
        EXPECT_EQ(drawing.block.size(), sizeof scale);
        std::memcpy(&scale, drawing.block.data(), sizeof scale);
        return scale;
    }
};

TEST_F(LookupViews, EveryOneOfThemNamesItsLightAndStartsInTheUpperLeftCorner) {
    for (const ViewRow& row : view_table()) {
        if (row.drawer->medium != ViewMedium::lookups) continue;
        const auto drawing = draw(row.name.data(), "lamp");
        ASSERT_TRUE(drawing) << row.name;
        EXPECT_EQ(drawing->light, 1u);
        ASSERT_FALSE(drawing->labels.empty());
        EXPECT_THAT(drawing->labels.front().text, HasSubstr("lamp"));
        EXPECT_EQ(drawing->labels.front().at_px, glm::ivec2(10, 320));
        for (std::size_t i = 1; i < drawing->labels.size(); ++i) {
            EXPECT_EQ(drawing->labels[i].at_px, glm::ivec2(10, 320 - kLine_px * static_cast<int>(i)));
            EXPECT_TRUE(drawing->labels[i].swatch);
        }
    }
}

TEST_F(LookupViews, MapsAreNamedInTheColoursThatTheShaderIsGiven) {
    const auto drawing = draw("cascades", "sun");
    const ShownScale scale = scale_of(*drawing);
    ASSERT_EQ(drawing->labels.size(), 5u);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Label& label = drawing->labels[i + 1];
        EXPECT_THAT(label.text, HasSubstr("map " + std::to_string(i)));
        EXPECT_EQ(scale_colour(label.swatch.value(), 0.0f), scale.colours[i]);
        for (std::uint32_t k = 0; k < i; ++k) EXPECT_NE(scale.colours[i], scale.colours[k]);
    }
    EXPECT_EQ(scale.options.x, -1);
}

TEST_F(LookupViews, ThoseChosenByDistanceSayFromWhereToWhere) {
    frame.fitted.views[1].cascade.seen_from_m = 3.25;
    frame.fitted.views[1].cascade.seen_to_m = 1250.0;
    EXPECT_EQ(draw("cascades", "sun", 1)->labels[1].text, "map 1, from 3.25 m to 1.25 km, texels up to 12.5 mm");
    EXPECT_EQ(draw("cascades", "sun", 2)->labels[1].text, "map 2, texels up to 12.5 mm");
}

TEST_F(LookupViews, OneMapAloneIsToldToTheShader) {
    EXPECT_EQ(scale_of(*draw("texels", "sun", 3)).options.x, 3);
    EXPECT_EQ(scale_of(*draw("bias", "sun", 0)).options.x, 0);
}

TEST_F(LookupViews, LengthsRiseAlongTheScaleAndAreNamedByItsLabels) {
    for (const char* view : {"bias", "penumbra"}) {
        const auto drawing = draw(view, "sun");
        const ShownScale scale = scale_of(*drawing);
        ASSERT_LE(static_cast<std::uint32_t>(scale.options.y), kScaleColours);
        ASSERT_EQ(drawing->labels.size(), static_cast<std::size_t>(scale.options.y) + 1);
        for (std::size_t i = 0; i + 1 < drawing->labels.size(); ++i) {
            EXPECT_THAT(drawing->labels[i + 1].text, HasSubstr(length_text(static_cast<double>(scale.colours[i].w))));
            if (i == 0) continue;
            EXPECT_GT(scale.colours[i].w, 2.0f * scale.colours[i - 1].w);
        }
    }
}

TEST_F(LookupViews, ALightWithoutAMapHasNoScale) {
    const auto drawing = draw("bias", "dark");
    ASSERT_TRUE(drawing);
    EXPECT_THAT(texts(*drawing), ElementsAre(HasSubstr(reason_code(Reason::no_caster))));
}

TEST(Words, LengthsHaveThreeDigitsAndAUnitThatSuitsThem) {
    EXPECT_EQ(length_text(0.0), "0 mm");
    EXPECT_EQ(length_text(1.2345e-5), "0.0123 mm");
    EXPECT_EQ(length_text(0.5), "500 mm");
    EXPECT_EQ(length_text(1.0), "1 m");
    EXPECT_EQ(length_text(-2.5), "-2.5 m");
    EXPECT_EQ(length_text(12345.0), "12.3 km");
}

}  // namespace
}  // namespace gnomon::debug
