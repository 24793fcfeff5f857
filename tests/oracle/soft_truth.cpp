#include "tests/oracle/soft_truth.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "systems/extract/source_place.h"
#include "tests/oracle/light_reach.h"
#include "tests/oracle/parallel_rows.h"
#include "tests/oracle/reference_world.h"

namespace gnomon::oracle {
namespace {

constexpr std::uint32_t kCoarser = 4;  // SourceSampling::first_few
constexpr int kNeighbours_px = 2;

/// Hashes x so that every bit of the result depends on every bit of x (the finaliser of MurmurHash3).
std::uint64_t scrambled(std::uint64_t x) {
    x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
    x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return x ^ (x >> 33);
}

/// Returns two numbers in [0, 1).
glm::dvec2 random_place(std::uint64_t seed) {
    constexpr double kUnit = 1.0 / 4294967296.0;
    const std::uint64_t bits = scrambled(seed);
    return {static_cast<double>(bits & 0xffffffffULL) * kUnit, static_cast<double>(bits >> 32) * kUnit};
}

/// What a pixel's rays found: sums of their weights, which are 1 except for area lights.
struct Sum {
    double lit = 0.0, rays = 0.0;  // only of rays that leave the surface
    bool all_lit() const { return lit == rays; }
    bool mixed() const { return lit > 0.0 && lit < rays; }
};

class SourceTracer {
public:
    SourceTracer(const TracedWorld& world, const PrimaryHits& hits, const LightItem& light)
        : world_(world), hits_(hits), light_(light), size_(source_size(light)), area_(light_facts(light.kind).area()) {}

    /// Returns whether the light's middle is in reach and before the surface.
    bool scored(std::size_t pixel) const {
        if (hits_.triangle[pixel] == kNoTriangle) return false;
        glm::dvec3 to_light;
        double t_max = 0.0;
        const bool reached = reach(light_, light_rel_m(), hits_.position_rel_m[pixel], to_light, t_max);
        if (area_) return reached && sees_source(light_, to_light, hits_.normal_ws[pixel]);
        return reached && cosine_between(hits_.normal_ws[pixel], to_light) > kMinCosine;
    }

    Sum trace(std::size_t pixel, std::uint32_t side, std::uint32_t& hint) const {
        const glm::dvec3& point = hits_.position_rel_m[pixel];
        const std::uint32_t triangle = hits_.triangle[pixel];
        const ShadowLayers layers = light_.shadow.layers;
        if ((world_.triangles()[triangle].receive_layers & layers) == 0) return {1, 1};
        glm::dvec3 middle;
        double t_max = 0.0;
        reach(light_, light_rel_m(), point, middle, t_max);
        const auto axes = tangents(glm::normalize(middle));
        Sum sum;
        for (std::uint32_t i = 0; i < side * side; ++i) {
            const glm::dvec2 cell(i % side, i / side);
            const std::uint64_t seed =
                (static_cast<std::uint64_t>(pixel) << 20) + (static_cast<std::uint64_t>(side) << 12) + i;
            const glm::dvec2 in_square = (cell + random_place(seed)) / static_cast<double>(side);
            const auto [toward, weight] = area_ ? way_to(pixel, middle, in_square) : way_to_disk(middle, axes, in_square);
            if (!(weight > 0.0) || !(glm::dot(toward, hits_.normal_ws[pixel]) > 0.0)) continue;
            const std::uint32_t found = world_.occluder(make_ray(point, toward), t_max, triangle, hint, layers);
            sum.rays += weight;
            if (found == kNoTriangle)
                sum.lit += weight;
            else
                hint = found;
        }
        return sum;
    }

private:
    /// A way to the source, and how much of the light comes along it.
    struct Way {
        glm::dvec3 toward;
        double weight;
    };
    Way way_to_disk(const glm::dvec3& middle, const std::array<glm::dvec3, 2>& axes, const glm::dvec2& in_square) const {
        const glm::dvec2 at = on_disk(in_square) * size_;
        return {middle + axes[0] * at.x + axes[1] * at.y, 1.0};
    }
    Way way_to(std::size_t pixel, const glm::dvec3& middle, const glm::dvec2& in_square) const {
        const SourceShape shape = light_facts(light_.kind).shape;
        const bool round = shape == SourceShape::disc || shape == SourceShape::sphere;
        const SourcePlace place = source_place(light_, middle, round ? on_disk(in_square) : 2.0 * in_square - 1.0);
        const double length = glm::length(place.way_m);
        return {place.way_m,
                length > 0.0 ? place.weight * glm::dot(place.way_m, hits_.normal_ws[pixel]) / length : 0.0};
    }

    glm::dvec3 light_rel_m() const { return light_.position_ws_m - world_.origin_ws_m(); }

    const TracedWorld& world_;
    const PrimaryHits& hits_;
    const LightItem& light_;
    double size_;
    bool area_;
};

/// Returns whether a few rays leave open what the pixel sees.
bool undecided(const std::vector<Sum>& few, const glm::uvec2& size_px, const glm::ivec2& at) {
    const auto sum = [&](int x, int y) {
        return few[static_cast<std::size_t>(y) * size_px.x + static_cast<std::size_t>(x)];
    };
    const Sum own = sum(at.x, at.y);
    if (own.rays == 0.0 || own.mixed()) return true;
    const glm::ivec2 last = glm::ivec2(size_px) - 1;
    const glm::ivec2 from = glm::max(at - kNeighbours_px, glm::ivec2(0)), to = glm::min(at + kNeighbours_px, last);
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            const Sum other = sum(x, y);
            if (other.rays > 0.0 && (other.mixed() || other.all_lit() != own.all_lit())) return true;
        }
    return false;
}

}  // namespace

double source_size(const LightItem& light) {
    if (light.kind == LightKind::directional) return std::tan(static_cast<double>(light.sun_radius_rad));
    return static_cast<double>(source_extent(light));
}

glm::dvec2 on_disk(const glm::dvec2& square) {
    const glm::dvec2 p = 2.0 * square - 1.0;
    if (p.x == 0.0 && p.y == 0.0) return p;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const double radius = wide ? p.x : p.y;
    const double angle_rad = wide ? glm::quarter_pi<double>() * (p.y / p.x)
                                  : glm::half_pi<double>() - glm::quarter_pi<double>() * (p.x / p.y);
    return {radius * std::cos(angle_rad), radius * std::sin(angle_rad)};
}

SoftTruth ReferenceTracer::trace_source(const PrimaryHits& hits, const LightItem& light,
                                        const SourceSampling& sampling) const {
    const SourceTracer tracer(world_->traced, hits, light);
    const glm::uvec2 size_px = hits.size_px;
    SoftTruth truth;
    truth.visibility.assign(hits.count(), -1.0f);
    truth.scored.assign(hits.count(), 0);
    std::vector<Sum> few(hits.count());
    const auto for_each_pixel = [&](const auto& work) {
        parallel_rows(size_px.y, world_->threads, [&](std::uint32_t row) {
            std::uint32_t hint = kNoTriangle;
            for (std::uint32_t x = 0; x < size_px.x; ++x)
                work(std::size_t{row} * size_px.x + x, glm::ivec2(x, row), hint);
        });
    };
    for_each_pixel([&](std::size_t pixel, const glm::ivec2&, std::uint32_t& hint) {
        if (hits.triangle[pixel] != kNoTriangle) truth.visibility[pixel] = 0.0f;
        truth.scored[pixel] = tracer.scored(pixel);
        if (truth.scored[pixel] && sampling.first_few)
            few[pixel] = tracer.trace(pixel, std::max(sampling.side / kCoarser, 1u), hint);
    });
    std::atomic<std::size_t> sampled{0};
    for_each_pixel([&](std::size_t pixel, const glm::ivec2& at, std::uint32_t& hint) {
        if (!truth.scored[pixel]) return;
        Sum sum = few[pixel];
        if (undecided(few, size_px, at)) {
            sum = tracer.trace(pixel, sampling.side, hint);
            ++sampled;
        }
        truth.visibility[pixel] = sum.rays == 0.0 ? 0.0f : static_cast<float>(sum.lit / sum.rays);
    });
    truth.sampled = sampled;
    return truth;
}

}  // namespace gnomon::oracle
