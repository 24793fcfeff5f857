#pragma once
#include <string>

namespace gnomon {

/// Name of the entity in reports, picture files and debuggers.
struct Name {
    std::string text;
};

}  // namespace gnomon
