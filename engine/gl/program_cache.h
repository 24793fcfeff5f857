#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/gl/device.h"

namespace gnomon::gl {

/// Folder of linked programs that persists across runs, one file each. Independent of OpenGL: returns a driver's binary
/// unchanged. A file is found by the hash of its program's identity, and stores that identity as well. Programs,
/// drivers and versions with equal hashes are thus never confused. Damaged or foreign files are ignored. Several
/// processes may share a folder, because files appear as a whole. Nothing throws; if the folder cannot be read or
/// written, nothing is cached. Files do not expire: the folder may be emptied at any time.
class ProgramCache {
public:
    struct Binary {
        std::uint32_t format = 0;  // the driver's own number
        std::vector<std::byte> bytes;
        bool operator==(const Binary&) const = default;
    };

    /// Sets the folder, which is created with the first file; empty: the cache is off. `driver`: text of what binaries
    /// depend on.
    ProgramCache(std::filesystem::path folder, std::string driver);

    bool is_on() const { return !folder_.empty(); }
    /// Finds the program with these sources; its label is ignored.
    std::optional<Binary> find(const ProgramDesc& desc) const;
    /// Stores a binary. Returns false on failure.
    bool keep(const ProgramDesc& desc, const Binary& binary) const;
    /// Deletes an entry that the driver rejected.
    void forget(const ProgramDesc& desc) const;

private:
    std::string identity(const ProgramDesc& desc) const;
    std::filesystem::path file_of(const std::string& identity) const;

    std::filesystem::path folder_;
    std::string driver_;
};

}  // namespace gnomon::gl
