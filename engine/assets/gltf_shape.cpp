#include "engine/assets/gltf_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_limits.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

enum class Kind : std::uint8_t { object, list, text, boolean, number, integer, numbers, reference, choice };
enum class Need : std::uint8_t { optional, required };

/// Rule for one property. `path` is a JSON pointer with * for every element or member.
struct Row {
    std::string_view path;
    Kind kind;
    Need need = Need::optional;
    std::size_t size = 0;          // list: maximum length; numbers: exact length; integer: largest value
    std::string_view target = {};  // reference: the collection; choice: the words, each between bars
};

constexpr std::size_t kMaxInt = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t kMaxSize = std::size_t{1} << 53;  // exact in a double
constexpr auto kRequired = Need::required;
constexpr auto kOptional = Need::optional;

// Parents come before their members, so that the first error is the clearest.
constexpr Row kRows[] = {
    {"/asset", Kind::object, kRequired},
    {"/asset/version", Kind::text, kRequired},
    {"/extensionsUsed", Kind::list, kOptional, kMaxItems},
    {"/extensionsUsed/*", Kind::text},
    {"/extensionsRequired", Kind::list, kOptional, kMaxItems},
    {"/extensionsRequired/*", Kind::text},

    {"/buffers", Kind::list, kOptional, kMaxItems},
    {"/buffers/*", Kind::object},
    {"/buffers/*/byteLength", Kind::integer, kRequired, kMaxSize},
    {"/buffers/*/uri", Kind::text},
    {"/bufferViews", Kind::list, kOptional, kMaxItems},
    {"/bufferViews/*", Kind::object},
    {"/bufferViews/*/buffer", Kind::reference, kRequired, 0, "buffers"},
    {"/bufferViews/*/byteOffset", Kind::integer, kOptional, kMaxSize},
    {"/bufferViews/*/byteLength", Kind::integer, kRequired, kMaxSize},
    {"/bufferViews/*/byteStride", Kind::integer, kOptional, kMaxInt},
    {"/accessors", Kind::list, kOptional, kMaxItems},
    {"/accessors/*", Kind::object},
    {"/accessors/*/bufferView", Kind::reference, kOptional, 0, "bufferViews"},
    {"/accessors/*/byteOffset", Kind::integer, kOptional, kMaxSize},
    {"/accessors/*/componentType", Kind::integer, kRequired, kMaxInt},
    {"/accessors/*/count", Kind::integer, kRequired, kMaxSize},
    {"/accessors/*/type", Kind::choice, kRequired, 0, "|SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4|"},
    {"/accessors/*/normalized", Kind::boolean},
    {"/accessors/*/sparse", Kind::object},
    {"/accessors/*/sparse/count", Kind::integer, kRequired, kMaxInt},
    {"/accessors/*/sparse/indices", Kind::object, kRequired},
    {"/accessors/*/sparse/indices/bufferView", Kind::reference, kRequired, 0, "bufferViews"},
    {"/accessors/*/sparse/indices/byteOffset", Kind::integer, kOptional, kMaxInt},
    {"/accessors/*/sparse/indices/componentType", Kind::integer, kRequired, kMaxInt},
    {"/accessors/*/sparse/values", Kind::object, kRequired},
    {"/accessors/*/sparse/values/bufferView", Kind::reference, kRequired, 0, "bufferViews"},
    {"/accessors/*/sparse/values/byteOffset", Kind::integer, kOptional, kMaxInt},

    {"/images", Kind::list, kOptional, kMaxItems},
    {"/images/*", Kind::object},
    {"/images/*/uri", Kind::text},
    {"/images/*/bufferView", Kind::reference, kOptional, 0, "bufferViews"},
    {"/samplers", Kind::list, kOptional, kMaxItems},
    {"/samplers/*", Kind::object},
    {"/samplers/*/magFilter", Kind::integer, kOptional, kMaxInt},
    {"/samplers/*/wrapS", Kind::integer, kOptional, kMaxInt},
    {"/samplers/*/wrapT", Kind::integer, kOptional, kMaxInt},
    {"/textures", Kind::list, kOptional, kMaxItems},
    {"/textures/*", Kind::object},
    {"/textures/*/source", Kind::reference, kOptional, 0, "images"},
    {"/textures/*/sampler", Kind::reference, kOptional, 0, "samplers"},
    {"/materials", Kind::list, kOptional, kMaxItems},
    {"/materials/*", Kind::object},
    {"/materials/*/name", Kind::text},
    {"/materials/*/alphaMode", Kind::choice, kOptional, 0, "|OPAQUE|MASK|BLEND|"},
    {"/materials/*/alphaCutoff", Kind::number},
    {"/materials/*/doubleSided", Kind::boolean},
    {"/materials/*/emissiveFactor", Kind::numbers, kOptional, 3},
    {"/materials/*/pbrMetallicRoughness", Kind::object},
    {"/materials/*/pbrMetallicRoughness/baseColorFactor", Kind::numbers, kOptional, 4},
    {"/materials/*/pbrMetallicRoughness/metallicFactor", Kind::number},
    {"/materials/*/pbrMetallicRoughness/roughnessFactor", Kind::number},
    {"/materials/*/pbrMetallicRoughness/baseColorTexture", Kind::object},
    {"/materials/*/pbrMetallicRoughness/baseColorTexture/index", Kind::reference, kRequired, 0, "textures"},
    {"/materials/*/pbrMetallicRoughness/baseColorTexture/texCoord", Kind::integer, kOptional, kMaxInt},
    {"/materials/*/extensions", Kind::object},
    {"/materials/*/extensions/KHR_materials_emissive_strength", Kind::object},
    {"/materials/*/extensions/KHR_materials_emissive_strength/emissiveStrength", Kind::number},
    {"/materials/*/extensions/KHR_materials_unlit", Kind::object},
    {"/materials/*/extensions/KHR_materials_transmission", Kind::object},
    {"/materials/*/extensions/KHR_materials_transmission/transmissionFactor", Kind::number},
    {"/materials/*/extensions/KHR_materials_volume", Kind::object},
    {"/materials/*/extensions/KHR_materials_volume/thicknessFactor", Kind::number},
    {"/materials/*/extensions/KHR_materials_volume/attenuationDistance", Kind::number},
    {"/materials/*/extensions/KHR_materials_volume/attenuationColor", Kind::numbers, kOptional, 3},

    {"/meshes", Kind::list, kOptional, kMaxItems},
    {"/meshes/*", Kind::object},
    {"/meshes/*/name", Kind::text},
    {"/meshes/*/primitives", Kind::list, kRequired, kMaxItems},
    {"/meshes/*/primitives/*", Kind::object},
    {"/meshes/*/primitives/*/attributes", Kind::object, kRequired},
    {"/meshes/*/primitives/*/attributes/*", Kind::reference, kOptional, 0, "accessors"},
    {"/meshes/*/primitives/*/indices", Kind::reference, kOptional, 0, "accessors"},
    {"/meshes/*/primitives/*/material", Kind::reference, kOptional, 0, "materials"},
    {"/meshes/*/primitives/*/mode", Kind::integer, kOptional, kMaxInt},
    {"/meshes/*/primitives/*/targets", Kind::list, kOptional, kMaxTargets},
    {"/meshes/*/primitives/*/targets/*", Kind::object},
    {"/meshes/*/primitives/*/targets/*/*", Kind::reference, kOptional, 0, "accessors"},
    {"/meshes/*/weights", Kind::list, kOptional, kMaxTargets},
    {"/meshes/*/weights/*", Kind::number},

    {"/cameras", Kind::list, kOptional, kMaxItems},
    {"/cameras/*", Kind::object},
    {"/cameras/*/type", Kind::choice, kRequired, 0, "|perspective|orthographic|"},
    {"/cameras/*/perspective", Kind::object},
    {"/cameras/*/perspective/yfov", Kind::number, kRequired},
    {"/cameras/*/perspective/znear", Kind::number, kRequired},
    {"/cameras/*/perspective/zfar", Kind::number},
    {"/cameras/*/perspective/aspectRatio", Kind::number},
    {"/cameras/*/orthographic", Kind::object},
    {"/cameras/*/orthographic/xmag", Kind::number, kRequired},
    {"/cameras/*/orthographic/ymag", Kind::number, kRequired},
    {"/cameras/*/orthographic/zfar", Kind::number, kRequired},
    {"/cameras/*/orthographic/znear", Kind::number, kRequired},

    {"/extensions", Kind::object},
    {"/extensions/KHR_lights_punctual", Kind::object},
    {"/extensions/KHR_lights_punctual/lights", Kind::list, kRequired, kMaxItems},
    {"/extensions/KHR_lights_punctual/lights/*", Kind::object},
    {"/extensions/KHR_lights_punctual/lights/*/type", Kind::choice, kRequired, 0, "|directional|point|spot|"},
    {"/extensions/KHR_lights_punctual/lights/*/color", Kind::numbers, kOptional, 3},
    {"/extensions/KHR_lights_punctual/lights/*/intensity", Kind::number},
    {"/extensions/KHR_lights_punctual/lights/*/range", Kind::number},
    {"/extensions/KHR_lights_punctual/lights/*/spot", Kind::object},
    {"/extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", Kind::number},
    {"/extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", Kind::number},

    {"/extensions/EXT_lights_area", Kind::object},
    {"/extensions/EXT_lights_area/lights", Kind::list, kRequired, kMaxItems},
    {"/extensions/EXT_lights_area/lights/*", Kind::object},
    {"/extensions/EXT_lights_area/lights/*/name", Kind::text},
    {"/extensions/EXT_lights_area/lights/*/type", Kind::choice, kRequired, 0, "|rect|disk|sphere|tube|"},
    {"/extensions/EXT_lights_area/lights/*/color", Kind::numbers, kOptional, 3},
    {"/extensions/EXT_lights_area/lights/*/intensity", Kind::number},
    {"/extensions/EXT_lights_area/lights/*/size", Kind::number},
    {"/extensions/EXT_lights_area/lights/*/rect", Kind::object},
    {"/extensions/EXT_lights_area/lights/*/rect/aspect", Kind::number},
    {"/extensions/EXT_lights_area/lights/*/tube", Kind::object},
    {"/extensions/EXT_lights_area/lights/*/tube/radius", Kind::number},

    {"/nodes", Kind::list, kOptional, kMaxNodes},
    {"/nodes/*", Kind::object},
    {"/nodes/*/name", Kind::text},
    {"/nodes/*/mesh", Kind::reference, kOptional, 0, "meshes"},
    {"/nodes/*/camera", Kind::reference, kOptional, 0, "cameras"},
    {"/nodes/*/translation", Kind::numbers, kOptional, 3},
    {"/nodes/*/rotation", Kind::numbers, kOptional, 4},
    {"/nodes/*/scale", Kind::numbers, kOptional, 3},
    {"/nodes/*/matrix", Kind::numbers, kOptional, 16},
    {"/nodes/*/skin", Kind::reference, kOptional, 0, "skins"},
    {"/nodes/*/weights", Kind::list, kOptional, kMaxTargets},
    {"/nodes/*/weights/*", Kind::number},
    {"/nodes/*/children", Kind::list, kOptional, kMaxNodes},
    {"/nodes/*/children/*", Kind::reference, kOptional, 0, "nodes"},
    {"/nodes/*/extensions", Kind::object},
    {"/nodes/*/extensions/KHR_lights_punctual", Kind::object},
    {"/nodes/*/extensions/KHR_lights_punctual/light", Kind::reference, kRequired, 0,
     "/extensions/KHR_lights_punctual/lights"},
    {"/nodes/*/extensions/EXT_lights_area", Kind::object},
    {"/nodes/*/extensions/EXT_lights_area/light", Kind::reference, kRequired, 0, "/extensions/EXT_lights_area/lights"},
    {"/skins", Kind::list, kOptional, kMaxItems},
    {"/skins/*", Kind::object},
    {"/skins/*/joints", Kind::list, kRequired, kMaxNodes},
    {"/skins/*/joints/*", Kind::reference, kOptional, 0, "nodes"},
    {"/skins/*/inverseBindMatrices", Kind::reference, kOptional, 0, "accessors"},
    {"/animations", Kind::list, kOptional, kMaxItems},
    {"/animations/*", Kind::object},
    {"/animations/*/name", Kind::text},
    {"/animations/*/samplers", Kind::list, kRequired, kMaxItems},
    {"/animations/*/samplers/*", Kind::object},
    {"/animations/*/samplers/*/input", Kind::reference, kRequired, 0, "accessors"},
    {"/animations/*/samplers/*/output", Kind::reference, kRequired, 0, "accessors"},
    {"/animations/*/samplers/*/interpolation", Kind::choice, kOptional, 0, "|LINEAR|STEP|CUBICSPLINE|"},
    {"/animations/*/channels", Kind::list, kRequired, kMaxItems},
    {"/animations/*/channels/*", Kind::object},
    {"/animations/*/channels/*/sampler", Kind::integer, kRequired, kMaxItems},
    {"/animations/*/channels/*/target", Kind::object, kRequired},
    {"/animations/*/channels/*/target/node", Kind::reference, kOptional, 0, "nodes"},
    {"/animations/*/channels/*/target/path", Kind::text, kRequired},
    {"/scenes", Kind::list, kOptional, kMaxItems},
    {"/scenes/*", Kind::object},
    {"/scenes/*/nodes", Kind::list, kOptional, kMaxNodes},
    {"/scenes/*/nodes/*", Kind::reference, kOptional, 0, "nodes"},
    {"/scene", Kind::reference, kOptional, 0, "scenes"},
};

class ShapeChecker {
public:
    explicit ShapeChecker(json& document) : document_(document) {}

    void check(const Row& row) {
        row_ = &row;
        target_size_ = row.kind == Kind::reference ? size_of(row.target) : 0;
        pointer_.clear();
        walk(document_, row.path);
    }

private:
    std::size_t size_of(std::string_view target) const {
        const json::json_pointer where(target.front() == '/' ? std::string{target} : "/" + std::string{target});
        if (!document_.contains(where)) return 0;
        const json& list = document_.at(where);
        return list.is_array() ? list.size() : 0;
    }

    /// Follows the row's path below `value`. `rest` is empty or begins with '/'. Recursion ends with the path.
    void walk(json& value, std::string_view rest) {
        if (rest.empty()) return check_value(value);
        const std::size_t end = std::min(rest.find('/', 1), rest.size());
        const std::string key{rest.substr(1, end - 1)};
        const std::string_view next = rest.substr(end);
        if (key == "*") return walk_all(value, next);
        if (!value.is_object()) return;  // its own row has reported it, or nothing reads it
        const auto member = value.find(key);
        if (member != value.end()) return step(member.value(), key, next);
        if (next.empty() && row_->need == Need::required) {
            fail("property.missing", pointer_, "\"" + key + "\" is missing");
        }
    }

    void walk_all(json& value, std::string_view next) {
        if (value.is_array()) {
            for (std::size_t i = 0; i < value.size(); ++i) step(value[i], std::to_string(i), next);
        } else if (value.is_object()) {
            for (auto member = value.begin(); member != value.end(); ++member) step(member.value(), member.key(), next);
        }
    }

    void step(json& value, const std::string& key, std::string_view next) {
        const std::size_t length = pointer_.size();
        pointer_ += '/';
        pointer_ += key;
        walk(value, next);
        pointer_.resize(length);
    }

    void check_value(json& value) {
        switch (row_->kind) {
            case Kind::object:
                return expect(value.is_object(), "an object");
            case Kind::list:
                return check_list(value);
            case Kind::text:
                return expect(value.is_string(), "a string");
            case Kind::boolean:
                return expect(value.is_boolean(), "true or false");
            case Kind::number:
                return expect(value.is_number(), "a number");
            case Kind::integer:
                return check_integer(value, row_->size, "property.range");
            case Kind::numbers:
                return check_numbers(value);
            case Kind::reference:
                return check_reference(value);
            case Kind::choice:
                return check_choice(value);
        }
    }

    void expect(bool right, std::string_view what) const {
        if (!right) fail("property.type", pointer_, "must be " + std::string{what});
    }

    void check_list(const json& value) const {
        expect(value.is_array(), "an array");
        if (value.size() > row_->size) {
            fail("collection.too_large", pointer_,
                 std::to_string(value.size()) + " elements; at most " + std::to_string(row_->size) + " are read");
        }
    }

    void check_numbers(const json& value) const {
        expect(value.is_array(), "an array of numbers");
        if (value.size() != row_->size) {
            fail("property.length", pointer_, "must hold " + std::to_string(row_->size) + " numbers");
        }
        for (const json& number : value) expect(number.is_number(), "an array of numbers");
    }

    void check_integer(json& value, std::size_t largest, const char* rule) const {
        if (value.is_number_float()) {
            const double number = value.get<double>();
            expect(number == std::floor(number), "a whole number");
            if (!(number >= 0.0 && number <= static_cast<double>(largest))) {
                fail(rule, pointer_, "must lie between 0 and " + std::to_string(largest));
            }
            value = static_cast<std::uint64_t>(number);
        }
        expect(value.is_number_integer(), "a whole number");
        const bool negative = !value.is_number_unsigned() && value.get<std::int64_t>() < 0;
        if (negative || value.get<std::uint64_t>() > largest) {
            fail(rule, pointer_, "must lie between 0 and " + std::to_string(largest));
        }
    }

    void check_reference(json& value) const {
        expect(value.is_number(), "an index");
        if (target_size_ == 0) fail("reference.unresolved", pointer_, "names an object that does not exist");
        check_integer(value, target_size_ - 1, "reference.unresolved");
    }

    void check_choice(const json& value) const {
        expect(value.is_string(), "a string");
        const auto& word = value.get_ref<const std::string&>();
        const bool known = !word.empty() && word.find('|') == std::string::npos &&
                           row_->target.find("|" + word + "|") != std::string_view::npos;
        if (!known) fail("property.choice", pointer_, printable(word) + " is none of " + std::string{row_->target});
    }

    json& document_;
    const Row* row_ = nullptr;
    std::size_t target_size_ = 0;
    std::string pointer_;
};

// glTF 2.0 table 3.6.2.2: BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, UNSIGNED_INT, FLOAT.
constexpr int kComponentTypes[] = {5120, 5121, 5122, 5123, 5125, 5126};
// glTF 2.0, section 5.11.4. Some files use 0 for "tightly packed".
constexpr std::size_t kStrideStep = 4, kMaxStride = 252;

/// Checks rules between properties, which no row covers. tinygltf rejects most of these without naming the place.
void check_across(json& document, Notes& notes) {
    const json none = json::array();
    const auto list = [&](const char* where) -> const json& {
        const json::json_pointer path(where);
        return document.contains(path) ? document.at(path) : none;
    };
    const json& accessors = list("/accessors");
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const auto type = accessors[i]["componentType"].get<int>();
        if (std::find(std::begin(kComponentTypes), std::end(kComponentTypes), type) != std::end(kComponentTypes))
            continue;
        fail("accessor.component_type", pointer("accessors", i, "componentType"),
             std::to_string(type) + " is not a component type");
    }
    const json& views = list("/bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto stride = views[i].value("byteStride", std::size_t{0});
        if (stride % kStrideStep == 0 && stride <= kMaxStride) continue;
        notes.push_back(taken("buffer_view.stride", pointer("bufferViews", i, "byteStride"),
                              std::to_string(stride) + " is no multiple of 4 up to 252, taken as it is"));
    }
    const json& cameras = list("/cameras");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const auto type = cameras[i]["type"].get<std::string>();
        if (!cameras[i].contains(type)) fail("property.missing", pointer("cameras", i), "\"" + type + "\" is missing");
    }
    const json& animations = list("/animations");
    for (std::size_t a = 0; a < animations.size(); ++a) {
        const json& channels = animations[a]["channels"];
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (channels[c]["sampler"].get<std::size_t>() < animations[a]["samplers"].size()) continue;
            fail("reference.unresolved", pointer("animations", a, "channels", c, "sampler"),
                 "names an object that does not exist");
        }
    }
    const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    if (!document.contains(lights)) return;
    json& list_of_lights = document.at(lights);
    for (std::size_t i = 0; i < list_of_lights.size(); ++i) {
        json& light = list_of_lights[i];
        if (light["type"] != "spot" || light.contains("spot")) continue;
        light["spot"] = json::object();
        notes.push_back(taken("light.no_spot", pointer("extensions", "KHR_lights_punctual", "lights", i),
                              "\"spot\" is missing, its cone is taken as glTF's default"));
    }
}

}  // namespace

void check_shape(json& document, Notes& notes) {
    if (!document.is_object()) fail("json.root", "", "the root is not an object");
    ShapeChecker checker(document);
    for (const Row& row : kRows) checker.check(row);
    check_across(document, notes);
}

}  // namespace gnomon::assets::gltf
