#pragma once
#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace gnomon {

/// A folder of one test's own, whichever others run at the same time, by whatever process; gone with this.
class OwnFolder {
public:
    OwnFolder() {
        std::string pattern = std::filesystem::temp_directory_path() / "gnomon_test_XXXXXX";
        if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder can be made as " + pattern);
        path_ = pattern;
    }
    ~OwnFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace gnomon
