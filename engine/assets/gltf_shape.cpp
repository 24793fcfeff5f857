#include "engine/assets/gltf_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_limits.h"
#include "engine/assets/gltf_shape_rows.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

class ShapeChecker {
public:
    explicit ShapeChecker(json& document) : document_(document) {}

    void check(const ShapeRow& row) {
        row_ = &row;
        target_size_ = row.kind == ShapeKind::reference ? size_of(row.target) : 0;
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
        if (next.empty() && row_->need == ShapeNeed::required) {
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
            case ShapeKind::object:
                return expect(value.is_object(), "an object");
            case ShapeKind::list:
                return check_list(value);
            case ShapeKind::text:
                return expect(value.is_string(), "a string");
            case ShapeKind::boolean:
                return expect(value.is_boolean(), "true or false");
            case ShapeKind::number:
                return expect(value.is_number(), "a number");
            case ShapeKind::integer:
                return check_integer(value, row_->size, "property.range");
            case ShapeKind::numbers:
                return check_numbers(value);
            case ShapeKind::reference:
                return check_reference(value);
            case ShapeKind::choice:
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
    const ShapeRow* row_ = nullptr;
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
    for (const ShapeRow& row : shape_rows()) checker.check(row);
    check_across(document, notes);
}

}  // namespace gnomon::assets::gltf
