#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "sample_game/support/built_in_scenes/courtyard/parts.h"

namespace gnomon::game {
namespace {

/// His joints, and where they are while he stands, feet at the origin, looking along -Z.
enum Joint : std::uint8_t { hips, chest, head, arm_l, arm_r, leg_l, leg_r, shin_l, shin_r, kJoints };
struct JointRow {
    const char* name;
    Joint parent;  // the hips are their own
    glm::dvec3 at_m;
};
constexpr double kKnee_m = 0.48;
const std::array<JointRow, kJoints> kRows{{{"guard_hips", hips, {0.0, 0.92, 0.0}},
                                           {"guard_chest", hips, {0.0, 1.12, 0.0}},
                                           {"guard_neck", chest, {0.0, 1.5, 0.0}},
                                           {"guard_arm_l", chest, {-0.26, 1.4, 0.0}},
                                           {"guard_arm_r", chest, {0.26, 1.4, 0.0}},
                                           {"guard_leg_l", hips, {-0.11, 0.9, 0.0}},
                                           {"guard_leg_r", hips, {0.11, 0.9, 0.0}},
                                           {"guard_shin_l", leg_l, {-0.11, kKnee_m, 0.0}},
                                           {"guard_shin_r", leg_r, {0.11, kKnee_m, 0.0}}}};

/// Shape with a joint share per vertex.
struct Limb {
    Shape shape;
    std::vector<JointShare> joints;

    /// Adds a part. share(position), in the figure's space, returns the joints of a vertex.
    template <class Share>
    void add(const Shape& part, const glm::dvec3& at_m, Share&& share) {
        const std::size_t first = shape.positions.size();
        append(shape, part, glm::translate(glm::dmat4(1.0), at_m));
        for (std::size_t v = first; v < shape.positions.size(); ++v) joints.push_back(share(shape.positions[v]));
    }
    void add(const Shape& part, const glm::dvec3& at_m, Joint joint) {
        add(part, at_m, [joint](const glm::vec3&) { return JointShare{joint, joint, 0.0f}; });
    }
};

/// Blends from one joint to the one above, over 2 * kBlend_m around a height.
constexpr float kBlend_m = 0.12f;
JointShare across(float y, double at_m, Joint below, Joint above) {
    const float share = (y - static_cast<float>(at_m) + kBlend_m) / (2.0f * kBlend_m);
    return {below, above, std::clamp(share, 0.0f, 1.0f)};
}

Limb coat() {
    // Rings close together where the figure bends.
    const std::array<glm::dvec2, 10> outline{glm::dvec2(0.0, 0.62), {0.21, 0.62}, {0.2, 0.8},  {0.19, 1.0},
                                             {0.185, 1.06},         {0.19, 1.12}, {0.2, 1.18}, {0.24, 1.36},
                                             {0.14, 1.47},          {0.0, 1.5}};
    const std::array<glm::dvec2, 9> leg{glm::dvec2(0.0, 0.1), {0.075, 0.1}, {0.085, 0.36}, {0.085, 0.42}, {0.085, 0.48},
                                        {0.088, 0.54},        {0.09, 0.6},  {0.1, 0.9},    {0.0, 0.92}};
    Limb limb;
    limb.add(make_lathe(outline, 20, LatheNormals::smooth), {},
             [](const glm::vec3& p) { return across(p.y, kRows[chest].at_m.y, hips, chest); });
    const auto leg_shape = make_lathe(leg, 12, LatheNormals::smooth);
    limb.add(leg_shape, {kRows[leg_l].at_m.x, 0.0, 0.0},
             [](const glm::vec3& p) { return across(p.y, kKnee_m, shin_l, leg_l); });
    limb.add(leg_shape, {kRows[leg_r].at_m.x, 0.0, 0.0},
             [](const glm::vec3& p) { return across(p.y, kKnee_m, shin_r, leg_r); });
    limb.add(make_bar({-0.25, 1.4, 0.0}, {-0.34, 0.88, -0.06}, 0.06, 10), {}, arm_l);
    limb.add(make_bar({0.25, 1.4, 0.0}, {0.34, 0.88, -0.06}, 0.06, 10), {}, arm_r);
    return limb;
}

Limb face_and_hands() {
    Limb limb;
    limb.add(make_sphere(0.12, 18, 10), {0.0, 1.6, 0.0}, head);
    limb.add(make_sphere(0.065, 12, 8), {-0.35, 0.83, -0.065}, arm_l);
    limb.add(make_sphere(0.065, 12, 8), {0.35, 0.83, -0.065}, arm_r);
    return limb;
}

Limb iron() {
    const std::array<glm::dvec2, 6> helmet{glm::dvec2(0.0, 1.63), {0.19, 1.63}, {0.19, 1.65},
                                           {0.135, 1.67},         {0.1, 1.76},  {0.0, 1.8}};
    const std::array<glm::dvec2, 4> tip{glm::dvec2(0.0, 2.1), {0.05, 2.1}, {0.035, 2.2}, {0.0, 2.42}};
    Limb limb;
    limb.add(make_lathe(helmet, 18, LatheNormals::creased), {}, head);
    limb.add(make_lathe(tip, 8, LatheNormals::creased), {0.38, 0.0, -0.12}, arm_r);
    for (const auto& [x, joint] : {std::pair{-0.11, shin_l}, std::pair{0.11, shin_r}})
        limb.add(make_box({-0.07, 0.0, -0.2}, {0.07, 0.13, 0.09}), {x, 0.0, 0.0}, joint);
    return limb;
}

Limb pole() {
    Limb limb;
    limb.add(make_bar({0.38, 0.06, -0.12}, {0.38, 2.12, -0.12}, 0.022, 8), {}, arm_r);
    return limb;
}

// His round: from beside the gate into the middle, about-turn, back, about-turn; eight double steps each way. At the
// gate neither "main" nor "low" sees him or his shadows: measurements of the scene at time 0 are without him.
const glm::dvec3 kFrom_m(8.6, 0.0, 9.0), kTo_m(2.6, 0.0, 3.0);
constexpr double kHeading_rad = 0.25 * glm::pi<double>();
constexpr double kWalk_s = 10.24, kTurn_s = 1.76, kStep_s = 0.64;
constexpr double kFade_s = 0.4;  // fades the stride at both ends of a walk, so that he stands straight
constexpr double kKeyEvery_s = 0.16;

constexpr double kHalf_s = kWalk_s + kTurn_s;

/// Returns how far into his walk he is; 0 while he turns.
double walked_s(double time_s) {
    const double half_s = std::fmod(time_s, kHalf_s);
    return half_s < kWalk_s ? half_s : 0.0;
}
double stride(double time_s) {
    const double walked = walked_s(time_s);
    return std::clamp(std::min(walked, kWalk_s - walked) / kFade_s, 0.0, 1.0);
}
double phase(double time_s) { return glm::pi<double>() * walked_s(time_s) / kStep_s; }

const glm::dvec3 kAcross(1.0, 0.0, 0.0), kUp(0.0, 1.0, 0.0);

/// Returns the turn of a joint, other than the hips, at a time. A positive turn about kAcross takes a limb forward.
glm::dquat turn_of(Joint joint, double time_s) {
    const double swing = std::sin(phase(time_s)), lift = std::cos(phase(time_s)), size = stride(time_s);
    constexpr double kLeg_rad = 0.3, kKnee_rad = 0.8, kArm_rad = 0.35, kSpearArm_rad = 0.06, kChest_rad = 0.12;
    const auto bent = [](double rad) { return glm::angleAxis(rad, kAcross); };
    switch (joint) {
        case leg_l:
            return bent(size * kLeg_rad * swing);
        case leg_r:
            return bent(-size * kLeg_rad * swing);
        case shin_l:
            return bent(-size * kKnee_rad * std::max(lift, 0.0));
        case shin_r:
            return bent(-size * kKnee_rad * std::max(-lift, 0.0));
        case arm_l:
            return bent(-size * kArm_rad * swing);
        case arm_r:
            return bent(size * kSpearArm_rad * swing);
        case chest:
            return glm::angleAxis(size * kChest_rad * swing, kUp);
        default:
            return {1.0, 0.0, 0.0, 0.0};
    }
}

void append(std::vector<float>& numbers, const glm::dquat& q) {
    for (const double v : {q.x, q.y, q.z, q.w}) numbers.push_back(static_cast<float>(v));
}

ChannelSpec walk(const Kit& kit, std::uint32_t root) {
    const std::array<float, 5> times{0.0f, static_cast<float>(kWalk_s), static_cast<float>(kHalf_s),
                                     static_cast<float>(kHalf_s + kWalk_s), static_cast<float>(2.0 * kHalf_s)};
    ChannelSpec channel{.node = root, .path = "translation", .times = kit.glb.add_times(times)};
    for (const glm::dvec3& at : {kFrom_m, kTo_m, kTo_m, kFrom_m, kFrom_m})
        for (int i = 0; i < 3; ++i) channel.values.push_back(static_cast<float>(at[i]));
    return channel;
}

ChannelSpec about_turns(const Kit& kit, std::uint32_t root) {
    std::vector<float> times;
    ChannelSpec channel{.node = root, .path = "rotation"};
    const auto key = [&](double time_s, double quarters) {
        times.push_back(static_cast<float>(time_s));
        append(channel.values, glm::angleAxis(kHeading_rad + 0.5 * glm::pi<double>() * quarters, kUp));
    };
    for (const double half : {0.0, 1.0}) {
        key(half * kHalf_s, 2.0 * half);
        key(half * kHalf_s + kWalk_s, 2.0 * half);
        key(half * kHalf_s + kWalk_s + 0.5 * kTurn_s, 2.0 * half + 1.0);
    }
    key(2.0 * kHalf_s, 4.0);
    channel.times = kit.glb.add_times(times);
    return channel;
}

void add_patrol(const Kit& kit, std::uint32_t root, const std::array<std::uint32_t, kJoints>& nodes) {
    std::vector<ChannelSpec> channels{walk(kit, root), about_turns(kit, root)};
    std::vector<float> times;
    const int keys = static_cast<int>(std::lround(2.0 * kHalf_s / kKeyEvery_s));
    for (int k = 0; k <= keys; ++k) times.push_back(static_cast<float>(k * kKeyEvery_s));
    const std::uint32_t key_times = kit.glb.add_times(times);
    for (const Joint joint : {chest, arm_l, arm_r, leg_l, leg_r, shin_l, shin_r}) {
        ChannelSpec& channel =
            channels.emplace_back(ChannelSpec{.node = nodes[joint], .path = "rotation", .times = key_times});
        for (int k = 0; k <= keys; ++k) append(channel.values, turn_of(joint, k * kKeyEvery_s));
    }
    kit.glb.add_animation("patrol", channels);
}

}  // namespace

void add_guard(const Kit& kit) {
    const Limb cloth = coat(), bare = face_and_hands(), metal = iron(), shaft = pole();
    const std::array<PartSpec, 4> parts{PartSpec{cloth.shape, kit.materials.red, cloth.joints},
                                        PartSpec{bare.shape, kit.materials.plaster, bare.joints},
                                        PartSpec{metal.shape, kit.materials.iron, metal.joints},
                                        PartSpec{shaft.shape, kit.materials.wood, shaft.joints}};
    const std::uint32_t body = kit.place("guard", kit.glb.add_mesh("guard", parts), {});
    const std::uint32_t root = kit.glb.add_node({.name = "guard_root", .translation_m = kFrom_m});
    std::array<std::uint32_t, kJoints> nodes{};
    std::array<JointSpec, kJoints> joints;
    for (std::size_t j = 0; j < kJoints; ++j) {
        const bool first = j == hips;
        const glm::dvec3 parent_m = first ? glm::dvec3(0.0) : kRows[kRows[j].parent].at_m;
        nodes[j] = kit.glb.add_node({.name = kRows[j].name,
                                     .parent = first ? root : nodes[kRows[j].parent],
                                     .translation_m = kRows[j].at_m - parent_m});
        joints[j] = {nodes[j], kRows[j].at_m};
    }
    kit.glb.set_skin(body, kit.glb.add_skin("guard", joints));
    add_patrol(kit, root, nodes);
}

}  // namespace gnomon::game
