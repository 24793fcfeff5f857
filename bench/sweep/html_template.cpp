#include "bench/sweep/html_template.h"

#include <algorithm>
#include <cstdint>

#include <report_page.inc>

namespace gnomon::bench {

std::string escaped_html(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '&':
                escaped += "&amp;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string filled_page(std::span<const std::pair<std::string_view, std::string>> values) {
    std::string page;
    std::string_view rest = kReportPage;
    // What is put in is never searched, whatever a scene is called.
    for (std::size_t open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
        const std::size_t close = rest.find("}}", open);
        const std::string_view name = rest.substr(open + 2, close - open - 2);
        page += rest.substr(0, open);
        if (name == "STYLE") page += kReportStyle;
        if (name == "SCRIPT") page += kReportScript;
        for (const auto& [key, value] : values)
            if (key == name) page += value;
        rest = rest.substr(close + 2);
    }
    return page += rest;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr std::size_t kBytes = 3, kChars = 4, kBits = 6, kMask = 63;
    std::string text;
    text.reserve((bytes.size() + kBytes - 1) / kBytes * kChars);
    for (std::size_t i = 0; i < bytes.size(); i += kBytes) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < kBytes; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        const std::size_t used = std::min(bytes.size() - i, kBytes) + 1;
        for (std::size_t k = 0; k < kChars; ++k)
            text += k < used ? kDigits[group >> (kBits * (kChars - 1 - k)) & kMask] : '=';
    }
    return text;
}

}  // namespace gnomon::bench
