#pragma once

namespace gnomon {

/// Version, as docs/reference/versions.md defines it.
struct Version {
    int major = 0;  // breaks users' code or files
    int minor = 0;  // adds; before 1.0 it may break
    int patch = 0;  // mends
    bool operator==(const Version&) const = default;
};

/// Version of these headers.
inline constexpr Version kVersion{0, 1, 0};
/// Returns the version of the library that is linked. It equals kVersion, unless headers and library were mixed.
Version linked_version();

}  // namespace gnomon
