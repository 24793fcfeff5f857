#include "engine/assets/gltf_extras.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace gnomon::assets::gltf {

using nlohmann::json;

ExtrasReader::ExtrasReader(Document& document, const json& owner, std::string pointer)
    : document_(document), pointer_(std::move(pointer)) {
    const auto found = owner.find("extras");
    if (found != owner.end() && found->is_object()) extras_ = &*found;
}

void ExtrasReader::warn(const std::string& key, const std::string& reason) const {
    document_.warn(pointer_ + "/extras/" + key + ": ignored, " + reason);
}

bool ExtrasReader::boolean(const char* key, bool fallback) const {
    if (extras_ == nullptr) return fallback;
    const auto found = extras_->find(key);
    if (found == extras_->end()) return fallback;
    if (!found->is_boolean()) {
        warn(key, "it is neither true nor false");
        return fallback;
    }
    return found->get<bool>();
}

bool ExtrasReader::read_number(const json& object, const char* key, double& value) const {
    const auto found = object.find(key);
    if (found == object.end()) return true;
    if (!found->is_number()) return false;
    value = found->get<double>();
    return std::isfinite(value);
}

Node::Motion ExtrasReader::motion() const {
    if (extras_ == nullptr) return {};
    const auto found = extras_->find("motion");
    if (found == extras_->end()) return {};
    const auto kind = found->is_object() ? found->find("kind") : found->end();
    if (!found->is_object() || kind == found->end() || !kind->is_string()) {
        warn("motion", "it has no kind");
        return {};
    }
    Node::Motion motion;
    motion.kind = kind->get<std::string>();
    if (motion.kind != "spin" && motion.kind != "swing" && motion.kind != "slide") {
        warn("motion", "its kind is not spin, swing or slide");
        return {};
    }
    const auto axis = found->find("axis");
    if (axis != found->end()) {
        const bool right = axis->is_array() && axis->size() == 3 && (*axis)[0].is_number() && (*axis)[1].is_number() &&
                           (*axis)[2].is_number();
        motion.axis = right ? glm::dvec3((*axis)[0].get<double>(), (*axis)[1].get<double>(), (*axis)[2].get<double>())
                            : glm::dvec3(0.0);
    }
    const double length = glm::length(motion.axis);
    const bool numbers = read_number(*found, "amplitude", motion.amplitude) &&
                         read_number(*found, "period_s", motion.period_s) && read_number(*found, "phase", motion.phase);
    if (!numbers || !(motion.period_s > 0.0) || !(length > 0.0) || !std::isfinite(length)) {
        warn("motion", "it needs a non-zero axis, a positive period_s and finite numbers");
        return {};
    }
    motion.axis /= length;
    return motion;
}

}  // namespace gnomon::assets::gltf
