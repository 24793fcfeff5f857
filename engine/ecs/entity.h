#pragma once
#include <cstdint>
#include <functional>

namespace gnomon::ecs {

/// Opaque, versioned entity id. A destroyed id never equals a living one: its index may be reused, its version is not.
struct Entity {
    std::uint32_t index = 0xffffffffu;
    std::uint32_t version = 0;
    bool operator==(const Entity&) const = default;
};

/// Id of no entity. Never alive.
inline constexpr Entity kNull{};

}  // namespace gnomon::ecs

template <>
struct std::hash<gnomon::ecs::Entity> {
    std::size_t operator()(const gnomon::ecs::Entity& e) const noexcept {
        return std::hash<std::uint64_t>{}(std::uint64_t{e.version} << 32 | e.index);
    }
};
