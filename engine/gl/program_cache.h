#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/gl/device.h"

namespace gnomon::gl {

/// Linked programs, kept in a folder from run to run, a file each. Knows nothing of OpenGL: what a driver gave is given
/// back as it was. A file is found by the hash of what its program was made from, and holds all of that: another
/// program, driver or version is told apart whatever its hash. A file that was cut, changed or written by others counts
/// as none. Several processes may share a folder: files appear whole. Nothing throws; where the folder cannot be read
/// or written nothing is kept. Files are never deleted for age: the folder may be emptied at any time.
class ProgramCache {
public:
    struct Binary {
        std::uint32_t format = 0;  // the driver's own number
        std::vector<std::byte> bytes;
        bool operator==(const Binary&) const = default;
    };

    /// `folder` is made when something is first kept; empty: nothing is. `driver`: whatever its binaries depend on.
    ProgramCache(std::filesystem::path folder, std::string driver);

    bool is_on() const { return !folder_.empty(); }
    /// Of the program of these sources; its label does not matter.
    std::optional<Binary> find(const ProgramDesc& desc) const;
    /// False: it was not kept.
    bool keep(const ProgramDesc& desc, const Binary& binary) const;
    /// To be called when the driver does not take what was found.
    void forget(const ProgramDesc& desc) const;

private:
    std::string identity(const ProgramDesc& desc) const;
    std::filesystem::path file_of(const std::string& identity) const;

    std::filesystem::path folder_;
    std::string driver_;
};

}  // namespace gnomon::gl
