#include "bench/text/replace_doc_section.h"

#include <fstream>
#include <iterator>
#include <span>

#include "sample_game/support/files/image_files.h"

namespace gnomon::bench {

std::optional<Error> replace_marked(const std::filesystem::path& page, const std::string& name,
                                    const std::string& text) {
    std::ifstream file(page, std::ios::binary);
    if (!file) return Error{"the page cannot be read", page.string(), "", "page.read"};
    std::string all{std::istreambuf_iterator<char>(file), {}};
    file.close();
    const std::string begin = "<!-- " + name + " -->\n", end = "<!-- end of " + name + " -->\n";
    const std::size_t first = all.find(begin), last = all.find(end);
    if (first == std::string::npos || last == std::string::npos || last < first)
        return Error{"the page has no marks of '" + name + "'", page.string(), "", "page.marks"};
    const std::size_t from = first + begin.size();
    all.replace(from, last - from, text);
    return game::write_file(page, std::as_bytes(std::span(all)));
}

}  // namespace gnomon::bench
