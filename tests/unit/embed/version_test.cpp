#include "gnomon/version.h"

#include <gtest/gtest.h>

#include <string>

namespace gnomon {
namespace {

TEST(Version, HeadersLibraryAndPackageAgree) {
    EXPECT_EQ(linked_version(), kVersion);
    EXPECT_EQ(std::to_string(kVersion.major) + "." + std::to_string(kVersion.minor) + "." + std::to_string(kVersion.patch),
              GNOMON_PROJECT_VERSION);
}

}  // namespace
}  // namespace gnomon
