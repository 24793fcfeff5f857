#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Animation as in glTF 2.0 (section 3.11 and appendix C): as data, and as a function of time.
namespace gnomon::assets {

enum class AnimatedProperty : std::uint8_t { translation, rotation, scale, weights };
enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Curve of one property of one node.
struct AnimationChannel {
    std::int32_t node = -1;  // index in SceneData::nodes
    AnimatedProperty property = AnimatedProperty::translation;
    Interpolation interpolation = Interpolation::linear;
    std::uint32_t width = 3;     // numbers per value; rotation: 4, in the order x, y, z, w
    std::vector<float> times_s;  // at least one, finite, not decreasing
    std::vector<float> values;   // `width` per key; cubic: in-tangent, value and out-tangent of each key
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;  // at most one per node and property
};

/// Returns the time of the last key of any channel; 0 without channels.
double duration_s(const Animation& animation);

/// Wraps `time_s` into an animation that repeats every `duration_s`: [0, duration_s). 0 if the duration is 0 or the
/// time not finite. The end equals the beginning.
double looped_s(double time_s, double duration_s);

/// Evaluates the channel at `time_s` into `out`, channel.width numbers. Before the first key and after the last it
/// clamps. Rotations have unit length; linear ones take the shorter way at constant speed.
void sample(const AnimationChannel& channel, double time_s, std::span<double> out);

}  // namespace gnomon::assets
