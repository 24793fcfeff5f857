// Compiled only where tinygltf is a header without a library (cmake/find_libraries.cmake).
// TINYGLTF_NO_STB_IMAGE and its like come from the build: they change the header's classes, so all its users share them.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
