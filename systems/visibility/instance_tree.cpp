#include "systems/visibility/instance_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <queue>
#include <utility>

#include "engine/math/projection.h"

namespace gnomon::visibility {
namespace {

constexpr double kUnitRoundoff = 0x1p-24;
/// Rounding of a ray in mesh space: that of kBoxUnits in shaders/ray_tracing/ray_box.glsl, plus the inverse's own.
constexpr double kBoxUnits = 48.0;
/// Rounding of a corner as shaders place it: its basis, three products, three sums.
constexpr double kCornerUnits = 8.0;
/// Slack for a basis without inverse, so that every box is hit. Farther than any coordinate; its square is finite.
constexpr float kEverywhere = 1.0e18f;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Computes the largest absolute row sum: bounds an image's coordinates per unit of the vector's largest coordinate.
double norm(const glm::dmat3& m) { return largest(glm::abs(m[0]) + glm::abs(m[1]) + glm::abs(m[2])); }

bool is_finite(const glm::dmat3& m) { return std::isfinite(norm(m)); }

RayInstance record_of(const InstanceItem& item, const MeshTreePlace& mesh) {
    RayInstance record;
    record.first_node = mesh.first_node;
    record.end_node = mesh.nodes;
    record.first_slot = mesh.first_slot;
    record.instance = item.gpu_slot;
    record.layers = item.cast_layers;
    const glm::dvec3 corner = glm::max(glm::abs(glm::dvec3(mesh.box.min)), glm::abs(glm::dvec3(mesh.box.max)));
    record.reach_m = static_cast<float>(norm(item.basis) * largest(corner));
    const glm::dmat3 inverse = glm::inverse(item.basis);
    const double slack_per_m = kBoxUnits * kUnitRoundoff * norm(inverse);
    if (!is_finite(inverse) || !(slack_per_m < static_cast<double>(kEverywhere))) {
        record.slack_per_m = kEverywhere;
        return record;
    }
    record.slack_per_m = static_cast<float>(slack_per_m);
    record.to_model_x = glm::vec3(inverse[0]);
    record.to_model_y = glm::vec3(inverse[1]);
    record.to_model_z = glm::vec3(inverse[2]);
    return record;
}

/// Computes a box around the instance's corners as shaders place them, with the translation in two floats.
rays::Box box_of(const InstanceItem& item, const math::Aabb& bounds_ws, const RayInstance& record,
                 const glm::dvec3& anchor_ws_m) {
    constexpr double kTwoFloats = 0x1p-47;
    const glm::dvec3 low = bounds_ws.min - anchor_ws_m, high = bounds_ws.max - anchor_ws_m;
    const double size_m = std::max(largest(low), largest(high)) + static_cast<double>(record.reach_m);
    const glm::dvec3 slack(kCornerUnits * kUnitRoundoff * size_m + kTwoFloats * largest(item.translation_ws_m));
    return {glm::vec3(low - slack), glm::vec3(high + slack)};
}

math::Aabb bounds_of(const InstanceItem& item, const rays::BvhNode& node) {
    return math::transformed({glm::dvec3(node.min), glm::dvec3(node.max)}, item.basis, item.translation_ws_m);
}

double half_area_m2(const math::Aabb& box) {
    const glm::dvec3 size = box.max - box.min;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

void InstanceTree::update(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes, bool same) {
    if (!same) list(scene, meshes);
    place(scene, meshes);
    if (same) rays::refit_bvh(nodes_, boxes_);
    if (!same || rays::cost_of(nodes_).steps() > kLooseGrowth * built_cost_) {
        set_anchor(scene);
        place(scene, meshes);
        build();
    }
    head_.nodes = static_cast<std::uint32_t>(nodes_.size());
    head_.reach_m = 0.0f;
    if (nodes_.empty()) return;
    const glm::vec3 reach = glm::max(glm::abs(nodes_[0].min), glm::abs(nodes_[0].max));
    head_.reach_m = std::max({reach.x, reach.y, reach.z});
}

void InstanceTree::list(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes) {
    parts_.clear();
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceItem& item = scene.instances[i];
        const bool has_tree = item.mesh < meshes.size() && meshes[item.mesh].nodes > 0;
        if (item.casts && has_tree && !math::is_empty(item.bounds_ws))
            parts_.push_back({i, 0, meshes[item.mesh].nodes});
    }
    instances_ = parts_.size();
    open(scene, meshes);
}

/// Replaces large instances by the subtrees at the top of their own trees, the largest first. Boxes of large instances
/// overlap, as those of a building's materials; a ray then hits fewer of the parts. (Benthin, Woop, Wald and Afra 2017,
/// "Improved two-level BVHs using partial re-braiding".)
void InstanceTree::open(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes) {
    const std::size_t most = parts_.size() + kMostOpened;
    struct Large {
        double area_m2 = 0.0;
        std::size_t part = 0;
        bool operator<(const Large& other) const { return area_m2 < other.area_m2; }
    };
    std::priority_queue<Large> largest;
    const auto push = [&](std::size_t i) {
        const Part& part = parts_[i];
        const InstanceItem& item = scene.instances[part.item];
        const std::span<const rays::BvhNode> tree = meshes[item.mesh].tree;
        if (tree.empty() || tree[part.begin_node].leaf != 0) return;
        const double area_m2 = half_area_m2(bounds_of(item, tree[part.begin_node]));
        if (area_m2 > 0.0) largest.push({area_m2, i});  // excludes areas of 0 or NaN
    };
    for (std::size_t i = 0; i < parts_.size(); ++i) push(i);
    while (parts_.size() < most && !largest.empty()) {
        const std::size_t i = largest.top().part;
        largest.pop();
        const Part part = parts_[i];
        const std::span<const rays::BvhNode> tree = meshes[scene.instances[part.item].mesh].tree;
        const std::uint32_t one = part.begin_node + 1, other = tree[one].skip;
        parts_[i] = {part.item, one, other};
        parts_.push_back({part.item, other, part.end_node});
        push(i);
        push(parts_.size() - 1);
    }
}

/// Sets the anchor in the middle of the casters, as a sum of two floats, so that shaders have it exactly.
void InstanceTree::set_anchor(const SceneSnapshot& scene) {
    math::Aabb all;
    for (const Part& part : parts_) all = math::merged(all, scene.instances[part.item].bounds_ws);
    const math::TwoFloat3 anchor = math::split(parts_.empty() ? glm::dvec3(0.0) : math::centre(all));
    head_.anchor_high = anchor.high;
    head_.anchor_low = anchor.low;
    anchor_ws_m_ = glm::dvec3(anchor.high) + glm::dvec3(anchor.low);
}

/// Computes records and boxes, by slot.
void InstanceTree::place(const SceneSnapshot& scene, std::span<const MeshTreePlace> meshes) {
    records_.resize(parts_.size());
    boxes_.resize(parts_.size());
    for (std::size_t slot = 0; slot < parts_.size(); ++slot) {
        const Part& part = parts_[slot];
        const InstanceItem& item = scene.instances[part.item];
        const MeshTreePlace& mesh = meshes[item.mesh];
        RayInstance& record = records_[slot];
        record = record_of(item, mesh);
        if (!mesh.tree.empty()) {
            record.begin_node = part.begin_node;
            record.end_node = part.end_node;
        }
        const bool is_whole = mesh.tree.empty() || part.end_node - part.begin_node == mesh.nodes;
        const math::Aabb bounds = is_whole ? item.bounds_ws : bounds_of(item, mesh.tree[part.begin_node]);
        boxes_[slot] = box_of(item, bounds, record, anchor_ws_m_);
    }
}

void InstanceTree::build() {
    rays::Bvh bvh = rays::build_bvh(boxes_, 1);
    nodes_ = std::move(bvh.nodes);
    const auto by_slot = [&bvh](auto& values) {
        auto sorted = values;
        for (std::size_t slot = 0; slot < values.size(); ++slot) sorted[slot] = values[bvh.items[slot]];
        values = std::move(sorted);
    };
    by_slot(parts_);
    by_slot(records_);
    by_slot(boxes_);
    built_cost_ = rays::cost_of(nodes_).steps();
    ++builds_;
}

std::size_t InstanceTree::bytes() const {
    return nodes_.capacity() * sizeof(rays::BvhNode) + records_.capacity() * sizeof(RayInstance) +
           parts_.capacity() * sizeof(Part) + boxes_.capacity() * sizeof(rays::Box);
}

}  // namespace gnomon::visibility
