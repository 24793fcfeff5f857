#include "bench/common/png_file.h"

#include <vector>

#include "engine/image/encode_image.h"
#include "sample_game/support/files/image_files.h"

namespace gnomon::bench {

std::optional<Error> write_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> rgba) {
    const std::vector<std::uint8_t> png = encode_png(width, height, rgba);
    if (png.empty())
        return Error{.message = "cannot encode the picture", .file = file.string(), .rule = "output.write"};
    return game::write_file(file, std::as_bytes(std::span(png)));
}

}  // namespace gnomon::bench
