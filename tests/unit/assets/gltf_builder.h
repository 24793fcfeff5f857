#pragma once
#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/assets.h"

namespace gnomon::test {

using nlohmann::json;
using Bytes = std::vector<std::byte>;

// Component types of glTF.
inline constexpr int kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126;

template <class T>
constexpr int component_of() {
    if constexpr (std::is_same_v<T, std::int8_t>) return kByte;
    if constexpr (std::is_same_v<T, std::uint8_t>) return kUByte;
    if constexpr (std::is_same_v<T, std::int16_t>) return kShort;
    if constexpr (std::is_same_v<T, std::uint16_t>) return kUShort;
    if constexpr (std::is_same_v<T, std::uint32_t>) return kUInt;
    return kFloat;
}

/// A glTF file under construction. `doc` may be edited at will; the binary part goes into buffer 0.
struct GltfBuilder {
    json doc = {{"asset", {{"version", "2.0"}}}};
    Bytes binary;

    /// Appends bytes as a bufferView, aligned to 4; returns its index.
    int add_view(const void* data, std::size_t size, std::size_t stride = 0);

    template <class T>
    int add_accessor(const std::vector<T>& numbers, const char* type, bool normalized = false) {
        const int view = add_view(numbers.data(), numbers.size() * sizeof(T));
        json accessor = {{"bufferView", view},
                         {"componentType", component_of<T>()},
                         {"count", numbers.size() / components_of(type)},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        return push("accessors", accessor);
    }

    /// Appends to a top-level array; returns the index.
    int push(const char* collection, const json& value);
    /// Adds a mesh of one primitive, with a node that shows it; returns the mesh's index.
    int add_mesh(const json& primitive);

    /// Returns the file as JSON with a data URI, or as GLB.
    Bytes gltf() const;
    Bytes glb() const;

    static std::size_t components_of(std::string_view type);
};

/// Makes one triangle (0 0 0), (1 0 0), (0 1 0) with 16-bit indices, in mesh 0 on node 0.
GltfBuilder triangle();

/// Makes the triangle on a skin of one joint, node 1, without bind matrices. Accessors 2 and 3 are joints and weights.
GltfBuilder skinned_triangle();

Bytes bytes_of(std::string_view text);
/// Makes a GLB from chunks as they are; lengths are the chunks' own.
Bytes glb_of(std::string_view json_text, std::span<const std::byte> binary);
void put_u32(Bytes& bytes, std::size_t offset, std::uint32_t value);

inline Result<assets::SceneData> load(const Bytes& bytes, const std::string& name = "test.gltf") {
    return assets::load_gltf_memory(bytes, {}, name);
}

}  // namespace gnomon::test
