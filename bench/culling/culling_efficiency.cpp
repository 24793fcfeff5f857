#include "bench/culling/culling_efficiency.h"

#include <cstdio>

#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/extract/extract.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/transform/transform_system.h"
#include "tests/oracle/caster_need.h"
#include "tests/oracle/fit_stages.h"

namespace gnomon::bench {
namespace {

/// Points of each receiver that are tried: more find a few more casters that are needed.
constexpr int kSamples = 2000;

double per_cent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string row(const SceneSnapshot& scene, const shadow::ShadowFrame& frame, std::uint32_t index) {
    const LightItem& light = scene.lights[index];
    const shadow::LightSets& sets = frame.fitted.lights[index].sets;
    char line[200];
    if (frame.statuses[index].is_skipped()) {
        std::snprintf(line, sizeof line, "%-24s %s\n", light.name.c_str(),
                      reason_code(frame.statuses[index].skipped()));
        return line;
    }
    const std::size_t views = frame.fitted.lights[index].views.count;
    std::size_t casters = 0;
    for (const InstanceItem& item : scene.instances) casters += item.casts ? 1 : 0;
    const oracle::CasterNeed need = oracle::caster_need(scene, frame, index, kSamples);
    const auto listed = static_cast<std::size_t>(need.listed), needed = static_cast<std::size_t>(need.needed);
    std::snprintf(line, sizeof line, "%-24s %9u %9u %6zu %9zu %13.1f %% %13.1f %%\n", light.name.c_str(),
                  sets.receivers.count, sets.casters.count, views, listed, per_cent(listed, views * casters),
                  per_cent(listed - needed, listed));
    return line;
}

}  // namespace

Result<std::string> set_shares(const StageOptions& options) {
    auto scene = game::load_scene(options.scene);
    if (!scene) return scene.error();
    ecs::Registry world;
    assets::MeshLibrary library;
    const game::SpawnedScene spawned = game::spawn_scene(std::move(scene).value(), world, library);
    game::set_time(spawned, options.time_s, world);
    for (const game::NamedEntity& light : spawned.lights)
        for (const std::string& setting : options.settings) {
            std::optional<Error> error;
            game::change_settings(world, light.entity, [&](game::LightSettings& settings) {
                error = game::apply_setting(settings, setting);
            });
            if (error) return *error;
        }
    if (options.camera) {
        const auto camera = game::find_camera(spawned, *options.camera);
        if (!camera) return camera.error();
        game::activate_camera(spawned, camera.value(), world);
    }
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;
    extractor.update(world, library, transforms.update(world), options.size_px, snapshot);

    const shadow::ShadowFrame frame = shadow::fitted(snapshot);
    std::string table = std::to_string(snapshot.instances.size()) + " instances\n";
    table += "light                    receivers   casters  views    listed  of all possible    of these in vain\n";
    for (std::uint32_t d = 0; d < frame.requests.size(); ++d) table += row(snapshot, frame, d);
    return table;
}

}  // namespace gnomon::bench
