#include "gnomon/assets.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace gnomon::assets {
namespace {

glm::dquat quaternion(std::span<const double> v) { return {v[3], v[0], v[1], v[2]}; }

void put(const glm::dquat& q, std::span<double> out) {
    out[0] = q.x;
    out[1] = q.y;
    out[2] = q.z;
    out[3] = q.w;
}

/// Normalises a quaternion. Tangents may cancel a rotation; a zero result becomes the identity.
void make_unit(std::span<double> out) {
    const glm::dquat q = quaternion(out);
    const double length = glm::length(q);
    put(length > 0.0 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0), out);
}

/// Parts of a key. Cubic channels have all three, others only the value.
enum class Part : std::uint8_t { tangent_in, value, tangent_out };

struct Keys {
    const AnimationChannel& channel;

    double at(std::size_t key, std::size_t number, Part part = Part::value) const {
        const bool cubic = channel.interpolation == Interpolation::cubic;
        const std::size_t row = cubic ? 3 * key + static_cast<std::size_t>(part) : key;
        return static_cast<double>(channel.values[row * channel.width + number]);
    }
    void copy(std::size_t key, std::span<double> out) const {
        for (std::size_t i = 0; i < channel.width; ++i) out[i] = at(key, i);
    }
};

void turn(const Keys& keys, std::size_t key, double share, std::span<double> out) {
    double next[4];
    keys.copy(key, out);
    keys.copy(key + 1, next);
    make_unit(out);
    make_unit(next);
    put(glm::normalize(glm::slerp(quaternion(out), quaternion(next), share)), out);
}

/// Interpolates by a cubic Hermite spline (glTF 2.0, appendix C.5).
void bend(const Keys& keys, std::size_t key, double share, double span_s, std::span<double> out) {
    const double t = share, t2 = t * t, t3 = t2 * t;
    for (std::size_t i = 0; i < keys.channel.width; ++i)
        out[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * keys.at(key, i) +
                 span_s * (t3 - 2.0 * t2 + t) * keys.at(key, i, Part::tangent_out) +
                 (-2.0 * t3 + 3.0 * t2) * keys.at(key + 1, i) +
                 span_s * (t3 - t2) * keys.at(key + 1, i, Part::tangent_in);
}

}  // namespace

double duration_s(const Animation& animation) {
    double last_s = 0.0;
    for (const AnimationChannel& channel : animation.channels)
        last_s = std::max(last_s, static_cast<double>(channel.times_s.back()));
    return last_s;
}

double looped_s(double time_s, double duration_s) {
    if (!(duration_s > 0.0) || !std::isfinite(time_s)) return 0.0;
    const double rest_s = std::fmod(time_s, duration_s);
    const double within_s = rest_s < 0.0 ? rest_s + duration_s : rest_s;
    return within_s < duration_s ? within_s : 0.0;  // a rest just below 0 rounds up to the end
}

void sample(const AnimationChannel& channel, double time_s, std::span<double> out) {
    const Keys keys{channel};
    const auto& times = channel.times_s;
    const auto after = static_cast<std::size_t>(
        std::upper_bound(times.begin(), times.end(), time_s,
                         [](double time, float key) { return time < static_cast<double>(key); }) -
        times.begin());
    const bool rotation = channel.property == AnimatedProperty::rotation;
    const std::size_t key = after == 0 ? 0 : after - 1;
    if (after == 0 || after == times.size() || channel.interpolation == Interpolation::step) {
        keys.copy(key, out);
        if (rotation) make_unit(out);
        return;
    }
    const double start_s = static_cast<double>(times[key]), span_s = static_cast<double>(times[after]) - start_s;
    const double share = (time_s - start_s) / span_s;  // span_s > 0: the later key lies after time_s
    if (channel.interpolation == Interpolation::cubic) {
        bend(keys, key, share, span_s, out);
        if (rotation) make_unit(out);
    } else if (rotation) {
        turn(keys, key, share, out);
    } else {
        for (std::size_t i = 0; i < channel.width; ++i)
            out[i] = (1.0 - share) * keys.at(key, i) + share * keys.at(after, i);
    }
}

}  // namespace gnomon::assets
