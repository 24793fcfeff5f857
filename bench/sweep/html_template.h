#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::bench {

/// Text with the characters escaped that HTML takes as its own.
std::string escaped_html(std::string_view text);

/// The report's page (bench/page) with each {{NAME}} replaced; STYLE and SCRIPT are its own.
std::string filled_page(std::span<const std::pair<std::string_view, std::string>> values);

std::string base64(std::string_view bytes);

}  // namespace gnomon::bench
