#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Movement over time, as glTF 2.0 has it (section 3.11 and appendix C): as data, and as a function of time.
namespace gnomon::assets {

enum class AnimatedProperty : std::uint8_t { translation, rotation, scale, weights };
enum class Interpolation : std::uint8_t { step, linear, cubic };

/// One property of one node.
struct AnimationChannel {
    std::int32_t node = -1;  // of SceneData::nodes
    AnimatedProperty property = AnimatedProperty::translation;
    Interpolation interpolation = Interpolation::linear;
    std::uint32_t width = 3;     // numbers per value; rotation: 4, in the order x, y, z, w
    std::vector<float> times_s;  // at least one, finite, never falling
    std::vector<float> values;   // `width` per key; cubic: tangent in, value and tangent out of each key
};

struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;  // no two of the same node and property
};

/// When the last key of any channel stands; 0 without channels.
double duration_s(const Animation& animation);

/// `time_s` within an animation that begins anew after `duration_s`: in [0, duration_s), and 0 where that is empty or
/// the time is not finite. The end itself is the beginning.
double looped_s(double time_s, double duration_s);

/// The value at `time_s`: `out` holds channel.width numbers. Before the first key and after the last one it is theirs.
/// Rotations come out with unit length; linear ones take the shorter way round at a constant speed.
void sample(const AnimationChannel& channel, double time_s, std::span<double> out);

}  // namespace gnomon::assets
