#pragma once
#include <functional>
#include <limits>
#include <ostream>

#include "tests/unit/assets/gltf_builder.h"

/// Makers of crafted bad files: each spoils the good triangle in one way.
namespace gnomon::test {

struct BadInput {
    const char* name;
    const char* rule;
    const char* pointer;
    std::function<Bytes()> make;
    const char* file = "bad.gltf";
};

/// Returns at least one input for every rule that bytes alone can break. Rules about files on disk are in
/// bad_uri_test.cpp.
std::vector<BadInput> all_bad_inputs();
std::vector<BadInput> skin_and_animation_inputs();  // some of these, in bad_skin_input.cpp

inline void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

/// The good triangle after `change` has spoilt its document.
inline std::function<Bytes()> spoilt(std::function<void(json&)> change) {
    return [change] {
        GltfBuilder builder = triangle();
        change(builder.doc);
        return builder.gltf();
    };
}

inline std::function<Bytes()> text(std::string content) {
    return [content] { return bytes_of(content); };
}

inline std::function<Bytes()> spoilt_glb(std::function<void(Bytes&)> change) {
    return [change] {
        Bytes bytes = triangle().glb();
        change(bytes);
        return bytes;
    };
}

/// The triangle with other positions.
inline std::function<Bytes()> positions(std::vector<float> numbers) {
    return [numbers] {
        GltfBuilder builder = triangle();
        builder.doc["accessors"][0]["bufferView"] = builder.add_view(numbers.data(), numbers.size() * sizeof(float));
        return builder.gltf();
    };
}

template <class T>
inline std::function<Bytes()> indices(std::vector<T> numbers) {
    return [numbers] {
        GltfBuilder builder = triangle();
        builder.doc["meshes"][0]["primitives"][0]["indices"] = builder.add_accessor<T>(numbers, "SCALAR");
        return builder.gltf();
    };
}

/// A sparse accessor of one element; `change` spoils accessors/0.
inline std::function<Bytes()> sparse(std::vector<std::uint8_t> which, std::function<void(json&)> change) {
    return [which, change] {
        GltfBuilder builder = triangle();
        const std::vector<float> values(3 * which.size(), 1.0F);
        const int index_view = builder.add_view(which.data(), which.size());
        const int value_view = builder.add_view(values.data(), values.size() * sizeof(float));
        json& accessor = builder.doc["accessors"][0];
        accessor["sparse"] = {{"count", which.size()},
                              {"indices", {{"bufferView", index_view}, {"componentType", kUByte}}},
                              {"values", {{"bufferView", value_view}}}};
        change(accessor);
        return builder.gltf();
    };
}

inline std::function<Bytes()> light(json properties) {
    return spoilt(
        [properties](json& doc) { doc["extensions"]["KHR_lights_punctual"]["lights"] = json::array({properties}); });
}

inline std::function<Bytes()> camera(json properties) {
    return spoilt([properties](json& doc) { doc["cameras"] = json::array({properties}); });
}

inline std::function<Bytes()> nodes(json list) {
    return spoilt([list](json& doc) { doc["nodes"] = list; });
}

inline json perspective(double yfov, double znear, double zfar) {
    return {{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", znear}, {"zfar", zfar}}}};
}

inline json orthographic(double ymag, double znear, double zfar) {
    return {{"type", "orthographic"},
            {"orthographic", {{"xmag", 1}, {"ymag", ymag}, {"znear", znear}, {"zfar", zfar}}}};
}

inline json chain(std::size_t length) {
    json list = json::array();
    for (std::size_t i = 0; i < length; ++i) {
        list.push_back(i + 1 < length ? json{{"children", {i + 1}}} : json::object());
    }
    return list;
}

inline std::string repeated(const std::string& part, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += part;
    return all;
}

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr const char* kLight0 = "/extensions/KHR_lights_punctual/lights/0";
inline constexpr std::size_t kGlbJsonLength = 12;  // offset of the first chunk's length

inline std::size_t bin_chunk_at(const Bytes& glb) {
    std::uint32_t json_length = 0;
    std::memcpy(&json_length, glb.data() + kGlbJsonLength, sizeof(json_length));
    return kGlbJsonLength + 8 + json_length;
}

}  // namespace gnomon::test
