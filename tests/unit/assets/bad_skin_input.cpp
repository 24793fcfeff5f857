#include <string>
#include <vector>

#include "tests/unit/assets/bad_input.h"

namespace gnomon::test {
namespace {

/// The triangle on one joint, which `change` spoils.
std::function<Bytes()> skin(std::function<void(GltfBuilder&)> change) {
    return [change] {
        GltfBuilder builder = skinned_triangle();
        change(builder);
        return builder.gltf();
    };
}

/// One channel that moves node 0, which `change` spoils.
std::function<Bytes()> animation(std::function<void(json&)> change) {
    return [change] {
        GltfBuilder builder = skinned_triangle();
        const json target = {{"node", 0}, {"path", "scale"}};
        builder.push("animations", {{"samplers", json::array({{{"input", 0}, {"output", 0}}})},
                                    {"channels", json::array({{{"sampler", 0}, {"target", target}}})}});
        change(builder.doc["animations"][0]);
        return builder.gltf();
    };
}

}  // namespace

std::vector<BadInput> skin_and_animation_inputs() {
    const auto attribute = [](GltfBuilder& b, const char* name) -> json& {
        return b.doc["meshes"][0]["primitives"][0]["attributes"][name];
    };
    return {
        {"UnknownSkin", "reference.unresolved", "/nodes/0/skin",
         skin([](GltfBuilder& b) { b.doc["nodes"][0]["skin"] = 3; })},
        {"UnknownJoint", "reference.unresolved", "/skins/0/joints/0",
         skin([](GltfBuilder& b) { b.doc["skins"][0]["joints"] = json::array({7}); })},
        {"JointBeyondTheSkin", "skin.joint_out_of_range", "/nodes/0/skin", skin([&](GltfBuilder& b) {
             attribute(b, "JOINTS_0") = b.add_accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
         })},
        {"JointBeyondTheSkinOfAVertexWithoutTriangle", "skin.joint_out_of_range", "/nodes/0/skin",
         skin([&](GltfBuilder& b) {
             attribute(b, "POSITION") = b.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5}, "VEC3");
             attribute(b, "JOINTS_0") =
                 b.add_accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0}, "VEC4");
             attribute(b, "WEIGHTS_0") =
                 b.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
             b.doc["meshes"][0]["primitives"][0]["indices"] = b.add_accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
         })},
        {"BindMatricesOfVectors", "skin.inverse_bind_type", "/skins/0/inverseBindMatrices",
         skin([](GltfBuilder& b) { b.doc["skins"][0]["inverseBindMatrices"] = 0; })},
        {"FewerBindMatricesThanJoints", "skin.inverse_bind_count", "/skins/0/inverseBindMatrices",
         skin([](GltfBuilder& b) {
             b.doc["skins"][0]["inverseBindMatrices"] = b.add_accessor<float>(std::vector<float>(16, 1.0f), "MAT4");
             b.doc["skins"][0]["joints"] = json::array({1, 1});
         })},
        {"BindMatrixIsNotANumber", "accessor.not_finite", "/accessors/4", skin([](GltfBuilder& b) {
             b.doc["skins"][0]["inverseBindMatrices"] = b.add_accessor<float>(std::vector<float>(16, kNan), "MAT4");
         })},
        {"JointsOfFloats", "attribute.type", "/meshes/0/primitives/0/attributes/JOINTS_0",
         skin([&](GltfBuilder& b) { attribute(b, "JOINTS_0") = attribute(b, "WEIGHTS_0"); })},
        {"WeightsOfPlainIntegers", "attribute.type", "/meshes/0/primitives/0/attributes/WEIGHTS_0",
         skin([&](GltfBuilder& b) { attribute(b, "WEIGHTS_0") = attribute(b, "JOINTS_0"); })},
        {"FewerWeightsThanVertices", "attribute.count", "/meshes/0/primitives/0/attributes/WEIGHTS_0",
         skin([&](GltfBuilder& b) {
             attribute(b, "WEIGHTS_0") = b.add_accessor<float>({1, 0, 0, 0}, "VEC4");
         })},
        {"TargetOfFewerVertices", "attribute.count", "/meshes/0/primitives/0/targets/0/POSITION",
         skin([](GltfBuilder& b) {
             const int target = b.add_accessor<float>({1, 0, 0}, "VEC3");
             b.doc["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", target}}});
         })},
        {"MorphWeightBeyondFloat", "node.not_finite", "/nodes/0", skin([](GltfBuilder& b) {
             b.doc["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", 0}}});
             b.doc["meshes"][0]["weights"] = json::array({1e300});
         })},
        {"UnknownSampler", "reference.unresolved", "/animations/0/channels/0/sampler",
         animation([](json& a) { a["channels"][0]["sampler"] = 1; })},
        {"UnknownKeys", "reference.unresolved", "/animations/0/samplers/0/input",
         animation([](json& a) { a["samplers"][0]["input"] = 99; })},
        {"UnknownInterpolation", "property.choice", "/animations/0/samplers/0/interpolation",
         animation([](json& a) { a["samplers"][0]["interpolation"] = "BOUNCE"; })},
        {"UnknownAnimatedNode", "reference.unresolved", "/animations/0/channels/0/target/node",
         animation([](json& a) { a["channels"][0]["target"]["node"] = 5; })},
    };
}

}  // namespace gnomon::test
