#pragma once
#include <filesystem>
#include <vector>

#include "engine/gl/gl45_objects.h"
#include "engine/gl/program_cache.h"

namespace gnomon::gl {

/// Makes programs from a cache if it has a binary for this driver, otherwise from sources. Private to the executor.
class GlPrograms {
public:
    /// Opens the cache; empty `cache_folder`: none. Queries the driver, so that a context must be current.
    explicit GlPrograms(std::filesystem::path cache_folder);

    Made<GLuint> make(const ProgramDesc& desc);
    ProgramCounts counts() const { return counts_; }

private:
    GLuint from_cache(const ProgramDesc& desc) const;
    void keep(const ProgramDesc& desc, GLuint program) const;

    std::vector<GLint> formats_;  // binary formats of the driver
    ProgramCache cache_;
    ProgramCounts counts_;
};

}  // namespace gnomon::gl
