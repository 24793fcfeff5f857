#include "gnomon/version.h"

namespace gnomon {

Version linked_version() { return kVersion; }

}  // namespace gnomon
