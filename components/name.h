#pragma once
#include <string>

namespace gnomon {

/// What a report, a picture file or a debugger calls the entity.
struct Name {
    std::string text;
};

}  // namespace gnomon
