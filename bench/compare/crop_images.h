#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/accuracy/reference_images.h"
#include "gnomon/result.h"

namespace gnomon::bench {

/// Size of the part of the picture that is shown for each row, at most the picture's, one pixel to one.
inline constexpr glm::uvec2 kShownPart_px{240, 135};

/// Returns the lower corner of the part with most edges of that light's true shadow, rows from the bottom. It depends
/// on the truth alone, so that all rows show the same part.
glm::uvec2 shown_part(const oracle::LightTruth& truth, glm::uvec2 size_px, glm::uvec2 part_px = kShownPart_px);

/// Pictures of one light in one row: files <stem>_render.jpg, _shown.png and _error.png. The truths of a light are in
/// <light>_point.png and _disk.png.
class RowPictures {
public:
    /// Makes the folder and writes the truths. Errors: those of game::make_writable_folder and write_file.
    static Result<RowPictures> make(const std::filesystem::path& folder, const TracedTruths& truths);

    /// Writes the files. `rgba`: the picture, top row first; `by_disk`: the error is against the truth about the disk.
    std::optional<Error> write(const std::string& stem, const TracedLight& light, const std::vector<float>& measured,
                               const std::vector<std::uint8_t>& rgba, bool by_disk) const;

    /// Returns the common name of the files of row `row` of a plan.
    static std::string stem(std::size_t row, const std::string& light) { return std::to_string(row) + "_" + light; }

private:
    RowPictures(std::filesystem::path folder, glm::uvec2 size_px) : folder_(std::move(folder)), size_px_(size_px) {}

    std::filesystem::path folder_;
    glm::uvec2 size_px_;
    std::map<std::string, glm::uvec2> shown_;  // by the light's name
};

}  // namespace gnomon::bench
