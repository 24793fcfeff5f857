#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "bench/embed/embed_lights.h"
#include "bench/embed/host_engine.h"
#include "gnomon/shadows.h"

namespace gnomon::bench {

/// An engine's gnomon::Shadows with the casters of a scene, some lights, and the engine's shader that is shadowed by
/// it.
class EmbedClient {
public:
    EmbedClient(HostEngine& engine, HostShadows way) : engine_(engine), way_(way) {}
    ~EmbedClient() { engine_.free_shader(shader_); }
    EmbedClient(const EmbedClient&) = delete;
    EmbedClient& operator=(const EmbedClient&) = delete;

    /// Makes its objects. `only`: lights that the text of lookups has parts for; empty: all kinds, the usual filters.
    /// Errors: those of gnomon::Shadows; "bench.program".
    std::optional<Error> make(const HostScene& scene, const std::optional<EmbedCase>& only = {});

    void put_lights(const std::vector<PlacedLight>& lights);
    void move_lights(const std::vector<PlacedLight>& lights);

    /// Draws the maps that changed, and the mask where that is the client's way.
    void render(const HostCamera& camera);
    /// Lights the engine's surfaces by what render() made.
    void light(const HostCamera& camera) const;
    LightStatus status(std::size_t light) const { return shadows_->status(handles_[light]); }

private:
    HostEngine& engine_;
    HostShadows way_;
    std::unique_ptr<Shadows> shadows_;
    std::vector<PlacedLight> lights_;
    std::vector<LightId> handles_;
    unsigned shader_ = 0, mask_ = 0;
};

/// Returns the lights as an engine's shader takes them. Each has its own place as index.
std::vector<HostLight> host_lights(const std::vector<PlacedLight>& lights, const HostCamera& camera);

}  // namespace gnomon::bench
