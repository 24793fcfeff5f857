#include "engine/assets/gltf_document.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "engine/assets/gltf_accessor.h"
#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_limits.h"
#include "engine/assets/gltf_shape.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 8> kKnownExtensions = {
    "EXT_lights_area",     "KHR_lights_punctual",  "KHR_materials_emissive_strength", "KHR_materials_transmission",
    "KHR_materials_unlit", "KHR_materials_volume", "KHR_mesh_quantization",           "KHR_texture_transform"};

/// Members that tinygltf parses. Hiding all others keeps its parser away from them.
constexpr std::array<const char*, 10> kParsedMembers = {"asset",   "accessors", "bufferViews", "meshes",
                                                        "nodes",   "materials", "textures",    "samplers",
                                                        "cameras", "extensions"};

json parsed_json(std::string_view text) {
    check_json_text(text);
    try {
        return json::parse(text);
    } catch (const json::parse_error& error) {
        fail("json.syntax", "", printable(error.what()));
    } catch (const json::out_of_range& error) {
        fail("json.number_range", "", printable(error.what()));
    }
}

void check_version_and_extensions(Document& document) {
    const json& asset = document.json["asset"];
    const auto version = asset["version"].get<std::string>();
    if (!version.starts_with("2."))
        fail("asset.version", "/asset/version", "glTF " + printable(version) + " is not 2.x");
    const auto minimum = asset.find("minVersion");
    if (minimum != asset.end() && *minimum != "2.0") {
        fail("asset.min_version", "/asset/minVersion", "asks for more than glTF 2.0");
    }
    const auto is_known = [](const std::string& name) {
        return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) != kKnownExtensions.end();
    };
    const json required = document.json.value("extensionsRequired", json::array());
    for (std::size_t i = 0; i < required.size(); ++i) {
        const auto name = required[i].get<std::string>();
        if (!is_known(name)) {
            fail("extension.unsupported", pointer("extensionsRequired", i), "the file requires " + printable(name));
        }
    }
    for (const json& used : document.json.value("extensionsUsed", json::array())) {
        const auto name = used.get<std::string>();
        if (!is_known(name)) document.warn("extension " + printable(name) + " is ignored");
    }
}

void load_buffers(Document& document, const Framing& framing) {
    const json buffers = std::exchange(document.json["buffers"], nullptr);
    std::size_t external_bytes = 0;
    Notes notes;
    document.buffers.resize(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        BufferData& data = document.buffers[i];
        const auto length = buffers[i]["byteLength"].get<std::size_t>();
        const auto uri = buffers[i].find("uri");
        const std::string where = pointer("buffers", i, "uri");
        if (uri == buffers[i].end()) {
            if (i != 0 || !framing.has_binary) continue;
            data.bytes = framing.binary;
        } else {
            const auto& text = uri->get_ref<const std::string&>();
            data.storage = is_data_uri(text)
                               ? decode_data_uri(text, where)
                               : read_file(resolve_uri(text, document.folder, where, notes), kMaxFileBytes, where);
            data.bytes = data.storage;
            for (std::string& note : notes) document.warn(std::move(note));
            notes.clear();
            external_bytes += data.storage.size();
            if (external_bytes > kMaxExternalBytes)
                fail("buffer.total_bytes", where, "all buffers together are too large");
        }
        data.available = true;
        if (length > data.bytes.size()) {
            fail("buffer.too_short", pointer("buffers", i, "byteLength"),
                 std::to_string(length) + " bytes are promised, " + std::to_string(data.bytes.size()) + " exist");
        }
        data.bytes = data.bytes.first(length);
    }
}

tinygltf::Model parsed_model(const json& document) {
    json shown = json::object();
    for (const char* member : kParsedMembers) {
        const auto found = document.find(member);
        if (found != document.end()) shown[member] = *found;
    }
    // tinygltf rejects index accessors without a buffer view, which glTF allows (all zero). The loader reads indices
    // itself.
    if (shown.contains("meshes")) {
        for (json& mesh : shown["meshes"]) {
            for (json& primitive : mesh["primitives"]) primitive.erase("indices");
        }
    }
    // tinygltf also rejects strides that only violate the specification's wording.
    const json views = shown.value("bufferViews", json::array());
    for (std::size_t i = 0; i < views.size(); ++i) shown["bufferViews"][i].erase("byteStride");
    const std::string text = shown.dump();
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool parsed = parser.LoadASCIIFromString(&model, &error, &warning, text.c_str(),
                                                   static_cast<unsigned int>(text.size()), std::string{});
    if (!parsed) fail("gltf.parse", "", printable(error));
    for (std::size_t i = 0; i < views.size(); ++i)
        model.bufferViews[i].byteStride = views[i].value("byteStride", std::size_t{0});
    return model;
}

}  // namespace

void Document::warn(std::string line) {
    if (std::find(warnings.begin(), warnings.end(), line) != warnings.end()) return;
    if (warnings.size() < kMaxWarnings) {
        warnings.push_back(std::move(line));
    } else {
        ++suppressed_warnings;
    }
}

void Document::take(const char* rule, const std::string& pointer, const std::string& message) {
    warn(taken(rule, pointer, message));
}

bool Document::try_charge(std::size_t bytes) {
    if (bytes > kMaxDecodedBytes - decoded_bytes) return false;
    decoded_bytes += bytes;
    return true;
}

void Document::charge(std::size_t bytes, const std::string& pointer) {
    if (!try_charge(bytes)) {
        fail("total.decoded_bytes", pointer,
             "the scene needs more than " + std::to_string(kMaxDecodedBytes) + " bytes");
    }
}

bool Document::uses_extension(const std::string& name) const {
    const auto used = json.find("extensionsUsed");
    return used != json.end() && std::find(used->begin(), used->end(), name) != used->end();
}

Document parse_document(std::span<const std::byte> bytes, const std::filesystem::path& folder, bool must_be_glb) {
    const bool is_glb = has_glb_magic(bytes);
    if (must_be_glb && !is_glb) fail("glb.magic", "", "the file does not begin with \"glTF\"");
    Framing framing;
    if (is_glb) {
        framing = split_glb(bytes);
    } else {
        framing.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    Document document;
    for (std::string& note : framing.notes) document.warn(std::move(note));
    document.folder = folder;
    document.json = parsed_json(framing.json);
    Notes notes;
    check_shape(document.json, notes);
    for (std::string& note : notes) document.warn(std::move(note));
    check_version_and_extensions(document);
    load_buffers(document, framing);
    document.model = parsed_model(document.json);
    validate_ranges(document);
    return document;
}

}  // namespace gnomon::assets::gltf
