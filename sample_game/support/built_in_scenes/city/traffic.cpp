#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "sample_game/support/built_in_scenes/city/parts.h"
#include "sample_game/support/built_in_scenes/look_rotation.h"

namespace gnomon::game {
namespace {

constexpr int kStreets = 6, kPerLane = 8, kWalkers = 60;
constexpr double kLane_m = 2.0;  // from the middle of a street to that of a lane
constexpr double kCar_mps = 11.0, kWalk_mps = 1.4, kRide_m = 800.0;

void append(std::vector<float>& values, const glm::dvec3& at_m) {
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(at_m[axis]));
}

/// Way that is ridden again and again.
struct Way {
    glm::dvec3 from_m, to_m;
    double speed_mps;
};

/// Returns the keys of a ride that begins `share` of the way along.
ChannelSpec ride(const CityKit& kit, std::uint32_t node, const Way& way, double share) {
    constexpr double kJump_s = 0.01;
    const double whole_s = glm::length(way.to_m - way.from_m) / way.speed_mps, first_s = whole_s * (1.0 - share);
    const glm::dvec3 start_m = glm::mix(way.from_m, way.to_m, share);
    std::vector<float> times;
    ChannelSpec channel{.node = node, .path = "translation"};
    const auto key = [&](double time_s, const glm::dvec3& at_m) {
        times.push_back(static_cast<float>(time_s));
        append(channel.values, at_m);
    };
    key(0.0, start_m);
    key(first_s, way.to_m);
    if (share > 0.0) {
        key(first_s + kJump_s, way.from_m);
        key(whole_s + kJump_s, start_m);
    }
    channel.times = kit.glb.add_times(times);
    return channel;
}

/// Adds the keys of a walk around a block, from a share of the way on.
ChannelSpec stroll(const CityKit& kit, std::uint32_t node, const glm::dvec3& middle_m, double half_m) {
    const std::array<glm::dvec2, 5> corners{glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    std::vector<float> times;
    ChannelSpec channel{.node = node, .path = "translation"};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        times.push_back(static_cast<float>(static_cast<double>(i) * 2.0 * half_m / kWalk_mps));
        append(channel.values, middle_m + half_m * glm::dvec3(corners[i].x, 0.0, corners[i].y));
    }
    channel.times = kit.glb.add_times(times);
    return channel;
}

/// Adds the light of all headlamps. At its range it is 0.3 lux, a two-thousandth of the sun's.
std::uint32_t add_headlamp(const CityKit& kit) {
    return kit.glb.add_light({.type = "spot",
                              .colour = {1.0, 0.95, 0.85},
                              .intensity = 12000.0,
                              .cone = ConeSpec{glm::radians(12.0), glm::radians(26.0)},
                              .range_m = 200.0});
}

/// Adds the cars of a lane. Two of them have their headlamps on.
void add_lane(const CityKit& kit, int street, int lane, std::uint32_t headlamp, std::vector<ChannelSpec>& channels) {
    const double x_m = (street - kStreets / 2 + 0.5) * kBlock_m + (lane == 0 ? kLane_m : -kLane_m);
    const double end_m = lane == 0 ? -0.5 * kRide_m : 0.5 * kRide_m;
    for (int i = 0; i < kPerLane; ++i) {
        const std::string name = "car_" + std::to_string(street) + "_" + std::to_string(lane) + "_" + std::to_string(i);
        const std::uint32_t car = kit.glb.add_node(
            {.name = name, .rotation = turned(lane == 0 ? 0.0 : 180.0), .mesh = kit.meshes.cars[kit.below(3)]});
        const double share = (i + 0.0625 * kit.below(12)) / kPerLane;
        channels.push_back(ride(kit, car, {{x_m, 0.0, -end_m}, {x_m, 0.0, end_m}, kCar_mps}, share));
        if (i % 4 != 0) continue;
        kit.glb.add_node({.name = name + "_headlamp",
                          .parent = car,
                          .translation_m = {0.0, 0.72, -2.3},
                          .rotation = facing({0.0, -0.06, -1.0}),
                          .light = headlamp});
    }
}

/// Adds a camera that rides. `down`: tangent of the angle at which it looks below its way.
ChannelSpec add_riding_camera(const CityKit& kit, const std::string& name, const Way& way, double down) {
    const std::uint32_t camera = kit.glb.add_camera({.name = name, .fov_y_rad = glm::radians(55.0), .near_m = 0.1});
    const std::uint32_t carrier = kit.glb.add_node({.name = name + "_way"});
    kit.glb.add_node({.name = name,
                      .parent = carrier,
                      .rotation = facing(glm::normalize(way.to_m - way.from_m) - glm::dvec3(0.0, down, 0.0)),
                      .camera = camera});
    return ride(kit, carrier, way, 0.0);
}

}  // namespace

void add_traffic(const CityKit& kit) {
    std::vector<ChannelSpec> channels;
    const std::uint32_t headlamp = add_headlamp(kit);
    for (int street = 0; street < kStreets; ++street)
        for (const int lane : {0, 1}) add_lane(kit, street, lane, headlamp, channels);
    for (int i = 0; i < kWalkers; ++i) {
        const std::uint32_t walker =
            kit.glb.add_node({.name = "walker_" + std::to_string(i), .mesh = kit.meshes.person});
        const glm::dvec3 middle_m((i % 6 - 3) * kBlock_m, kCurb_m, (i / 6 % 6 - 3) * kBlock_m);
        channels.push_back(stroll(kit, walker, middle_m, 28.0 + 0.4 * (i / 36) + 0.0625 * kit.below(4)));
    }
    constexpr double kEye_m = kCurb_m + 1.65, kFlight_mps = 60.0;
    channels.push_back(
        add_riding_camera(kit, "walk", {{29.4, kEye_m, 200.0}, {29.4, kEye_m, -200.0}, kWalk_mps}, 0.04));
    channels.push_back(
        add_riding_camera(kit, "drive", {{40.0, 1.5, 390.0}, {40.0, 1.5, -390.0}, kCar_mps + 2.0}, 0.04));
    channels.push_back(
        add_riding_camera(kit, "fly", {{-900.0, 90.0, 1500.0}, {900.0, 90.0, -1500.0}, kFlight_mps}, 0.3));
    kit.glb.add_animation("traffic", channels);
}

}  // namespace gnomon::game
