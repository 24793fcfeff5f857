// libFuzzer: any bytes as a file, best started from a folder of real ones.
#include "tests/fuzz/gltf_mutator.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gnomon::test::load_and_check(std::as_bytes(std::span(data, size)));
    return 0;
}
