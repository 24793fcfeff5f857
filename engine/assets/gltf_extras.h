#pragma once
#include <string>

#include "engine/assets/gltf_document.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {

/// Reads the project's own `extras`. Extras of other tools may use the same names. Hence a value of wrong type is
/// ignored with a warning and never an error.
class ExtrasReader {
public:
    /// Takes the JSON object that may have "extras"; `pointer` is its place in the file.
    ExtrasReader(Document& document, const nlohmann::json& owner, std::string pointer);

    bool boolean(const char* key, bool fallback) const;
    Node::Motion motion() const;

private:
    bool read_number(const nlohmann::json& object, const char* key, double& value) const;
    void warn(const std::string& key, const std::string& reason) const;

    Document& document_;
    const nlohmann::json* extras_ = nullptr;
    std::string pointer_;
};

}  // namespace gnomon::assets::gltf
