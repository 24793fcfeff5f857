#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "gnomon/result.h"

namespace gnomon::bench {

/// Replaces what stands between the lines `<!-- NAME -->` and `<!-- end of NAME -->` of a page. The first of each
/// counts. Errors: "page.read", "page.marks"; those of writing a file.
std::optional<Error> replace_marked(const std::filesystem::path& page, const std::string& name,
                                    const std::string& text);

}  // namespace gnomon::bench
