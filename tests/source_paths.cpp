#include "tests/source_paths.h"

// The only file that is compiled with a path, so that ccache knows all others again in another checkout.
namespace gnomon::test {

std::filesystem::path source_folder() { return GNOMON_SOURCE_DIR; }
std::filesystem::path data_folder() { return GNOMON_DATA_DIR; }

}  // namespace gnomon::test
