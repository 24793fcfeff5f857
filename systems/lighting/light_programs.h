#pragma once
#include <string>
#include <vector>

#include "engine/gl/device.h"
#include "systems/shadow/types.h"

namespace gnomon::lighting {

/// What a program of a row writes.
enum class RowOutput : std::uint8_t { picture, visibility, blended };

/// Programs of the lighting system, made when first called for; one per (row, output). Owns them.
/// A source that failed to compile is not tried again.
class LightPrograms {
public:
    explicit LightPrograms(gl::Device& device) : device_(device) {}
    ~LightPrograms();
    LightPrograms(const LightPrograms&) = delete;
    LightPrograms& operator=(const LightPrograms&) = delete;

    /// {0} if it cannot be made.
    gl::ProgramHandle row(const shadow::ProgramRow& row, RowOutput output);
    gl::ProgramHandle surface();
    gl::ProgramHandle blended_base();
    gl::ProgramHandle luminance();
    gl::ProgramHandle tonemap();

private:
    struct Entry {
        std::string key;
        gl::ProgramHandle program{};
    };
    gl::ProgramHandle get(const std::string& key, const char* vertex, const char* fragment,
                          const std::vector<std::string>& defines, const shadow::ProgramRow* row);

    gl::Device& device_;
    std::vector<Entry> entries_;
};

}  // namespace gnomon::lighting
