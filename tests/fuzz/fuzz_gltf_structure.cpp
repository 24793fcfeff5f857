// libFuzzer: glTF with sound framing and damaged content.
#include "tests/fuzz/gltf_mutator.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gnomon::test::load_and_check(gnomon::test::mutated_gltf({data, size}));
    return 0;
}
