// Compiled only if tinygltf is a header without a library (cmake/find_libraries.cmake). The build sets
// TINYGLTF_NO_STB_IMAGE and similar macros, because they change the header's classes and must agree in all its users.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
