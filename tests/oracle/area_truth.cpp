#include "tests/oracle/area_truth.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/oracle/light_reach.h"
#include "tests/oracle/parallel_rows.h"
#include "tests/oracle/pixel_ray.h"
#include "tests/oracle/reference_world.h"
#include "systems/extract/source_place.h"
#include "tests/oracle/soft_truth.h"

namespace gnomon::oracle {
namespace {

/// What the places of a pixel found.
struct Places {
    std::uint32_t all = 0, seen = 0, lit = 0;  // all places; those on the seen surface; the lit ones of these
    std::uint32_t behind = 0;                  // seen ones, for places of the source behind the surface
    std::uint32_t rays() const { return seen - behind; }
    double light = 0.0, lit_light = 0.0;       // sums of the rays' weights, 1 except for places of area lights
    bool faces = true;                         // false: the light does not reach or face some place
    bool mixed() const { return !faces || seen < all || (lit > 0 && lit < rays()); }
    bool is_lit() const { return lit > 0; }
    /// Writes what they found; nothing where the light does not reach or face them all, or none is on the surface.
    void write(std::size_t i, AreaTruth& truth) const {
        if (all == 0 || !faces || rays() == 0) return;
        truth.lit[i] = static_cast<float>(lit_light / light);
        truth.area[i] = seen == all ? PixelArea::whole : PixelArea::partial;
    }
};

/// Returns the i-th of `count` places of the unit square around the origin. A lattice, because rows of a grid lie all
/// on one side of an edge along them.
glm::dvec2 lattice_place(std::uint32_t i, std::uint32_t count) {
    constexpr double kGolden = 0.6180339887498949;
    const double turns = (i + 0.5) * kGolden;
    return {(i + 0.5) / count - 0.5, turns - std::floor(turns) - 0.5};
}

/// Returns the i-th place of the unit disk, in no step with lattice_place(). Neighbouring pixels have others, so that
/// few rays of each find what few of one would miss.
glm::dvec2 source_disk_place(std::uint32_t i, std::size_t pixel) {
    const glm::dvec2 turns = (i + 0.5) * glm::dvec2(std::sqrt(2.0), std::sqrt(3.0)) +
                             static_cast<double>(pixel) * glm::dvec2(std::sqrt(5.0), std::sqrt(7.0));
    return on_disk(turns - glm::floor(turns));
}

class AreaTracer {
public:
    AreaTracer(const TracedWorld& world, const ConsumerItem& camera, const PrimaryHits& hits, const LightItem& light,
               bool of_source)
        : world_(world),
          camera_(camera),
          hits_(hits),
          light_(light),
          light_rel_m_(light.position_ws_m - world.origin_ws_m()),
          source_(of_source ? source_size(light) : 0.0) {}

    Places trace(std::size_t pixel, std::uint32_t side, std::uint32_t& hint) const {
        const glm::dvec2 centre = glm::dvec2(static_cast<double>(pixel % hits_.size_px.x),
                                             static_cast<double>(pixel / hits_.size_px.x)) +
                                  hits_.jitter_px;
        Places places;
        places.all = side * side;
        const double within_m = kSameSurface_px * pixel_width_m(pixel, centre);
        for (std::uint32_t i = 0; i < side * side && places.faces; ++i) {
            add_place(pixel, centre + lattice_place(i, side * side), source_disk_place(i, pixel), within_m, places, hint);
        }
        return places;
    }

private:
    /// Returns the width of a pixel across its ray at the seen place.
    double pixel_width_m(std::size_t pixel, const glm::dvec2& centre) const {
        const PixelRay here = pixel_ray(camera_, hits_.camera_rel_m, centre);
        const PixelRay beside = pixel_ray(camera_, hits_.camera_rel_m, centre + glm::dvec2(0.0, 1.0));
        const double along = glm::dot(here.ray.direction, here.ray.direction);
        const double t = glm::dot(hits_.position_rel_m[pixel] - here.ray.origin, here.ray.direction) / along;
        return glm::length(beside.ray.origin - here.ray.origin + (beside.ray.direction - here.ray.direction) * t);
    }

    void add_place(std::size_t pixel, const glm::dvec2& at_px, const glm::dvec2& on_source, double within_m,
                   Places& places, std::uint32_t& hint) const {
        const PixelRay seen = pixel_ray(camera_, hits_.camera_rel_m, at_px);
        const SurfaceHit hit = world_.nearest_surface(seen.ray, seen.t_min, seen.t_max);
        if (hit.triangle == kNoTriangle) return;
        const WorldTriangle& triangle = world_.triangles()[hit.triangle];
        const glm::dvec3 front = glm::normalize(front_normal(triangle));
        glm::dvec3 point = seen.ray.origin + seen.ray.direction * hit.t;
        point -= front * glm::dot(front, point - triangle.a);
        const double off_m = glm::dot(hits_.normal_ws[pixel], point - hits_.position_rel_m[pixel]);
        if (!(std::abs(off_m) <= within_m)) return;
        const glm::dvec3 normal = glm::dot(front, seen.ray.direction) > 0.0 ? -front : front;
        glm::dvec3 to_light;
        double t_max = 0.0;
        const bool reached = reach(light_, light_rel_m_, point, to_light, t_max);
        const bool of_area = source_ > 0.0 && light_facts(light_.kind).area();
        places.faces = reached && (of_area ? sees_source(light_, to_light, normal)
                                           : cosine_between(normal, to_light) > kMinCosine);
        if (!places.faces) return;
        ++places.seen;
        const ShadowLayers layers = light_.shadow.layers;
        if ((triangle.receive_layers & layers) == 0) {
            ++places.lit;
            places.light += 1.0;
            places.lit_light += 1.0;
            return;
        }
        double weight = 1.0;
        if (of_area) {
            const SourceShape shape = light_facts(light_.kind).shape;
            const bool square = shape == SourceShape::rectangle || shape == SourceShape::tube;
            const SourcePlace place = source_place(light_, to_light, square ? disk_to_square(on_source) : on_source);
            to_light = place.way_m;
            weight = place.weight > 0.0 ? place.weight * cosine_between(normal, to_light) : 0.0;
            if (!(weight > 0.0)) {
                ++places.behind;
                return;
            }
        } else if (source_ > 0.0) {
            const auto axes = tangents(glm::normalize(to_light));
            to_light += source_ * (axes[0] * on_source.x + axes[1] * on_source.y);
            if (!(glm::dot(to_light, normal) > 0.0)) {
                ++places.behind;
                return;
            }
        }
        const std::uint32_t found = world_.occluder(make_ray(point, to_light), t_max, hit.triangle, hint, layers);
        places.light += weight;
        if (found == kNoTriangle) {
            ++places.lit;
            places.lit_light += weight;
        } else {
            hint = found;
        }
    }

    const TracedWorld& world_;
    const ConsumerItem& camera_;
    const PrimaryHits& hits_;
    const LightItem& light_;
    glm::dvec3 light_rel_m_;
    double source_;
};

// Rays that go first, along a side. Pixels with other results, or neighbours with other results, get more.
constexpr std::array<std::uint32_t, 2> kFirst{2, 4};

}  // namespace

AreaTruth ReferenceTracer::trace_area(const ConsumerItem& camera, const PrimaryHits& hits, const LightTruth& middles,
                                      const LightItem& light, const AreaSampling& sampling) const {
    const AreaTracer tracer(world_->traced, camera, hits, light, sampling.of_source);
    const glm::ivec2 size(hits.size_px);
    AreaTruth truth;
    truth.lit.assign(hits.count(), -1.0f);
    truth.area.assign(hits.count(), PixelArea::unscored);
    std::vector<Places> found(hits.count());
    // Returns true if the pixel's own places differ, or those of a pixel in the square of 3 x 3 around it.
    const auto undecided = [&](const std::vector<Places>& of, const glm::ivec2& at) {
        const auto places = [&](int x, int y) -> const Places& {
            return of[static_cast<std::size_t>(y) * hits.size_px.x + static_cast<std::size_t>(x)];
        };
        const Places& own = places(at.x, at.y);
        if (own.mixed()) return true;
        for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, size.y - 1); ++y)
            for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, size.x - 1); ++x) {
                const Places& other = places(x, y);
                if (other.all > 0 && (other.mixed() || other.is_lit() != own.is_lit())) return true;
            }
        return false;
    };
    std::atomic<std::size_t> sampled{0};
    const auto trace_where = [&](std::uint32_t side, const auto& needs) {
        const std::vector<Places> before = found;
        parallel_rows(hits.size_px.y, world_->threads, [&](std::uint32_t row) {
            std::uint32_t hint = kNoTriangle;
            for (std::uint32_t x = 0; x < hits.size_px.x; ++x) {
                const std::size_t pixel = std::size_t{row} * hits.size_px.x + x;
                if (middles.scored[pixel] == 0 || !needs(before, glm::ivec2(x, row))) continue;
                found[pixel] = tracer.trace(pixel, side, hint);
                sampled += side == sampling.side;
            }
        });
    };
    const auto always = [](const std::vector<Places>&, const glm::ivec2&) { return true; };
    if (sampling.of_source) {
        trace_where(kFirst[1], always);
    } else {
        trace_where(kFirst[0], always);
        trace_where(kFirst[1], undecided);
    }
    trace_where(sampling.side, undecided);
    truth.sampled = sampled;
    for (std::size_t i = 0; i < hits.count(); ++i) found[i].write(i, truth);
    return truth;
}

AreaTruth ReferenceTracer::trace_area(const ConsumerItem& camera, const PrimaryHits& hits,
                                      std::span<const std::size_t> pixels, const LightItem& light,
                                      const AreaSampling& sampling) const {
    constexpr std::size_t kChunk = 16;
    const AreaTracer tracer(world_->traced, camera, hits, light, sampling.of_source);
    AreaTruth truth;
    truth.lit.assign(pixels.size(), -1.0f);
    truth.area.assign(pixels.size(), PixelArea::unscored);
    truth.sampled = pixels.size();
    const auto chunks = static_cast<std::uint32_t>((pixels.size() + kChunk - 1) / kChunk);
    parallel_rows(chunks, world_->threads, [&](std::uint32_t chunk) {
        std::uint32_t hint = kNoTriangle;
        for (std::size_t i = chunk * kChunk; i < std::min(pixels.size(), (chunk + 1) * kChunk); ++i)
            if (hits.triangle[pixels[i]] != kNoTriangle)
                tracer.trace(pixels[i], sampling.side, hint).write(i, truth);
    });
    return truth;
}

AreaMetrics compare_area(const AreaTruth& truth, std::span<const float> measured,
                         std::span<const std::uint8_t> ambiguous) {
    assert(measured.size() == truth.lit.size());
    AreaMetrics m;
    std::vector<double> errors;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (truth.area[i] == PixelArea::unscored || (!ambiguous.empty() && ambiguous[i] != 0)) continue;
        const bool crossed = truth.lit[i] > 0.0f && truth.lit[i] < 1.0f, is_known = measured[i] >= 0.0f;
        const double off = is_known ? static_cast<double>(measured[i] - truth.lit[i]) : 1.0;
        if (truth.area[i] == PixelArea::partial) {
            m.partial += crossed;
            m.partial_error += crossed ? std::abs(off) : 0.0;
        } else if (crossed) {
            ++m.crossed;
            errors.push_back(std::abs(off));
            m.mean_error += std::abs(off);
            m.bias += is_known ? off : 0.0;
        } else {
            ++m.uncrossed;
            m.uncrossed_error += std::abs(off);
        }
    }
    const auto divide = [](double& sum, std::size_t count) {
        sum = count == 0 ? 0.0 : sum / static_cast<double>(count);
    };
    divide(m.mean_error, m.crossed);
    divide(m.bias, m.crossed);
    divide(m.uncrossed_error, m.uncrossed);
    divide(m.partial_error, m.partial);
    std::sort(errors.begin(), errors.end());
    constexpr double kTail = 0.99;
    if (!errors.empty())
        m.p99_error = errors[static_cast<std::size_t>(std::ceil(kTail * static_cast<double>(errors.size()))) - 1];
    return m;
}

}  // namespace gnomon::oracle
