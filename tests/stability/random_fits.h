#pragma once
#include <cmath>
#include <cstdint>
#include <random>

#include "systems/extract/sampled_depths.h"
#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// A scene, and the depths of an earlier picture of it.
struct SampledScene : SceneSnapshot {
    SampledDepths sampled_depths;
};

/// Hard scenes, drawn one after the other from one seed. Each has one light and one camera or a few. Its boxes have any
/// size and thickness, and lie near, far, around and behind everything. Some lights have a depth range of their own,
/// some suns an eye.
class RandomFits {
public:
    explicit RandomFits(std::uint64_t seed) : random_(seed) {}

    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
    /// Draws a size, equally likely in every octave.
    double size(double from, double to) { return std::exp2(number(std::log2(from), std::log2(to))); }
    bool chance(double share) { return number(0.0, 1.0) < share; }
    glm::dvec3 vector(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }

    /// Draws a moderate scene: everything within some hundred metres, on a lattice of 2^-20 m, so that it can be moved
    /// and scaled without rounding.
    SampledScene scene(LightKind kind);
    /// Draws a moderate scene, and replaces some of its numbers by any finite ones, from 1e-30 to 1e30.
    SampledScene wild_scene(LightKind kind);

private:
    InstanceItem box(std::uint32_t index);
    ConsumerItem camera(const SceneSnapshot& scene);
    LightItem light(LightKind kind, const SceneSnapshot& scene);
    void cascades(LightItem& light);
    void eye(ShadowTuning::Projection& tuning);
    void depth_range(ShadowTuning::Projection& tuning);
    SampledDepths depths(const ConsumerItem& camera);
    glm::dvec3 direction();

    std::mt19937_64 random_;
};

/// Makes the scene `2^power` times as large, exactly.
void scale(SampledScene& scene, int power);
/// Moves the scene. Exact for whole metres below 2^26 and a moderate scene.
void move(SceneSnapshot& scene, const glm::dvec3& by_m);

}  // namespace gnomon::shadow
