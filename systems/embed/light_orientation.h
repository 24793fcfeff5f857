#pragma once
#include <glm/mat3x3.hpp>
#include <optional>

#include "gnomon/shadows.h"

namespace gnomon::embed {

/// Returns the axes of a light that shines along its `direction`, with X along its `right`. Empty: it has no direction.
std::optional<glm::dmat3> orientation_of(const LightDesc& desc);

}  // namespace gnomon::embed
