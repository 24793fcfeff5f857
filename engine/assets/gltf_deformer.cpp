#include "engine/assets/gltf_deformer.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <memory>
#include <utility>

#include "engine/assets/gltf_accessor.h"
#include "engine/assets/gltf_error.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {
namespace {

/// Four weights stored as bytes are each off by half of 1/255.
constexpr double kWeightSumTolerance = 2.0 / 255.0;
constexpr std::size_t kPerSet = 4;

/// Checks an accessor's type (glTF 2.0, 3.7.2.1 and KHR_mesh_quantization). `whole`: integers that are not normalised.
void expect_type(const Document& document, int accessor, int type, std::initializer_list<int> integers, bool whole,
                 const std::string& where) {
    const auto& found = document.model.accessors[static_cast<std::size_t>(accessor)];
    const bool integer = std::find(integers.begin(), integers.end(), found.componentType) != integers.end();
    const bool right = found.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT
                           ? !whole
                           : integer && (whole ? !found.normalized
                                               : found.normalized || document.uses_extension("KHR_mesh_quantization"));
    if (found.type != type || !right)
        fail("attribute.type", where, "its accessor has a type that glTF does not allow here");
}

std::vector<float> numbers_of(const Document& document, int accessor, std::size_t count, const std::string& where) {
    if (document.model.accessors[static_cast<std::size_t>(accessor)].count != count)
        fail("attribute.count", where, "holds another number of elements than POSITION");
    return read_floats(document, accessor);
}

int named(const std::map<std::string, int>& attributes, const std::string& name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? kNone : found->second;
}

}  // namespace

DeformingSource deforming_source(Document& document, const tinygltf::Primitive& primitive, const std::string& where) {
    DeformingSource source;
    for (int set = 0;; ++set) {
        const std::string number = std::to_string(set);
        const int joints = named(primitive.attributes, "JOINTS_" + number);
        const int weights = named(primitive.attributes, "WEIGHTS_" + number);
        if ((joints == kNone) != (weights == kNone))
            document.warn(where + "/attributes: JOINTS_" + number + " and WEIGHTS_" + number +
                          " do not stand together and are left out");
        if (joints == kNone || weights == kNone) break;
        source.sets.push_back({joints, weights});
    }
    for (const auto& target : primitive.targets)
        source.targets.push_back({named(target, "POSITION"), named(target, "NORMAL")});
    return source;
}

void DeformerBuilder::append(const DeformingSource& source, std::size_t count, const std::string& where) {
    append_joints(source, count, where);
    if (vertices_ > 0 && source.targets.size() != deformer_.targets.size())
        document_.warn(where + "/targets: another number than of the primitives before; those it lacks do nothing");
    if (source.targets.size() > deformer_.targets.size()) deformer_.targets.resize(source.targets.size());
    for (std::size_t t = 0; t < source.targets.size(); ++t)
        append_target(t, source.targets[t], count, where + "/targets/" + std::to_string(t));
    vertices_ += count;
}

/// Appends vertices of a primitive without joints, in a mesh that has joints elsewhere.
void DeformerBuilder::append_plain(std::size_t count) {
    for (std::size_t v = 0; v < count; ++v) {
        deformer_.first_influence.push_back(static_cast<std::uint32_t>(deformer_.influences.size()));
        deformer_.influences.push_back({0, 1.0f});
    }
}

void DeformerBuilder::append_joints(const DeformingSource& source, std::size_t count, const std::string& where) {
    if (source.sets.empty()) {
        if (skinned_) append_plain(count);
        return;
    }
    if (!skinned_) append_plain(vertices_);
    skinned_ = true;
    std::vector<std::vector<float>> joints, weights;
    for (std::size_t s = 0; s < source.sets.size(); ++s) {
        const std::string at = where + "/attributes/", number = std::to_string(s);
        const std::initializer_list<int> unsigned_integers{TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                                           TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
        expect_type(document_, source.sets[s][0], TINYGLTF_TYPE_VEC4, unsigned_integers, true, at + "JOINTS_" + number);
        expect_type(document_, source.sets[s][1], TINYGLTF_TYPE_VEC4, unsigned_integers, false,
                    at + "WEIGHTS_" + number);
        document_.charge(count * kPerSet * sizeof(Deformer::Influence), where);
        joints.push_back(numbers_of(document_, source.sets[s][0], count, at + "JOINTS_" + number));
        weights.push_back(numbers_of(document_, source.sets[s][1], count, at + "WEIGHTS_" + number));
    }
    for (std::size_t v = 0; v < count; ++v) {
        deformer_.first_influence.push_back(static_cast<std::uint32_t>(deformer_.influences.size()));
        append_vertex(joints, weights, v, where);
    }
}

void DeformerBuilder::append_vertex(const Numbers& joints, const Numbers& weights, std::size_t v,
                                    const std::string& where) {
    std::vector<Deformer::Influence>& all = deformer_.influences;
    const std::size_t first = all.size();
    double sum = 0.0;
    for (std::size_t set = 0; set < joints.size(); ++set)
        for (std::size_t i = kPerSet * v; i < kPerSet * (v + 1); ++i) {
            const float weight = weights[set][i];
            if (weight < 0.0f) document_.warn(where + ": weights below 0 count as 0");
            if (!(weight > 0.0f)) continue;
            all.push_back({static_cast<std::uint32_t>(joints[set][i]), weight});
            sum += static_cast<double>(weight);
        }
    if (!(sum > 0.0)) {
        document_.warn(where + ": vertices without any weight follow their first joint");
        all.push_back({static_cast<std::uint32_t>(joints[0][kPerSet * v]), 1.0f});
        return;
    }
    if (std::abs(sum - 1.0) > kWeightSumTolerance)
        document_.warn(where + ": weights that do not sum to 1 are scaled so that they do");
    for (std::size_t i = first; i < all.size(); ++i)
        all[i].weight = static_cast<float>(static_cast<double>(all[i].weight) / sum);
}

void DeformerBuilder::append_target(std::size_t index, const std::array<int, 2>& source, std::size_t count,
                                    const std::string& where) {
    Deformer::Target& target = deformer_.targets[index];
    const auto append_part = [&](int accessor, const char* name, std::vector<glm::vec3>& part) {
        if (accessor == kNone) return;
        expect_type(document_, accessor, TINYGLTF_TYPE_VEC3,
                    {TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_COMPONENT_TYPE_SHORT}, false, where + "/" + name);
        document_.charge(count * sizeof(glm::vec3), where);
        const std::vector<float> numbers = numbers_of(document_, accessor, count, where + "/" + name);
        fill_up(part, where);
        for (std::size_t v = 0; v < count; ++v)
            part.emplace_back(numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]);
    };
    append_part(source[0], "POSITION", target.positions);
    append_part(source[1], "NORMAL", target.normals);
}

/// Pads a part with zeros for earlier vertices, which it does not move.
void DeformerBuilder::fill_up(std::vector<glm::vec3>& part, const std::string& where) {
    document_.charge((vertices_ - part.size()) * sizeof(glm::vec3), where);
    part.resize(vertices_, glm::vec3(0.0f));
}

std::shared_ptr<const Deformer> DeformerBuilder::finish(const Mesh& mesh, const std::string& where) {
    if (!skinned_ && deformer_.targets.empty()) return nullptr;
    if (skinned_) deformer_.first_influence.push_back(static_cast<std::uint32_t>(deformer_.influences.size()));
    for (Deformer::Target& target : deformer_.targets) {
        if (!target.positions.empty()) fill_up(target.positions, where);
        if (!target.normals.empty()) fill_up(target.normals, where);
    }
    measure(deformer_, mesh);
    document_.charge(deformer_.joint_bounds_ms.size() * sizeof(math::Aabb), where);
    return std::make_shared<const Deformer>(std::move(deformer_));
}

}  // namespace gnomon::assets::gltf
