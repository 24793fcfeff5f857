#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/light.h"

namespace gnomon::bench {

/// A set of light kinds.
using LightKinds = std::uint8_t;
constexpr LightKinds only(LightKind kind) { return static_cast<LightKinds>(1u << static_cast<unsigned>(kind)); }
constexpr bool holds(LightKinds kinds, LightKind kind) { return (kinds & only(kind)) != 0; }
inline constexpr LightKinds kAllKinds = 2 * only(LightKind::tube) - 1;  // tube is the last

/// One way for lights to cast shadows, to be compared with others.
struct RowSetup {
    std::string name;
    std::vector<std::string> settings;  // KEY=VALUE, on top of what the lights were opened with
    LightKinds kinds = kAllKinds;       // lights of other kinds cast no shadows meanwhile
};

}  // namespace gnomon::bench
