#include "engine/assets/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_limits.h"

namespace gnomon::assets::gltf {
namespace {

constexpr std::size_t kColumnAlignment = 4;  // matrix columns, glTF 2.0 section 3.6.2.4

std::size_t component_bytes(int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

struct ElementLayout {
    std::size_t rows = 1, columns = 1;
};

ElementLayout element_layout(int type) {
    switch (type) {
        case TINYGLTF_TYPE_VEC2:
            return {2, 1};
        case TINYGLTF_TYPE_VEC3:
            return {3, 1};
        case TINYGLTF_TYPE_VEC4:
            return {4, 1};
        case TINYGLTF_TYPE_MAT2:
            return {2, 2};
        case TINYGLTF_TYPE_MAT3:
            return {3, 3};
        case TINYGLTF_TYPE_MAT4:
            return {4, 4};
        default:
            return {1, 1};
    }
}

std::size_t column_pitch(const tinygltf::Accessor& accessor) {
    const std::size_t column = element_layout(accessor.type).rows * component_bytes(accessor.componentType);
    return (column + kColumnAlignment - 1) / kColumnAlignment * kColumnAlignment;
}

/// Returns the bytes of one element, without padding after its last column.
std::size_t element_bytes(const tinygltf::Accessor& accessor) {
    const ElementLayout layout = element_layout(accessor.type);
    return (layout.columns - 1) * column_pitch(accessor) + layout.rows * component_bytes(accessor.componentType);
}

std::size_t stride_bytes(const Document& document, const tinygltf::Accessor& accessor) {
    if (accessor.bufferView >= 0) {
        const std::size_t stride = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
        if (stride != 0) return stride;
    }
    return element_bytes(accessor);
}

void validate_view(Document& document, std::size_t i) {
    const auto& view = document.model.bufferViews[i];
    if (view.byteLength == 0)
        document.take("buffer_view.empty", pointer("bufferViews", i, "byteLength"), "is 0, taken as a view of nothing");
    const BufferData& buffer = document.buffers[static_cast<std::size_t>(view.buffer)];
    if (!buffer.available) return;  // an error when something reads it
    if (view.byteOffset > buffer.bytes.size() || view.byteLength > buffer.bytes.size() - view.byteOffset) {
        fail("buffer_view.out_of_range", pointer("bufferViews", i), "reaches past the end of its buffer");
    }
}

/// Returns true if `count` > 0 elements of `size` bytes fit into a view of `length` bytes. They start at `offset`,
/// every `stride` bytes.
bool fits(std::size_t length, std::size_t offset, std::size_t count, std::size_t stride, std::size_t size) {
    if (offset > length || size > length - offset) return false;
    return count - 1 <= (length - offset - size) / stride;
}

void validate_sparse(Document& document, std::size_t i) {
    const auto& accessor = document.model.accessors[i];
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<std::size_t>(sparse.count);
    const std::string where = pointer("accessors", i, "sparse");
    if (count > accessor.count) {
        fail("accessor.sparse_count", where + "/count", "must lie between 1 and the accessor's count");
    }
    const int type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        fail("accessor.sparse_index_type", where + "/indices/componentType", "must be an unsigned integer type");
    }
    const auto length_of = [&](int view) {
        return document.model.bufferViews[static_cast<std::size_t>(view)].byteLength;
    };
    if (count == 0) {
        document.take("accessor.sparse_empty", where + "/count", "is 0, taken as nothing replaced");
        return;
    }
    const std::size_t index_size = component_bytes(type);
    if (!fits(length_of(sparse.indices.bufferView), static_cast<std::size_t>(sparse.indices.byteOffset), count,
              index_size, index_size)) {
        fail("accessor.sparse_out_of_range", where + "/indices", "reaches past the end of its buffer view");
    }
    const std::size_t value_size = element_bytes(accessor);  // sparse values are tightly packed
    if (!fits(length_of(sparse.values.bufferView), static_cast<std::size_t>(sparse.values.byteOffset), count,
              value_size, value_size)) {
        fail("accessor.sparse_out_of_range", where + "/values", "reaches past the end of its buffer view");
    }
}

void validate_accessor(Document& document, std::size_t i, std::size_t buffer_bytes) {
    const auto& accessor = document.model.accessors[i];
    if (accessor.count == 0) {
        document.take("accessor.empty", pointer("accessors", i, "count"), "is 0, taken as no elements");
        if (accessor.sparse.isSparse) validate_sparse(document, i);
        return;
    }
    const std::size_t size = element_bytes(accessor);
    if (accessor.count > kMaxDecodedBytes / size) {
        fail("accessor.too_large", pointer("accessors", i, "count"), "more elements than fit the memory budget");
    }
    if (accessor.bufferView >= 0) {
        const auto& view = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
        const std::size_t stride = stride_bytes(document, accessor);
        if (stride < size) fail("accessor.stride", pointer("accessors", i), "its elements overlap");
        if (!fits(view.byteLength, accessor.byteOffset, accessor.count, stride, size)) {
            fail("accessor.out_of_range", pointer("accessors", i), "reaches past the end of its buffer view");
        }
    } else if (accessor.count > kMaxUnbackedElements + buffer_bytes) {
        fail("accessor.unbacked", pointer("accessors", i, "count"),
             std::to_string(accessor.count) + " elements without a buffer view, in a file whose buffers hold " +
                 std::to_string(buffer_bytes) + " bytes");
    }
    if (accessor.sparse.isSparse) validate_sparse(document, i);
}

template <class T>
float as_float(T value, bool normalized) {
    if constexpr (std::is_floating_point_v<T>) {
        return value;
    } else {
        const auto number = static_cast<float>(value);
        if (!normalized) return number;
        return std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
    }
}

template <class T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

/// Calls `use(T{})` with the type of `component_type`.
template <class Use>
void with_component(int component_type, Use&& use) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return use(std::int8_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return use(std::uint8_t{});
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return use(std::int16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return use(std::uint16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return use(std::uint32_t{});
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return use(float{});
        default:
            return;
    }
}

/// Copies the elements of an accessor to `out`, each component through `convert`, sparse values on top.
template <class Out, class Convert>
std::vector<Out> read_elements(const Document& document, int index, Convert&& convert) {
    const auto& accessor = document.model.accessors[static_cast<std::size_t>(index)];
    const std::string where = pointer("accessors", index);
    const ElementLayout layout = element_layout(accessor.type);
    const std::size_t components = layout.rows * layout.columns;
    std::vector<Out> out(accessor.count * components, Out{});
    if (out.empty()) return out;
    with_component(accessor.componentType, [&]<class T>(T) {
        const auto copy = [&](const std::byte* from, std::size_t element) {
            for (std::size_t c = 0; c < components; ++c) {
                const std::byte* column = from + c / layout.rows * column_pitch(accessor);
                out[element * components + c] = convert(load<T>(column + c % layout.rows * sizeof(T)));
            }
        };
        if (accessor.bufferView >= 0) {
            const std::byte* data = view_bytes(document, accessor.bufferView, where).data() + accessor.byteOffset;
            const std::size_t stride = stride_bytes(document, accessor);
            for (std::size_t i = 0; i < accessor.count; ++i) copy(data + i * stride, i);
        }
        if (!accessor.sparse.isSparse || accessor.sparse.count == 0) return;
        const auto& sparse = accessor.sparse;
        const std::byte* values =
            view_bytes(document, sparse.values.bufferView, where).data() + sparse.values.byteOffset;
        const std::byte* indices =
            view_bytes(document, sparse.indices.bufferView, where).data() + sparse.indices.byteOffset;
        with_component(sparse.indices.componentType, [&]<class I>(I) {
            std::size_t next_allowed = 0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
                const auto element = static_cast<std::size_t>(
                    load<I>(indices + i * sizeof(I)));  // NOLINT(bugprone-signed-char-misuse): indices are unsigned
                if (element < next_allowed || element >= accessor.count) {
                    fail("accessor.sparse_index", where + "/sparse/indices", "must rise and stay below the count");
                }
                next_allowed = element + 1;
                copy(values + i * element_bytes(accessor), element);
            }
        });
    });
    return out;
}

}  // namespace

void validate_ranges(Document& document) {
    for (std::size_t i = 0; i < document.model.bufferViews.size(); ++i) validate_view(document, i);
    std::size_t buffer_bytes = 0;
    for (const BufferData& buffer : document.buffers) buffer_bytes += buffer.bytes.size();
    for (std::size_t i = 0; i < document.model.accessors.size(); ++i) validate_accessor(document, i, buffer_bytes);
}

std::span<const std::byte> view_bytes(const Document& document, int index, const std::string& pointer) {
    const auto& view = document.model.bufferViews[static_cast<std::size_t>(index)];
    const BufferData& buffer = document.buffers[static_cast<std::size_t>(view.buffer)];
    if (!buffer.available) fail("buffer.no_data", pointer, "its buffer has neither a URI nor a BIN chunk");
    return buffer.bytes.subspan(view.byteOffset, view.byteLength);
}

std::vector<float> read_any_floats(const Document& document, int index, bool normalised) {
    const auto& accessor = document.model.accessors[static_cast<std::size_t>(index)];
    return read_elements<float>(document, index, [normalised = normalised || accessor.normalized](auto value) {
        return as_float(value, normalised);
    });
}

std::vector<float> read_floats(const Document& document, int index) {
    std::vector<float> numbers = read_any_floats(document, index);
    for (const float number : numbers) {
        if (!std::isfinite(number)) fail("accessor.not_finite", pointer("accessors", index), "holds NaN or infinity");
    }
    return numbers;
}

std::vector<std::uint32_t> read_indices(const Document& document, int index) {
    const auto& accessor = document.model.accessors[static_cast<std::size_t>(index)];
    const std::string where = pointer("accessors", index);
    if (accessor.type != TINYGLTF_TYPE_SCALAR) fail("index.type", where, "indices must be SCALAR");
    std::uint32_t restart = 0;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            restart = std::numeric_limits<std::uint8_t>::max();
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            restart = std::numeric_limits<std::uint16_t>::max();
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            restart = std::numeric_limits<std::uint32_t>::max();
            break;
        default:
            fail("index.type", where, "indices must be unsigned integers");
    }
    std::vector<std::uint32_t> indices =
        read_elements<std::uint32_t>(document, index, [](auto value) { return static_cast<std::uint32_t>(value); });
    for (const std::uint32_t value : indices) {
        if (value == restart) fail("index.restart", where, "holds the primitive restart value");
    }
    return indices;
}

}  // namespace gnomon::assets::gltf
