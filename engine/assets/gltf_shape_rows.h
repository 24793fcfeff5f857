#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// Rules for the properties of a document, which load_shape() checks.
namespace gnomon::assets::gltf {

enum class ShapeKind : std::uint8_t { object, list, text, boolean, number, integer, numbers, reference, choice };
enum class ShapeNeed : std::uint8_t { optional, required };

/// Rule for one property. `path` is a JSON pointer with * for every element or member.
struct ShapeRow {
    std::string_view path;
    ShapeKind kind;
    ShapeNeed need = ShapeNeed::optional;
    std::size_t size = 0;          // list: maximum length; numbers: exact length; integer: largest value
    std::string_view target = {};  // reference: the collection; choice: the words, each between bars
};

/// Returns all rules. Parents come before their members, so that the first error is the clearest.
std::span<const ShapeRow> shape_rows();

}  // namespace gnomon::assets::gltf
