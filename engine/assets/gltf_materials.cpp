#include "engine/assets/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "engine/assets/gltf_accessor.h"
#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_image.h"
#include "engine/assets/gltf_limits.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxUvSet = std::numeric_limits<int>::max();

float finite_float(double value, const std::string& pointer) {
    const auto number = static_cast<float>(value);
    if (!std::isfinite(number)) fail("material.range", pointer, "is beyond the range of a float");
    return number;
}

float unit_float(Document& document, double value, const std::string& pointer) {
    const double clamped = std::clamp(value, 0.0, 1.0);
    if (clamped != value) document.warn(pointer + ": clamped to [0, 1]");
    return static_cast<float>(clamped);
}

/// Replaces a negative number by 0 with a warning.
double not_negative(Document& document, double value, const std::string& pointer) {
    if (value >= 0.0) return value;
    document.take("material.negative", pointer, "is negative, taken as 0");
    return 0.0;
}

/// Reads the bytes of an image. Throws Failure, which the caller turns into a warning.
Bytes image_bytes(Document& document, const json& image, const std::string& where) {
    const auto uri = image.find("uri");
    if (uri != image.end()) {
        const auto& text = uri->get_ref<const std::string&>();
        if (is_data_uri(text)) return decode_data_uri(text, where);
        Notes notes;
        const std::filesystem::path file = resolve_uri(text, document.folder, where, notes);
        for (std::string& note : notes) document.warn(std::move(note));
        return read_file(file, kMaxFileBytes, where);
    }
    const auto view = image.find("bufferView");
    if (view == image.end()) fail("image.no_source", where, "an image with neither uri nor bufferView");
    const auto bytes = view_bytes(document, view->get<int>(), where);
    return {bytes.begin(), bytes.end()};
}

TextureWrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::mirror;
    return TextureWrap::repeat;
}

class TextureLoader {
public:
    TextureLoader(Document& document, SceneData& scene) : document_(document), scene_(scene) {}

    /// Returns the index in scene.textures; kNone with a warning on failure. Decodes each glTF texture once.
    std::int32_t load(int texture) {
        const auto known = loaded_.find(texture);
        if (known != loaded_.end()) return known->second;
        const std::int32_t index = decode(texture);
        loaded_.emplace(texture, index);
        return index;
    }

private:
    std::int32_t missing(const std::string& where, const std::string& reason) {
        document_.warn(where + ": texture left out: " + printable(reason));
        return kNone;
    }

    std::int32_t decode(int index) {
        const tinygltf::Texture& source = document_.model.textures[static_cast<std::size_t>(index)];
        if (source.source < 0) return missing(pointer("textures", index), "it has no image of a known format");
        const std::string where = pointer("images", source.source);
        const json& image = document_.json["images"][static_cast<std::size_t>(source.source)];
        std::string reason;
        try {
            const Bytes bytes = image_bytes(document_, image, where);
            const ImageSize size = image_size(bytes, reason);
            if (size.width == 0) return missing(where, reason);
            if (!document_.try_charge(std::size_t{size.width} * size.height * 4)) {
                return missing(where, "the memory budget is spent");
            }
            DecodedImage decoded = decode_image(bytes, reason);
            if (decoded.rgba.empty()) return missing(where, reason);
            return append(index, image, std::move(decoded));
        } catch (const Failure& failure) {
            return missing(where, failure.error.message + " [" + failure.error.rule + "]");
        }
    }

    std::int32_t append(int index, const json& image, DecodedImage decoded) {
        const tinygltf::Texture& source = document_.model.textures[static_cast<std::size_t>(index)];
        Texture texture;
        const auto name = image.find("name");
        if (name != image.end() && name->is_string()) texture.name = name->get<std::string>();
        texture.width = decoded.width;
        texture.height = decoded.height;
        texture.rgba = std::move(decoded.rgba);
        if (source.sampler >= 0) {
            const auto& sampler = document_.model.samplers[static_cast<std::size_t>(source.sampler)];
            texture.wrap_u = wrap_of(sampler.wrapS);
            texture.wrap_v = wrap_of(sampler.wrapT);
            texture.linear_filter = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        scene_.textures.push_back(std::move(texture));
        return static_cast<std::int32_t>(scene_.textures.size()) - 1;
    }

    Document& document_;
    SceneData& scene_;
    std::map<int, std::int32_t> loaded_;
};

/// Reads the KHR_texture_transform of a texture info: uv' = translation * rotation * scale * uv.
void read_uv_transform(const json& info, const std::string& where, UvSource& source) {
    const auto extensions = info.find("extensions");
    if (extensions == info.end() || !extensions->is_object()) return;
    const auto found = extensions->find("KHR_texture_transform");
    if (found == extensions->end() || !found->is_object()) return;
    const auto pair = [&](const char* key, glm::dvec2 fallback) {
        const auto value = found->find(key);
        if (value == found->end()) return fallback;
        const bool right =
            value->is_array() && value->size() == 2 && (*value)[0].is_number() && (*value)[1].is_number();
        if (!right) fail("property.type", where, std::string{key} + " must be two numbers");
        return glm::dvec2((*value)[0].get<double>(), (*value)[1].get<double>());
    };
    const glm::dvec2 offset = pair("offset", glm::dvec2(0.0));
    const glm::dvec2 scale = pair("scale", glm::dvec2(1.0));
    const auto angle = found->find("rotation");
    const double rotation_rad = angle != found->end() && angle->is_number() ? angle->get<double>() : 0.0;
    const double c = std::cos(rotation_rad);
    const double s = std::sin(rotation_rad);
    // Columns. A positive angle rotates counter-clockwise with v pointing down, as the extension defines it.
    source.transform =
        glm::mat3x2(glm::vec2(c * scale.x, -s * scale.x), glm::vec2(s * scale.y, c * scale.y), glm::vec2(offset));
    for (int column = 0; column < 3; ++column) {
        if (!std::isfinite(source.transform[column].x) || !std::isfinite(source.transform[column].y)) {
            fail("material.range", where, "the texture transform is not finite");
        }
    }
    const auto set = found->find("texCoord");
    if (set != found->end() && set->is_number_unsigned() && set->get<std::uint64_t>() <= kMaxUvSet) {
        source.set = set->get<int>();
    }
}

AlphaMode alpha_mode_of(const tinygltf::Material& source) {
    if (source.alphaMode == "MASK") return AlphaMode::mask;
    return source.alphaMode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

glm::vec3 emissive_of(Document& document, const tinygltf::Material& source, const json& raw, const std::string& where) {
    double strength = 1.0;
    const nlohmann::json::json_pointer path("/extensions/KHR_materials_emissive_strength/emissiveStrength");
    if (raw.contains(path)) strength = raw.at(path).get<double>();
    glm::vec3 emissive{0.0f};
    for (int i = 0; i < 3; ++i) {
        const double value = not_negative(document, source.emissiveFactor[static_cast<std::size_t>(i)] * strength,
                                          where + "/emissiveFactor");
        emissive[i] = finite_float(value, where + "/emissiveFactor");
    }
    return emissive;
}

/// Returns a number of an extension, or its default.
double member_of(const json& extension, const char* name, double otherwise) {
    return extension.is_object() && extension.contains(name) ? extension.at(name).get<double>() : otherwise;
}

/// Returns the share of light that passes a surface (KHR_materials_transmission), after half of the body's thickness
/// (KHR_materials_volume). A body with a volume is closed, so that light crosses two of its surfaces. Textures of both
/// extensions are left out, with a warning.
glm::vec3 transmission_of(Document& document, const json& raw, const std::string& where) {
    const nlohmann::json::json_pointer transmission_path("/extensions/KHR_materials_transmission");
    const nlohmann::json::json_pointer volume_path("/extensions/KHR_materials_volume");
    if (!raw.contains(transmission_path)) return glm::vec3(0.0f);
    const json& transmission = raw.at(transmission_path);
    const json volume = raw.contains(volume_path) ? raw.at(volume_path) : json::object();
    if (transmission.contains("transmissionTexture") || volume.contains("thicknessTexture"))
        document.warn(where + ": textures of transmission and thickness are left out of its shadow");
    const std::string in = where + "/extensions/KHR_materials_";
    const float factor = unit_float(document, member_of(transmission, "transmissionFactor", 0.0),
                                    in + "transmission/transmissionFactor");
    const double thickness_m =
        not_negative(document, member_of(volume, "thicknessFactor", 0.0), in + "volume/thicknessFactor");
    const double distance_m = member_of(volume, "attenuationDistance", std::numeric_limits<double>::infinity());
    glm::vec3 passed(factor);
    if (!(thickness_m > 0.0) || !(distance_m > 0.0) || !volume.contains("attenuationColor")) return passed;
    for (int i = 0; i < 3; ++i) {
        const float colour =
            unit_float(document, volume.at("attenuationColor").at(static_cast<std::size_t>(i)).get<double>(),
                       in + "volume/attenuationColor");
        passed[i] *= static_cast<float>(std::pow(static_cast<double>(colour), 0.5 * thickness_m / distance_m));
    }
    return passed;
}

Material load_material(Document& document, std::size_t index, TextureLoader& textures, UvSource& uv) {
    const tinygltf::Material& source = document.model.materials[index];
    const json& raw = document.json["materials"][index];
    const std::string where = pointer("materials", index);
    const auto& pbr = source.pbrMetallicRoughness;
    const std::string pbr_where = where + "/pbrMetallicRoughness";
    Material material;
    material.name = source.name;
    material.double_sided = source.doubleSided;
    material.alpha_mode = alpha_mode_of(source);
    material.alpha_cutoff =
        finite_float(not_negative(document, source.alphaCutoff, where + "/alphaCutoff"), where + "/alphaCutoff");
    material.metallic = unit_float(document, pbr.metallicFactor, pbr_where + "/metallicFactor");
    material.roughness = unit_float(document, pbr.roughnessFactor, pbr_where + "/roughnessFactor");
    for (int i = 0; i < 4; ++i) {
        material.base_colour[i] =
            unit_float(document, pbr.baseColorFactor[static_cast<std::size_t>(i)], pbr_where + "/baseColorFactor");
    }
    material.emissive = emissive_of(document, source, raw, where);
    material.transmission = transmission_of(document, raw, where);
    material.unlit = raw.contains(nlohmann::json::json_pointer("/extensions/KHR_materials_unlit"));
    if (pbr.baseColorTexture.index < 0) return material;

    uv.set = pbr.baseColorTexture.texCoord;
    uv.wanted = true;
    read_uv_transform(raw["pbrMetallicRoughness"]["baseColorTexture"], pbr_where + "/baseColorTexture", uv);
    material.base_colour_texture = textures.load(pbr.baseColorTexture.index);
    if (material.base_colour_texture == kNone && material.alpha_mode == AlphaMode::mask) {
        material.alpha_mode = AlphaMode::opaque;
        document.warn(where + ": its alpha mask is missing, so it is opaque");
    }
    return material;
}

}  // namespace

std::vector<UvSource> load_materials(Document& document, SceneData& scene) {
    TextureLoader textures(document, scene);
    std::vector<UvSource> uv_sources(document.model.materials.size());
    for (std::size_t i = 0; i < uv_sources.size(); ++i) {
        scene.materials.push_back(load_material(document, i, textures, uv_sources[i]));
    }
    if (scene.materials.empty()) scene.materials.emplace_back();
    return uv_sources;
}

void warn_of_blended_casters(Document& document, const SceneData& scene) {
    std::set<std::uint32_t> blended;
    for (const Node& node : scene.nodes) {
        if (node.mesh == kNone || !node.casts_shadow) continue;
        for (const Submesh& submesh : scene.meshes[static_cast<std::size_t>(node.mesh)].submeshes)
            if (scene.materials[submesh.material].alpha_mode == AlphaMode::blend) blended.insert(submesh.material);
    }
    if (blended.empty()) return;
    constexpr std::size_t kNamed = 4;
    std::string names;
    std::size_t count = 0;
    for (const std::uint32_t material : blended) {
        if (count++ == kNamed) break;
        const std::string& name = scene.materials[material].name;
        names += (names.empty() ? "" : ", ") + pointer("materials", material);
        if (!name.empty()) names += " '" + printable(name) + "'";
    }
    if (blended.size() > kNamed) names += " and " + std::to_string(blended.size() - kNamed) + " more";
    document.take("material.blend", names, "what is blended darkens by its alpha, the rest of the light passes");
}

}  // namespace gnomon::assets::gltf
