#include <fstream>
#include <iterator>

#include "bench/compare/crop_images.h"
#include "bench/sweep/html_template.h"
#include "bench/sweep/sweep_json.h"
#include "bench/sweep/sweep_report.h"
#include "bench/text/format_number.h"

namespace gnomon::bench {
namespace {

using Json = nlohmann::ordered_json;

/// A picture file as a data URI; empty if there is none.
std::string data_uri(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return "";
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    return (file.extension() == ".jpg" ? "data:image/jpeg;base64," : "data:image/png;base64,") + base64(bytes);
}

std::string halving_table(const SceneSweep& sweep, const std::string& light, SweepTruth truth) {
    const HalvingCost found = halving_cost(sweep, light, truth, SweepCost::drawn);
    if (found.steps.empty()) return "";
    std::string text = "<table><tr><th class=\"words\">" + escaped_html(light) + ", " +
                       (truth == SweepTruth::point ? "hard" : "soft") +
                       "</th><th>error</th><th>time, × defaults</th><th>× time of the row above</th></tr>\n";
    const auto line = [&](const Choice& choice, const std::string& factor) {
        text += "<tr><td class=\"words\">" + escaped_html(sweep.plan[choice.row].name) + "</td><td>" +
                percent_words(choice.error) + "</td><td>" + factor_words(choice.cost) + "</td><td>" + factor +
                "</td></tr>\n";
    };
    line(found.steps.front().from, "");
    for (const Halving& step : found.steps) line(step.to, factor_words(step.cost_factor()));
    return text + "</table>\n";
}

std::string bargain_line(const SceneSweep& sweep, const std::string& light, const Bargain& bargain) {
    if (bargain.best.row == bargain.tutorial.row) return "";
    return "<p>" + escaped_html(light) + ": “" + escaped_html(sweep.plan[bargain.tutorial.row].name) +
           "” is wrong for " + percent_words(bargain.tutorial.error) + " of pixels; for no more time “" +
           escaped_html(sweep.plan[bargain.best.row].name) + "” is for " + percent_words(bargain.best.error) +
           ".</p>\n";
}

/// The one line to take away.
std::string headline(const SceneSweep& sweep) {
    std::string factors;
    for (const std::string& light : lights_of(sweep))
        if (const auto found = halving_cost(sweep, light, SweepTruth::point, SweepCost::drawn); found.factor)
            factors += (factors.empty() ? "" : ", ") + light + " × " + factor_words(*found.factor);
    if (factors.empty()) return "";
    return "<p class=\"headline\">Half the wrong pixels take, on average along the front, this much more time: " +
           escaped_html(factors) + ".</p>\n";
}

std::string halving_html(const std::vector<SceneSweep>& scenes) {
    std::string text;
    for (const SceneSweep& sweep : scenes) {
        text += "<h3>" + escaped_html(sweep.scene) + ", " + std::to_string(sweep.size_px.x) + " × " +
                std::to_string(sweep.size_px.y) + ", " + escaped_html(sweep.device) + "</h3>\n" + headline(sweep);
        for (const std::string& sentence : halving_sentences(sweep))
            text += "<p class=\"sentence\">" + escaped_html(sentence) + "</p>\n";
        text += "<div class=\"plots\">\n";
        for (const std::string& light : lights_of(sweep))
            for (const SweepTruth truth : kSweepTruths) text += halving_table(sweep, light, truth);
        text += "</div>\n";
        for (const std::string& light : lights_of(sweep))
            for (const Bargain& bargain : bargains(sweep, light, SweepCost::drawn))
                text += bargain_line(sweep, light, bargain);
    }
    return text;
}

std::string plots_html(const std::vector<SceneSweep>& scenes) {
    std::string text;
    for (std::size_t s = 0; s < scenes.size(); ++s) {
        text += "<h3>" + escaped_html(scenes[s].scene) + "</h3>\n<div class=\"plots\">\n";
        for (const std::string& light : lights_of(scenes[s]))
            for (const SweepTruth truth : kSweepTruths) {
                const std::string plot = front_plot(scenes[s], light, truth, SweepCost::drawn);
                if (plot.empty()) continue;
                text += "<figure data-scene=\"" + std::to_string(s) + "\" data-light=\"" + escaped_html(light) +
                        "\"><figcaption>" + escaped_html(light) + ", " +
                        (truth == SweepTruth::point ? "truth about a point" : "truth about a disk") +
                        "</figcaption>\n" + plot + "</figure>\n";
            }
        text += "</div>\n";
    }
    return text;
}

/// Everything the table and the pictures need.
class PageData {
public:
    explicit PageData(const std::vector<SceneSweep>& scenes) : scenes_(scenes) {
        for (const FigureColumn& column : figure_columns()) columns_.push_back(column.name);
        for (std::size_t s = 0; s < scenes_.size(); ++s) add_scene(s);
        // Rows on a front first: they are what is looked at if not all fit.
        for (const bool best : {true, false})
            for (std::size_t i = 0; i < rows_.size(); ++i)
                if (rows_[i].at("fronts").get<std::string>().empty() != best) add_pictures(i);
    }

    std::size_t left_out() const { return left_out_; }

    std::string text() const {
        std::string json = Json{{"columns", columns_}, {"truths", truths_}, {"rows", rows_}}.dump(
            -1, ' ', false, Json::error_handler_t::replace);
        // Nothing in it may end the script element.
        for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
            json.replace(at, 1, "\\u003c");
        return json;
    }

private:
    void add_scene(std::size_t s) {
        const Json report = Json::parse(sweep_json({scenes_[s]})).at("scenes").at(0);
        for (std::size_t r = 0; r < scenes_[s].plan.size(); ++r) {
            const Json& row = report.at("rows").at(r);
            const SweepRow& plan = scenes_[s].plan[r];
            std::string settings;
            for (const std::string& setting : plan.settings) settings += (settings.empty() ? "" : " ") + setting;
            Json common{{"scene", scenes_[s].scene}, {"scene_index", s},      {"index", r},
                        {"row", plan.name},          {"factor", plan.factor}, {"settings", settings},
                        {"error", row.at("error")}};
            if (row.at("lights").empty()) add_row(common, Json::object(), s, r);
            for (const Json& light : row.at("lights")) add_row(common, light, s, r);
        }
    }

    void add_row(Json row, const Json& light, std::size_t s, std::size_t r) {
        for (const char* key : {"light", "kind", "state", "reason"}) row[key] = light.value(key, "");
        std::string fronts;
        for (const Json& front : light.value("fronts", Json::array()))
            fronts += (fronts.empty() ? "" : "; ") + front.get<std::string>();
        row["fronts"] = fronts;
        row["figures"] = Json::array();
        for (const FigureColumn& column : figure_columns())
            row["figures"].push_back(light.contains("figures") ? light["figures"][column.name] : Json(nullptr));
        stems_.push_back(light.contains("light")
                             ? scenes_[s].pictures / RowPictures::stem(r, light["light"].get<std::string>())
                             : std::filesystem::path());
        if (light.contains("figures")) {
            const char* truth = light["figures"]["wrong"].is_null() ? "_disk.png" : "_point.png";
            const std::string file = (scenes_[s].pictures / (light["light"].get<std::string>() + truth)).string();
            if (!truths_.contains(file)) truths_[file] = data_uri(file);
            row["truth"] = file;
        }
        rows_.push_back(std::move(row));
    }

    void add_pictures(std::size_t i) {
        if (stems_[i].empty()) return;
        const std::string stem = stems_[i].string();
        Json pictures{{"render", data_uri(stem + "_render.jpg")},
                      {"shown", data_uri(stem + "_shown.png")},
                      {"error", data_uri(stem + "_error.png")}};
        std::size_t size = 0;
        for (const auto& picture : pictures) size += picture.get_ref<const std::string&>().size();
        if (size == 0) return;
        if (bytes_ + size > kMostPictureBytes) {
            ++left_out_;
            return;
        }
        bytes_ += size;
        rows_[i]["pictures"] = std::move(pictures);
    }

    const std::vector<SceneSweep>& scenes_;
    Json columns_ = Json::array(), truths_ = Json::object(), rows_ = Json::array();
    std::vector<std::filesystem::path> stems_;
    std::size_t bytes_ = 0, left_out_ = 0;
};

std::string notes(const std::vector<SceneSweep>& scenes, std::size_t left_out) {
    std::string text =
        "Errors do not change from run to run; times are of this device as it was then, each row's over the defaults' "
        "right before it. ";
    for (const SceneSweep& sweep : scenes)
        text += escaped_html(sweep.scene) + ": " + std::to_string(sweep.plan.size()) +
                " rows, rounds of times: " + std::to_string(sweep.rounds) + ". ";
    text += "Lights other than those of the row's kind cast no shadows in its render. ";
    if (left_out > 0) text += "Pictures of " + std::to_string(left_out) + " rows were left out to keep the page small.";
    return text;
}

}  // namespace

std::string sweep_page(const std::vector<SceneSweep>& scenes) {
    const PageData data(scenes);
    std::string columns;
    for (const FigureColumn& column : figure_columns())
        columns += std::string("<dt>") + column.name + "</dt><dd>" + escaped_html(column.meaning) + "</dd>\n";
    const std::pair<std::string_view, std::string> values[] = {{"HALVING", halving_html(scenes)},
                                                               {"PLOTS", plots_html(scenes)},
                                                               {"NOTES", notes(scenes, data.left_out())},
                                                               {"COLUMNS", columns},
                                                               {"DATA", data.text()}};
    return filled_page(values);
}

}  // namespace gnomon::bench
