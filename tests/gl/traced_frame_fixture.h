#pragma once
#include <sstream>

#include "engine/mesh/mesh_topology.h"
#include "tests/gl/frame_fixture.h"
#include "tests/oracle/metrics.h"
#include "tests/oracle/reference_tracer.h"

namespace gnomon {

/// A small world, drawn by the whole pipeline and judged by rays.
class TracedFrameTest : public FrameTest {
protected:
    /// Adds a mesh as an importer leaves it, with its topology known: whether it is closed, too.
    std::uint32_t add_analysed(const game::Shape& shape, std::optional<std::uint32_t> material = {}) {
        const std::uint32_t mesh = add_mesh(shape, material);
        library.meshes[mesh].topology = assets::analyse_topology(library.meshes[mesh]);
        return mesh;
    }
    /// Adds a light of this kind above the ground, which shines on the origin.
    ecs::Entity add_light_of(LightKind kind, const glm::dvec3& at_m, const LightShadow& shadow,
                             const ShadowTuning& tuning = {}) {
        return add_light({.kind = kind, .range_m = 0.0f, .outer_cone_rad = 1.0f}, at_m, -at_m, shadow, tuning);
    }
    struct Judged {
        oracle::Metrics metrics;
        std::vector<float> measured, truth;
        std::size_t truly_dark = 0;  // scored pixels that are dark by rays
    };
    /// Pixels of many pictures.
    struct Tally {
        double scored = 0.0, dark = 0.0, false_light = 0.0, false_shadow = 0.0;
        void add(const Judged& judged) {
            scored += static_cast<double>(judged.metrics.scored);
            dark += static_cast<double>(judged.truly_dark);
            false_light += static_cast<double>(judged.metrics.false_light);
            false_shadow += static_cast<double>(judged.metrics.false_shadow);
        }
        std::string text() const {
            std::ostringstream line;
            line << scored << " pixels, " << 100.0 * dark / scored << " % truly dark; false light in "
                 << 100.0 * false_light / scored << " %, false shadow in " << 100.0 * false_shadow / scored << " %";
            return line.str();
        }
    };
    /// Judges the light as drawn, against the snapshot that was drawn, or against `claimed`.
    Judged judge(std::uint32_t light, const SceneSnapshot& claimed) {
        return judge(light, claimed, visibility(light));
    }
    /// Judges visibilities that something else measured.
    Judged judge(std::uint32_t light, const SceneSnapshot& claimed, const std::vector<float>& measured) {
        const ConsumerItem& camera = claimed.consumers.at(0);
        const oracle::ReferenceTracer tracer(claimed, library, camera.position_ws_m);
        const oracle::PrimaryHits hits = tracer.trace_primary(camera);
        const oracle::LightTruth truth = tracer.trace_light(hits, claimed.lights.at(light), true);
        std::size_t truly_dark = 0;
        for (std::size_t i = 0; i < measured.size(); ++i) truly_dark += truth.scored[i] && truth.visibility[i] < 0.5f;
        return {oracle::compare({hits.size_px, measured, truth.visibility, truth.scored, truth.ambiguous}), measured,
                truth.visibility, truly_dark};
    }
    Judged judge(std::uint32_t light = 0) { return judge(light, frame().snapshot()); }
};

}  // namespace gnomon
