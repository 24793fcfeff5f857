#include "bench/audit/audit_command.h"

#include "bench/scaling/many_lights_scene.h"
#include "sample_game/support/scene/open_scene.h"

namespace gnomon::bench {
namespace {

/// Lights of the built-in level: suns, points and spots in turn. Few of them see the same boxes.
constexpr std::uint32_t kLevelLights = 12;
constexpr std::uint64_t kLevelSeed = 20240917;

/// A scene to open, of a file or made.
struct Source {
    std::string name;
    std::function<Result<assets::SceneData>()> load;
};

std::vector<Source> sources_of(const AuditCommand& command) {
    const Source courtyard{"built-in", [] { return game::load_scene({}); }};
    if (command.scenes.empty() && command.stage.camera) return {courtyard};
    if (command.scenes.empty())
        return {courtyard,
                {"built-in game", [] { return game::load_game_scene(); }},
                {"built-in level", [] { return Result(demand_scene(kLevelLights, kLevelSeed)); }}};
    std::vector<Source> sources;
    for (const std::filesystem::path& file : command.scenes)
        sources.push_back({file.string(), [file] { return game::load_scene(file); }});
    return sources;
}

/// Audits the stage's cameras. It draws no shadow map, since neither surfaces nor rays depend on one.
std::optional<Error> audit_cameras(Stage& stage, const AuditCommand& command, std::vector<Audit>& audits) {
    stage.show_shadows(false);
    const std::size_t cameras = command.stage.camera ? 1 : stage.spawned().cameras.size();
    for (std::size_t i = 0; i < cameras; ++i) {
        if (!command.stage.camera) game::activate_camera(stage.spawned(), i, stage.world());
        stage.run_frame();
        auto audit = audit_frame(stage.device(), stage.frame(), stage.library(), stage.frame().snapshot());
        if (!audit) return audit.error();
        audit.value().scene = stage.scene_name();
        command.on_audit(audit.value());
        audits.push_back(std::move(audit).value());
    }
    return std::nullopt;
}

}  // namespace

Result<std::vector<Audit>> run_audit(const AuditCommand& command) {
    std::vector<Audit> audits;
    for (const Source& source : sources_of(command)) {
        auto scene = source.load();
        if (!scene) return scene.error();
        StageOptions options = command.stage;
        options.scene = source.name;
        auto stage = Stage::open(options, std::move(scene).value());
        if (!stage) return stage.error();
        if (auto error = audit_cameras(*stage.value(), command, audits)) return *error;
    }
    return audits;
}

}  // namespace gnomon::bench
