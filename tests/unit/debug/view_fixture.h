#pragma once
#include <gmock/gmock.h>

#include "systems/debug/debug_view.h"

namespace gnomon::debug {

/// A sun with four cascades, a lamp with one map and a third light that has none; one camera.
struct ViewTest : ::testing::Test {
    ViewTest() {
        for (const char* name : {"sun", "lamp", "dark"}) {
            LightItem& light = scene.lights.emplace_back();
            light.name = name;
            light.has_shadow = true;
        }
        scene.consumers.emplace_back();
        frame.inputs.emplace_back();
        frame.fitted.lights.resize(3);
        frame.sets.lights.resize(3);
        frame.decisions.resize(3);
        frame.statuses.resize(3);
        frame.statuses[2].skip(Reason::no_caster);
        for (std::uint32_t i = 0; i < 4; ++i) add_view(0, i, shadow::ViewProjection::orthographic);
        add_view(1, 0, shadow::ViewProjection::perspective);
    }
    void add_view(std::uint32_t light, std::uint32_t layer, shadow::ViewProjection projection) {
        shadow::ShadowView& view = frame.fitted.views.emplace_back();
        view.light = light;
        view.layer = layer;
        view.projection = projection;
        view.depth.near_m = 0.5;
        view.depth.far_m = 12.5;
        view.error.texel_m = 0.0125;
        frame.maps.emplace_back().texture = {light + 1};
        frame.updates.emplace_back();
        shadow::IndexRange& views = frame.fitted.lights[light].views;
        if (views.count++ == 0) views.first = static_cast<std::uint32_t>(frame.fitted.views.size() - 1);
    }
    /// Appends indices of the scene's instances to `all`; returns their range.
    shadow::IndexRange add(std::vector<std::uint32_t>& all, std::initializer_list<std::uint32_t> items) {
        const auto first = static_cast<std::uint32_t>(all.size());
        all.insert(all.end(), items);
        return {first, static_cast<std::uint32_t>(items.size())};
    }
    std::optional<Drawing> draw(const char* view, const std::string& light, std::optional<std::uint32_t> layer = {}) {
        request.view = find_view(view);
        request.light = light;
        request.layer = layer;
        return request.view->drawer->draw({scene, frame, request, {10, 20, 400, 300}, fitted});
    }
    static std::vector<std::string> texts(const Drawing& drawing) {
        std::vector<std::string> all;
        for (const Label& label : drawing.labels) all.push_back(label.text);
        return all;
    }

    SceneSnapshot scene;
    shadow::ShadowFrame frame;
    Request request;
    const ConsumerItem* fitted = nullptr;
};

}  // namespace gnomon::debug
