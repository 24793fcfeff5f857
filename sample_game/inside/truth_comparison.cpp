#include "sample_game/inside/truth_comparison.h"

#include <algorithm>

#include "systems/extract/extract.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/transform/transform_system.h"
#include "systems/truth/error_tints.h"

namespace gnomon::game {
namespace {

TracedSource source_of(const Light& light, const LightShadow& shadow) {
    return {shadow.layers, shadow.antialias, shadow.translucent_casters, light.source_radius_m, light.sun_radius_rad,
            light.width_m, light.height_m};
}

struct ShownTruth {
    ShownShare share;
    const truth::LightTruth& truth;
};

/// Returns the share's name in the stats.
const char* name_of(ShownShare share) {
    switch (share) {
        case ShownShare::middle:
            return "middle";
        case ShownShare::source:
            return "source";
        case ShownShare::area:
            return "area";
        case ShownShare::source_and_area:
            return "source_and_area";
    }
    return "";
}

/// Returns the truth of what the light's filter shows. `reported`: null for a light that has none.
ShownTruth shown_share(const truth::TracedLight& traced, const LightReport* reported) {
    const ShownTruth middle{ShownShare::middle, traced.truth};
    if (reported == nullptr || reported->filter.filter == ShadowFilter::automatic) return middle;
    const shadow::FilterRow& row = shadow::filter_row(reported->filter.filter);
    const bool reads_area = traced.area && row.area_shares != shadow::AreaShares::none;
    if (row.width != shadow::FilterWidth::source || !traced.source)
        return reads_area ? ShownTruth{ShownShare::area, *traced.area} : middle;
    return reads_area ? ShownTruth{ShownShare::source_and_area, *traced.source_and_area}
                      : ShownTruth{ShownShare::source, *traced.source};
}

const LightReport* report_of(const FrameReport& report, ecs::Entity light) {
    const auto own = std::find_if(report.lights.begin(), report.lights.end(),
                                  [&](const LightReport& one) { return one.entity == light; });
    return own == report.lights.end() ? nullptr : &*own;
}

nlohmann::ordered_json middle_stats(const JudgedLight& light, const truth::Metrics& m) {
    return {{"name", light.name},
            {"judged_by", name_of(light.by)},
            {"scored_px", m.scored},
            {"wrong_px", m.wrong},
            {"false_shadow_px", m.false_shadow},
            {"false_light_px", m.false_light},
            {"uncovered_px", m.uncovered},
            {"acne_px", m.acne},
            {"leak_px", m.leak},
            {"ambiguous_px", m.ambiguous},
            {"coverage_mismatch_px", m.coverage_mismatch},
            {"wrong", m.fraction(m.wrong)},
            {"edge",
             {{"places", m.edge.places},
              {"lost", m.edge.lost},
              {"mean_px", m.edge.mean_px},
              {"p95_px", m.edge.p95_px},
              {"p99_px", m.edge.p99_px},
              {"max_px", m.edge.max_px}}}};
}

nlohmann::ordered_json tint_stats(const truth::TintMetrics& m) {
    return {{"scored_px", m.scored},      {"tinted_px", m.tinted},          {"beyond_px", m.beyond},
            {"mean_error", m.mean_error}, {"tinted_error", m.tinted_error}, {"max_error", m.max_error}};
}

nlohmann::ordered_json share_stats(const JudgedLight& light, const truth::SoftMetrics& m) {
    return {{"name", light.name},
            {"judged_by", name_of(light.by)},
            {"scored_px", m.scored},
            {"false_shadow_px", m.false_shadow},
            {"false_light_px", m.false_light},
            {"mean_error", m.mean_error},
            {"umbra_px", m.umbra},
            {"umbra_leak", m.umbra_leak},
            {"lit_px", m.lit},
            {"lit_loss", m.lit_loss},
            {"penumbra_px", m.penumbra},
            {"penumbra_error", m.penumbra_error}};
}

void judge_tint(Frame& frame, const truth::TracedLight& traced, JudgedLight& light) {
    std::vector<glm::vec4> measured;
    const bool reads_source = light.by == ShownShare::source || light.by == ShownShare::source_and_area;
    if (!traced.tint || reads_source || !frame.read_tint(light.entity, measured) ||
        measured.size() != traced.tint->passed.size())
        return;
    light.tint = truth::compare_tint(measured, *traced.tint, traced.truth, light.tint_off);
}

}  // namespace

double JudgedLight::wrong() const {
    if (metrics) return metrics->fraction(metrics->wrong);
    return scored() == 0 ? 0.0
                         : static_cast<double>(soft->false_shadow + soft->false_light) / static_cast<double>(scored());
}

void FrozenFrame::freeze(ecs::Registry& world, const assets::MeshLibrary& library, glm::uvec2 size_px,
                         unsigned threads) {
    thaw();
    SceneSnapshot scene;
    TransformSystem transforms;
    Extractor().update(world, library, transforms.update(world), size_px, scene);
    if (scene.consumers.empty()) return;
    size_px_ = size_px;
    for (const LightItem& light : scene.lights) {
        if (!light.has_shadow) continue;
        lights_.push_back({.name = light.name, .entity = light.entity, .metrics = {}, .soft = {}});
        const Light* own = world.get<Light>(light.entity);
        sources_.push_back(source_of(own ? *own : Light{}, light.shadow));
    }
    if (chosen_ && *chosen_ >= lights_.size()) chosen_.reset();
    trace_ = std::make_unique<truth::BackgroundTrace>(scene, library, threads);
    state_ = State::tracing;
}

void FrozenFrame::thaw() {
    trace_.reset();
    lights_.clear();
    sources_.clear();
    tints_.clear();
    ++version_;
    state_ = State::off;
}

void FrozenFrame::update(Frame& frame, const ecs::Registry& world, glm::uvec2 size_px) {
    if (!on()) return;
    bool same = size_px == size_px_;
    for (std::size_t i = 0; same && i < lights_.size(); ++i) {
        const LightShadow* shadow = world.get<LightShadow>(lights_[i].entity);
        const Light* own = world.get<Light>(lights_[i].entity);
        same = shadow && own && source_of(*own, *shadow) == sources_[i];
    }
    if (!same) return thaw();
    if (!frame.report().still)
        for (JudgedLight& light : lights_) light.stale = true;
    if (!trace_->finished()) return;
    state_ = State::shown;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        last_judged_ = (last_judged_ + 1) % lights_.size();  // in turn: frames may change one of them again and again
        if (lights_[last_judged_].stale) return judge(frame, last_judged_);
    }
}

void FrozenFrame::finish(Frame& frame) {
    if (!on()) return;
    trace_->truth();
    state_ = State::shown;
    for (std::size_t i = 0; i < lights_.size(); ++i)
        if (lights_[i].stale) judge(frame, i);
}

bool FrozenFrame::judged() const {
    return state_ == State::shown &&
           std::none_of(lights_.begin(), lights_.end(), [](const JudgedLight& light) { return light.stale; });
}

void FrozenFrame::judge(Frame& frame, std::size_t index) {
    JudgedLight& light = lights_[index];
    light.stale = false;
    light.truth = nullptr;
    light.metrics.reset();
    light.soft.reset();
    light.tint.reset();
    light.tint_off.clear();
    if (!frame.read_visibility(light.entity, light.measured)) light.measured.clear();
    const auto& lights = trace_->truth().lights;
    if (index < lights.size() && light.measured.size() == lights[index].truth.visibility.size()) {
        const auto [share, truth] = shown_share(lights[index], report_of(frame.report(), light.entity));
        light.by = share;
        light.truth = &truth;
        if (&truth == &lights[index].truth)
            light.metrics = truth::compare({size_px_, light.measured, truth.visibility, truth.scored, truth.ambiguous});
        else
            light.soft = truth::compare_soft(light.measured, truth.visibility, truth.scored);
        judge_tint(frame, lights[index], light);
    }
    paint();
}

void FrozenFrame::choose(std::optional<std::size_t> light) {
    chosen_ = light && *light < lights_.size() ? light : std::nullopt;
    if (state_ == State::shown) paint();
}

void FrozenFrame::choose_next() {
    std::size_t next = chosen_ ? *chosen_ + 1 : 0;
    while (next < lights_.size() && lights_[next].judged() && lights_[next].scored() == 0) ++next;
    choose(next);
}

void FrozenFrame::paint() {
    std::vector<truth::DrawnLight> shown;
    for (std::size_t i = 0; i < lights_.size(); ++i)
        if (lights_[i].judged() && (!chosen_ || *chosen_ == i))
            shown.push_back({lights_[i].measured, lights_[i].truth, lights_[i].tint_off});
    truth::tint_errors(size_px_, shown, tints_);
    ++version_;
}

nlohmann::ordered_json truth_stats(const FrozenFrame& frozen) {
    nlohmann::ordered_json lights = nlohmann::ordered_json::array();
    for (const JudgedLight& light : frozen.lights()) {
        if (light.soft) lights.push_back(share_stats(light, *light.soft));
        if (light.metrics) lights.push_back(middle_stats(light, *light.metrics));
        if (light.judged() && light.tint) lights.back()["tint"] = tint_stats(*light.tint);
    }
    return {{"lights", std::move(lights)}};
}

}  // namespace gnomon::game
