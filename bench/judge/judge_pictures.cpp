#include "bench/judge/judge_pictures.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/accuracy/reference_images.h"
#include "bench/common/png_file.h"
#include "bench/text/printf_string.h"
#include "sample_game/support/files/image_files.h"

namespace gnomon::bench {
namespace {

std::string size_text(glm::uvec2 size_px) { return std::to_string(size_px.x) + "x" + std::to_string(size_px.y); }

std::optional<Error> write_wrong_pixels(const TracedLight& light, const game::Pfm& picture,
                                        const std::filesystem::path& file) {
    constexpr std::array<std::uint8_t, 3> kWrong{235, 40, 30}, kNoSurface{200, 215, 230};
    constexpr float kWhite = 255.0f;
    std::vector<std::uint8_t> rgba;
    rgba.reserve(picture.values.size() * 4);
    for (std::uint32_t y = picture.size_px.y; y-- > 0;)
        for (std::uint32_t x = 0; x < picture.size_px.x; ++x) {
            const std::size_t pixel = std::size_t{y} * picture.size_px.x + x;
            const float seen = picture.values[pixel];
            std::array<std::uint8_t, 3> colour = kNoSurface;  // also where no number stands
            if (seen >= 0.0f) colour.fill(static_cast<std::uint8_t>(kWhite * std::min(seen, 1.0f)));
            if (is_wrong(light, pixel, seen)) colour = kWrong;
            rgba.insert(rgba.end(), {colour[0], colour[1], colour[2], 255});
        }
    return write_png(file, picture.size_px.x, picture.size_px.y, rgba);
}

Result<game::Pfm> read_picture(const std::filesystem::path& file, glm::uvec2 size_px) {
    auto read = game::read_pfm(file);
    if (read && read.value().size_px != size_px)
        return Error{.message = "has " + size_text(read.value().size_px) + " pixels, not " + size_text(size_px) + " (--size)",
                     .file = file.string(),
                     .rule = "bench.size"};
    return read;
}

void append_table(const JudgedFolder& folder, std::string& text) {
    text += formatted("\n%s\n%-18s %8s %8s %8s %8s %8s %8s %6s %6s %6s\n", folder.folder.c_str(), "errors of light",
                      "pixels", "wrong%", "fshadow%", "flight%", "acne%", "leak%", "mean", "p95", "max");
    for (const JudgedPicture& light : folder.lights) {
        const oracle::Metrics& m = light.metrics;
        const auto percent = [&m](std::size_t pixels) { return kPercent * m.fraction(pixels); };
        text += formatted("%-18.18s %8zu %8.4f %8.4f %8.4f %8.4f %8.4f %6.2f %6.2f %6.2f\n", light.light.c_str(),
                          m.scored, percent(m.wrong), percent(m.false_shadow), percent(m.false_light),
                          percent(m.acne), percent(m.leak), m.edge.mean_px, m.edge.p95_px, m.edge.max_px);
    }
    if (folder.lights.empty() || !folder.lights.front().area) return;
    text += formatted("%-18s %8s %8s %8s %8s\n", "edges by area", "crossed", "error", "bias", "p99");
    for (const JudgedPicture& light : folder.lights)
        text += formatted("%-18.18s %8zu %8.4f %+8.4f %8.4f\n", light.light.c_str(), light.area->crossed,
                          light.area->mean_error, light.area->bias, light.area->p99_error);
}

nlohmann::ordered_json figures_of(const JudgedPicture& light) {
    const oracle::Metrics& m = light.metrics;
    nlohmann::ordered_json figures = {{"name", light.light},
                                      {"scored_px", m.scored},
                                      {"wrong", m.fraction(m.wrong)},
                                      {"false_shadow", m.fraction(m.false_shadow)},
                                      {"false_light", m.fraction(m.false_light)},
                                      {"acne", m.fraction(m.acne)},
                                      {"leak", m.fraction(m.leak)},
                                      {"edge_mean_px", m.edge.mean_px},
                                      {"edge_p95_px", m.edge.p95_px},
                                      {"edge_max_px", m.edge.max_px}};
    if (light.area)
        figures["area"] = {{"crossed_px", light.area->crossed},
                           {"mean_error", light.area->mean_error},
                           {"bias", light.area->bias},
                           {"p99_error", light.area->p99_error}};
    return figures;
}

}  // namespace

Result<JudgedPictures> judge_pictures(Stage& stage, const JudgePicturesOptions& options) {
    const auto traced = trace_truths(stage);
    if (!traced) return traced.error();
    const TracedTruths& truths = traced.value();
    const SceneSnapshot& scene = stage.frame().snapshot();
    JudgedPictures judged{stage.scene_name(), truths.hits.size_px, {}};
    for (const std::string& folder : options.folders) judged.folders.push_back({folder, {}});
    for (const TracedLight& light : truths.lights) {
        std::optional<oracle::AreaTruth> area;
        if (options.area_side > 0)
            area = truths.tracer->trace_area(scene.consumers.front(), truths.hits, light.point,
                                             scene.lights[light.index], {options.area_side});
        for (JudgedFolder& folder : judged.folders) {
            const std::filesystem::path file = std::filesystem::path(folder.folder) / (light.name + ".pfm");
            const auto read = read_picture(file, truths.hits.size_px);
            if (!read) return read.error();
            const game::Pfm& picture = read.value();
            JudgedPicture& of = folder.lights.emplace_back(JudgedPicture{light.name, {}, {}});
            of.metrics = oracle::compare({picture.size_px, picture.values, light.point.visibility, light.point.scored,
                                          light.point.ambiguous});
            if (area) of.area = oracle::compare_area(*area, picture.values, light.point.ambiguous);
            if (!options.pictures) continue;
            if (auto error = write_wrong_pixels(light, picture, std::filesystem::path(file).replace_extension("png")))
                return *error;
        }
    }
    return judged;
}

std::string judge_legend() {
    return "Columns of the table:\n"
           "  pixels    surfaces that the light reaches and that face it; every % is of them\n"
           "  wrong     on the other side of half lit than the truth; fshadow false shadow, flight false light\n"
           "  acne      false shadow more than 2 px from any true edge; leak: false light there\n"
           "  mean, p95, max  distance of shadow edges from the true ones, px\n"
           "  crossed   pixels that the light reaches in part (--area); error: mean difference from that part; bias: "
           "its\n"
           "            mean with its sign, above 0 too bright\n";
}

std::string judge_table(const JudgedPictures& judged) {
    std::string text = formatted("scene   %s\npicture %s\n", judged.scene.c_str(), size_text(judged.size_px).c_str());
    for (const JudgedFolder& folder : judged.folders) append_table(folder, text);
    return text;
}

std::string judge_json(const JudgedPictures& judged) {
    nlohmann::ordered_json folders = nlohmann::ordered_json::array();
    for (const JudgedFolder& folder : judged.folders) {
        nlohmann::ordered_json lights = nlohmann::ordered_json::array();
        for (const JudgedPicture& light : folder.lights) lights.push_back(figures_of(light));
        folders.push_back({{"folder", folder.folder}, {"lights", std::move(lights)}});
    }
    constexpr int kIndent = 1;
    const nlohmann::ordered_json json = {
        {"scene", judged.scene}, {"size_px", {judged.size_px.x, judged.size_px.y}}, {"folders", folders}};
    return json.dump(kIndent) + "\n";
}

}  // namespace gnomon::bench
