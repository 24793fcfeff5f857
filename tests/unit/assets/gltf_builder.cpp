#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : kAlphabet[bits >> (18 - 6 * k) & 63U];
        }
    }
    return text;
}

constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBin = 0x004E4942;

void append_u32(Bytes& bytes, std::uint32_t value) {
    bytes.resize(bytes.size() + 4);
    put_u32(bytes, bytes.size() - 4, value);
}

}  // namespace

std::size_t GltfBuilder::components_of(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    return type == "MAT4" ? 16 : type == "MAT3" ? 9 : 4;
}

int GltfBuilder::push(const char* collection, const json& value) {
    doc[collection].push_back(value);
    return static_cast<int>(doc[collection].size()) - 1;
}

int GltfBuilder::add_view(const void* data, std::size_t size, std::size_t stride) {
    binary.resize((binary.size() + 3) / 4 * 4);
    json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}};
    if (stride != 0) view["byteStride"] = stride;
    const auto* begin = static_cast<const std::byte*>(data);
    binary.insert(binary.end(), begin, begin + size);
    return push("bufferViews", view);
}

int GltfBuilder::add_mesh(const json& primitive) {
    const int mesh = push("meshes", {{"primitives", json::array({primitive})}});
    push("nodes", {{"mesh", mesh}});
    return mesh;
}

Bytes GltfBuilder::gltf() const {
    json whole = doc;
    if (!binary.empty() && !whole.contains("buffers")) {
        whole["buffers"] = json::array(
            {{{"byteLength", binary.size()}, {"uri", "data:application/octet-stream;base64," + base64(binary)}}});
    }
    return bytes_of(whole.dump());
}

Bytes GltfBuilder::glb() const {
    json whole = doc;
    if (!whole.contains("buffers")) whole["buffers"] = json::array({{{"byteLength", binary.size()}}});
    return glb_of(whole.dump(), binary);
}

GltfBuilder triangle() {
    GltfBuilder builder;
    const int position = builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int indices = builder.add_accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
    builder.add_mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
    return builder;
}

GltfBuilder skinned_triangle() {
    GltfBuilder builder = triangle();
    json& attributes = builder.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.add_accessor<std::uint8_t>(std::vector<std::uint8_t>(12, 0), "VEC4");
    attributes["WEIGHTS_0"] = builder.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    builder.doc["nodes"][0]["skin"] = 0;
    builder.push("nodes", {{"name", "joint"}});
    builder.push("skins", {{"joints", json::array({1})}});
    return builder;
}

Bytes bytes_of(std::string_view text) {
    Bytes bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

void put_u32(Bytes& bytes, std::size_t offset, std::uint32_t value) {
    std::memcpy(bytes.data() + offset, &value, sizeof(value));
}

Bytes glb_of(std::string_view json_text, std::span<const std::byte> binary) {
    std::string padded{json_text};
    while (padded.size() % 4 != 0) padded += ' ';
    Bytes bytes;
    append_u32(bytes, kMagic);
    append_u32(bytes, 2);
    append_u32(bytes, 0);
    append_u32(bytes, static_cast<std::uint32_t>(padded.size()));
    append_u32(bytes, kJson);
    const Bytes text = bytes_of(padded);
    bytes.insert(bytes.end(), text.begin(), text.end());
    if (!binary.empty()) {
        append_u32(bytes, static_cast<std::uint32_t>((binary.size() + 3) / 4 * 4));
        append_u32(bytes, kBin);
        bytes.insert(bytes.end(), binary.begin(), binary.end());
        bytes.resize((bytes.size() + 3) / 4 * 4);
    }
    put_u32(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
    return bytes;
}

}  // namespace gnomon::test
