#include "bench/sweep/sweep_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/sweep/html_template.h"
#include "tests/source_paths.h"
#include "tests/unit/bench/sweep/made_up_sweep.h"

namespace gnomon::bench {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

SceneSweep some_sweep() {
    SceneSweep sweep = made_up_sweep({{"defaults", 0.02, 1.0, std::string(kDefaultsRow)},
                                      {"tutorial, 1024", 0.08, 0.9, std::string(kTutorialFactor)},
                                      {"fine", 0.01, 1.5},
                                      {"failed", 0.0, 0.0}});
    sweep.rows[3].lights.clear();
    sweep.rows[3].error = "no \"room\", sorry";
    return sweep;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Fields of one line, as RFC 4180 has them.
std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[i++];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += line[i];
    }
    return fields;
}

TEST(SweepReport, CsvHasALinePerRowAndLightAndOneForARowThatFailed) {
    const std::vector<std::string> lines = lines_of(sweep_csv({some_sweep()}));
    ASSERT_EQ(lines.size(), 5u);
    const std::vector<std::string> head = fields_of(lines[0]);
    for (const std::string& line : lines) EXPECT_EQ(fields_of(line).size(), head.size()) << line;
    EXPECT_EQ(fields_of(lines[2])[2], "tutorial, 1024");
    EXPECT_EQ(fields_of(lines[4])[5], "no \"room\", sorry");
    const auto wrong = static_cast<std::size_t>(std::find(head.begin(), head.end(), "wrong") - head.begin());
    EXPECT_EQ(fields_of(lines[1]).at(wrong), "0.02");
    EXPECT_EQ(fields_of(lines[4]).at(wrong), "");
}

TEST(SweepReport, ReadmeNamesEveryColumnOfTheCsvAndEveryKeyOfTheJson) {
    std::ifstream file(test::source_folder() / "bench/README.md");
    const std::string readme{std::istreambuf_iterator<char>(file), {}};
    for (const std::string& name : fields_of(lines_of(sweep_csv({}))[0]))
        EXPECT_THAT(readme, HasSubstr("`" + name + "`")) << name;
    const auto json = nlohmann::json::parse(sweep_json({some_sweep()}));
    const auto& scene = json.at("scenes").at(0);
    for (const auto& part : {scene, scene.at("rows").at(0), scene.at("rows").at(0).at("lights").at(0),
                             scene.at("findings").at(0), scene.at("findings").at(0).at("halvings").at(0)})
        for (const auto& [key, value] : part.items()) EXPECT_THAT(readme, HasSubstr("`" + key + "`")) << key;
}

TEST(SweepReport, JsonHasWhatWasFoundAndNullForWhatWasNotMeasured) {
    const auto scene = nlohmann::json::parse(sweep_json({some_sweep()})).at("scenes").at(0);
    EXPECT_EQ(scene.at("rows").size(), 4u);
    EXPECT_EQ(scene["rows"][3]["error"], "no \"room\", sorry");
    const auto& figures = scene["rows"][2]["lights"][0]["figures"];
    EXPECT_EQ(figures.at("wrong"), 0.01);
    EXPECT_TRUE(figures.at("kept_ratio").is_null());
    EXPECT_EQ(scene["rows"][2]["lights"][0]["fronts"], nlohmann::json({"point drawn"}));
    EXPECT_EQ(scene["findings"][0]["defaults_halved"]["to"], "fine");
}

/// Whether an attribute that a browser follows names a file or a host.
bool refers_elsewhere(const std::string& page) {
    for (const std::string name : {"src", "href"})
        for (std::size_t at = page.find(name); at != std::string::npos; at = page.find(name, at + 1)) {
            const std::size_t sign = page.find_first_not_of(" \t\n", at + name.size());
            if (sign == std::string::npos || page[sign] != '=') continue;
            const std::size_t first = page.find_first_not_of(" \t\n\"'", sign + 1);
            if (first == std::string::npos) continue;
            const std::string value = page.substr(first, page.find_first_of(" \t\n\"'>", first) - first);
            if (!value.starts_with("data:") && value.find_first_of("/.") != std::string::npos) return true;
        }
    return false;
}

TEST(SweepReport, ThePageNeedsNothingFromElsewhere) {
    const std::string page = sweep_page({some_sweep()});
    EXPECT_FALSE(refers_elsewhere(page));
    EXPECT_THAT(page, Not(HasSubstr("@import")));
    EXPECT_THAT(page, Not(HasSubstr("{{")));
    EXPECT_THAT(page, HasSubstr("halving that takes × 1.5 their time"));
    EXPECT_TRUE(refers_elsewhere("<img src=\"https://a.b/c.png\">"));
    EXPECT_TRUE(refers_elsewhere("<link href = 'style.css'>"));
    EXPECT_FALSE(refers_elsewhere("<img src=\"data:image/png;base64,a/b\"> <a href='#top'>"));
}

TEST(SweepReport, NoNameEndsTheScriptOrAddsAnElement) {
    SceneSweep sweep = some_sweep();
    sweep.scene = "</script><img src=x onerror=alert(1)>{{DATA}}";
    sweep.plan[2].name = "</script><b>";
    const std::string page = sweep_page({sweep});
    EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(page, Not(HasSubstr("</script><")));
}

TEST(SweepReport, WithoutTimesThereAreNoPlotsAndThePageStands) {
    SceneSweep sweep = made_up_sweep({{"defaults", 0.02, 1.0, std::string(kDefaultsRow)}});
    sweep.rows[0].lights[0].figures.gpu_ratio = {};
    EXPECT_EQ(front_plot(sweep, "sun", SweepTruth::point, SweepCost::drawn), "");
    EXPECT_THAT(sweep_page({sweep}), HasSubstr("</html>"));
    EXPECT_THAT(sweep_page({}), HasSubstr("</html>"));
}

TEST(SweepReport, PlotsStayFiniteForOneRowForNoErrorAndForExtremes) {
    for (const std::vector<MadeUpRow>& rows :
         {std::vector<MadeUpRow>{{"a", 0.02, 1.0}}, {{"a", 0.0, 1.0}}, {{"a", 1.0e-300, 1.0e-9}, {"b", 1.0, 1.0e9}}}) {
        const std::string plot = front_plot(made_up_sweep(rows), "sun", SweepTruth::point, SweepCost::drawn);
        EXPECT_THAT(plot, HasSubstr("circle"));
        EXPECT_THAT(plot, Not(AnyOf(HasSubstr("nan"), HasSubstr("inf"))));
    }
}

TEST(SweepReport, MarkdownNamesTheDeviceAndTheBound) {
    const std::string text = sweep_markdown({some_sweep()});
    EXPECT_THAT(text, HasSubstr("a device"));
    EXPECT_THAT(text, HasSubstr("### The bound"));
    EXPECT_THAT(text, HasSubstr("| `fine` | 1 % | 1.5 |"));
}

TEST(PageTemplate, Base64IsAsRfc4648HasIt) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

}  // namespace
}  // namespace gnomon::bench
