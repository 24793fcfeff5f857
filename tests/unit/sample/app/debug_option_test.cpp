#include "sample_game/app/debug_option.h"

#include <gmock/gmock.h>

namespace gnomon::game {
namespace {

using ::testing::HasSubstr;

TEST(DebugRequest, ViewsOfALightNameItAndMayNameOneMap) {
    const auto all = read_debug_request("depth:lantern");
    ASSERT_TRUE(all) << to_line(all.error());
    EXPECT_EQ(all.value().view, debug::find_view("depth"));
    EXPECT_EQ(all.value().light, "lantern");
    EXPECT_FALSE(all.value().layer);
    const auto one = read_debug_request("depth:lamp.1:3");
    ASSERT_TRUE(one) << to_line(one.error());
    EXPECT_EQ(one.value().light, "lamp.1");
    EXPECT_EQ(one.value().layer, 3u);
}

TEST(DebugRequest, AViewThatCanShowAllLightsNeedsNone) {
    const auto all = read_debug_request("frusta");
    ASSERT_TRUE(all) << to_line(all.error());
    EXPECT_EQ(all.value().light, "");
    EXPECT_FALSE(check_debug_light(all.value(), {"sun"}));
    EXPECT_EQ(read_debug_request("frusta:sun:2").value().layer, 2u);
    EXPECT_THAT(list_debug_views(), HasSubstr("frusta[:LIGHT[:MAP]]"));
    EXPECT_THAT(list_debug_views(), HasSubstr("sets:LIGHT[:MAP]"));
}

TEST(DebugRequest, AnythingElseIsRefusedOnOneLine) {
    const std::pair<const char*, const char*> rows[] = {{"", "debug.view"},
                                                        {"deep:sun", "debug.view"},
                                                        {":sun", "debug.view"},
                                                        {"Depth:sun", "debug.view"},
                                                        {"depth", "debug.syntax"},
                                                        {"depth:", "debug.syntax"},
                                                        {"depth:sun:", "debug.syntax"},
                                                        {"depth:sun:x", "debug.syntax"},
                                                        {"depth:sun:-1", "debug.syntax"},
                                                        {"depth:sun:8", "debug.syntax"},
                                                        {"depth:sun:1:2", "debug.syntax"},
                                                        {"depth::1", "debug.syntax"},
                                                        {"frusta:", "debug.syntax"},
                                                        {"frusta::1", "debug.syntax"},
                                                        {"sets", "debug.syntax"},
                                                        {"x\ny", "debug.view"}};
    for (const auto& [text, rule] : rows) {
        const auto request = read_debug_request(text);
        ASSERT_FALSE(request) << text;
        EXPECT_EQ(request.error().rule, rule) << text;
        EXPECT_EQ(request.error().message.find('\n'), std::string::npos);
    }
}

TEST(DebugRequest, TheLightMustBeThereAndTheErrorNamesThoseThatAre) {
    const auto request = read_debug_request("depth:lantern").value();
    EXPECT_FALSE(check_debug_light(request, {"sun", "lantern"}));
    const auto error = check_debug_light(request, {"sun", "moon"});
    ASSERT_TRUE(error);
    EXPECT_EQ(error->rule, "debug.light");
    EXPECT_THAT(error->message, HasSubstr("sun, moon"));
    EXPECT_TRUE(check_debug_light(request, {}));
    EXPECT_FALSE(check_debug_light({}, {}));
}

TEST(DebugRequest, TheListNamesEveryView) {
    for (const debug::ViewRow& row : debug::view_table())
        EXPECT_THAT(list_debug_views(), HasSubstr(std::string(row.name)));
}

}  // namespace
}  // namespace gnomon::game
