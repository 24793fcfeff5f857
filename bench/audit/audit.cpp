#include "bench/audit/audit.h"

#include <algorithm>
#include <thread>

#include "bench/audit/audited_surfaces.h"
#include "systems/visibility/light_queries.h"
#include "tests/oracle/reference_tracer.h"

namespace gnomon::bench {
namespace {

double share(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Audit of one light of a picture with traced primary rays.
class LightAuditor {
public:
    LightAuditor(const oracle::ReferenceTracer& tracer, const oracle::PrimaryHits& hits, const SceneSnapshot& traced,
                 const SceneSnapshot& queried, const std::vector<std::uint8_t>& other_triangle,
                 visibility::CasterTrees& trees)
        : tracer_(tracer),
          hits_(hits),
          traced_(traced),
          queried_(queried),
          other_(other_triangle),
          queries_(trees),
          surfaces_(queried, trees) {}

    AuditedLight audit(const LightItem& of_scene) {
        LightItem light = of_scene;
        light.source_radius_m = light.sun_radius_rad = light.width_m = light.height_m = 0.0f;
        AuditedLight audited;
        audited.name = light.name;
        audited.kind = light.kind;
        const oracle::LightTruth truth = tracer_.trace_light(hits_, light, true);
        const std::vector<std::uint32_t> pixels = compared_pixels(light, truth);
        const std::vector<float> answers = ask(light, pixels);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const bool differs = answers[i] != truth.visibility[pixels[i]];
            const bool ambiguous = truth.ambiguous[pixels[i]] != 0;
            ++(ambiguous ? audited.ambiguous_px : audited.compared_px);
            audited.ambiguous_disagreeing_px += differs && ambiguous;
            if (differs && !ambiguous) audited.disagreements.push_back(described(light, pixels[i], answers[i] > 0.0f));
        }
        return audited;
    }

private:
    /// Returns the pixels for which a ray decides.
    std::vector<std::uint32_t> compared_pixels(const LightItem& light, const oracle::LightTruth& truth) const {
        std::vector<std::uint32_t> pixels;
        for (std::uint32_t i = 0; i < hits_.count(); ++i)
            if (truth.scored[i] && !other_[i] &&
                receives_under(light, traced_.instances[tracer_.source_of(hits_.triangle[i]).instance]))
                pixels.push_back(i);
        return pixels;
    }

    std::vector<float> ask(const LightItem& light, const std::vector<std::uint32_t>& pixels) {
        std::vector<visibility::Place> places;
        places.reserve(pixels.size());
        for (const std::uint32_t i : pixels)
            places.push_back({surfaces_.on_surface(tracer_.source_of(hits_.triangle[i]), point_ws_m(i)), 0.0});
        std::vector<float> answers(places.size());
        queries_.ask(queried_, light, places, {.threads = std::max(std::thread::hardware_concurrency(), 1u)}, answers);
        return answers;
    }

    ShadowDisagreement described(const LightItem& light, std::uint32_t pixel, bool queried_lit) const {
        const std::uint32_t triangle = hits_.triangle[pixel];
        const std::uint32_t occluder = tracer_.blocker(hits_.position_rel_m[pixel], triangle, light, 0.0);
        return {.at_px = at_px(pixel),
                .point_ws_m = point_ws_m(pixel),
                .surface = tracer_.source_of(triangle),
                .occluder = tracer_.source_of(occluder),
                .traced_lit = occluder == oracle::kNoTriangle,
                .queried_lit = queried_lit};
    }

    glm::uvec2 at_px(std::uint32_t pixel) const { return {pixel % hits_.size_px.x, pixel / hits_.size_px.x}; }
    glm::dvec3 point_ws_m(std::uint32_t pixel) const {
        return traced_.consumers.front().position_ws_m - hits_.camera_rel_m + hits_.position_rel_m[pixel];
    }

    const oracle::ReferenceTracer& tracer_;
    const oracle::PrimaryHits& hits_;
    const SceneSnapshot &traced_, &queried_;
    const std::vector<std::uint8_t>& other_;
    visibility::LightQueries queries_;
    QueriedSurfaces surfaces_;
};

/// Fills in what the two see; returns a flag per pixel in which that is not the same.
std::vector<std::uint8_t> compare_triangles(const std::vector<oracle::PlacedTriangle>& drawn,
                                            const oracle::ReferenceTracer& tracer, const oracle::PrimaryHits& hits,
                                            TrueSurfaces& surfaces, Audit& audit) {
    std::vector<std::uint8_t> other(hits.count(), 0);
    for (std::uint32_t i = 0; i < hits.count(); ++i) {
        const oracle::PlacedTriangle traced = tracer.source_of(hits.triangle[i]);
        audit.surface_px += traced.exists() || drawn[i].exists();
        if (traced == drawn[i]) continue;
        other[i] = 1;
        audit.other_triangles.push_back(
            {{i % hits.size_px.x, i / hits.size_px.x}, drawn[i], traced, surfaces.in_one_plane(drawn[i], traced)});
    }
    return other;
}

}  // namespace

double disagreeing_share(const AuditedLight& light) { return share(light.disagreements.size(), light.compared_px); }

double other_surface_share(const Audit& audit) {
    const auto others = std::count_if(audit.other_triangles.begin(), audit.other_triangles.end(),
                                      [](const OtherTriangle& at) { return !at.in_one_plane; });
    return share(static_cast<std::size_t>(others), audit.surface_px);
}

bool is_sound(const Audit& audit) {
    return other_surface_share(audit) <= kMostOtherSurface &&
           std::all_of(audit.lights.begin(), audit.lights.end(),
                       [](const AuditedLight& light) { return disagreeing_share(light) <= kMostDisagreeing; });
}

Result<Audit> audit_frame(gl::Device& device, const FrameSystem& frame, const assets::MeshLibrary& library,
                          const SceneSnapshot& traced) {
    if (traced.consumers.empty()) return Error{"no usable camera", "", "", "bench.camera"};
    const auto drawn = drawn_triangles(device, frame, library);
    if (!drawn) return drawn.error();
    const ConsumerItem& camera = traced.consumers.front();
    Audit audit;
    audit.camera = camera.name;
    audit.device = device.info().name;
    audit.size_px = camera.viewport_px;
    const oracle::ReferenceTracer tracer(traced, library, camera.position_ws_m);
    const oracle::PrimaryHits hits = tracer.trace_primary(camera);
    TrueSurfaces surfaces(traced, library);
    const std::vector<std::uint8_t> other = compare_triangles(drawn.value(), tracer, hits, surfaces, audit);
    visibility::CasterTrees trees(library);
    trees.update(frame.snapshot());
    LightAuditor auditor(tracer, hits, traced, frame.snapshot(), other, trees);
    for (const LightItem& light : traced.lights) audit.lights.push_back(auditor.audit(light));
    return audit;
}

}  // namespace gnomon::bench
