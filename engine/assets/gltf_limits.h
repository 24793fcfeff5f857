#pragma once
#include <cstddef>
#include <cstdint>

/// Limits of the glTF loader, also enforced in Release. A file beyond a limit is rejected by a named rule.
namespace gnomon::assets::gltf {

inline constexpr std::size_t kMiB = std::size_t{1} << 20;

/// Limits on the main file, and on all files it names together: far above real scenes, far below the memory of a small
/// machine.
inline constexpr std::size_t kMaxFileBytes = 256 * kMiB;
inline constexpr std::size_t kMaxExternalBytes = 512 * kMiB;

/// tinygltf walks JSON recursively. 64 levels are ten times what glTF needs, and use a thousandth of the stack.
inline constexpr std::size_t kMaxJsonDepth = 64;

/// A parsed JSON value costs about 100 bytes, twice (loader and tinygltf): at most 0.8 GB.
inline constexpr std::size_t kMaxJsonValues = 4'000'000;

/// tinygltf needs about 550 bytes per node: 140 MiB. Instances cannot outnumber nodes.
inline constexpr std::size_t kMaxNodes = 262'144;
inline constexpr std::size_t kMaxNodeDepth = 256;

/// Maximum number of meshes, accessors, materials, …, and of primitives in one mesh.
inline constexpr std::size_t kMaxItems = 262'144;

/// The topology analysis processes 16 M triangles in about 10 s on one slow core.
inline constexpr std::size_t kMaxTriangles = 16'000'000;

/// Maximum number of morph targets in one mesh; film characters' faces have some hundred.
inline constexpr std::size_t kMaxTargets = 4096;

/// Memory for vertices, indices, morph targets, keys and texels, and for any one expanded accessor.
inline constexpr std::size_t kMaxDecodedBytes = 512 * kMiB;

/// Elements that an accessor without a buffer view may have beyond the file's buffer bytes. Such an accessor is zero
/// except for its sparse values. It accompanies accessors of the same count, which need at least a byte per element.
/// Without this limit, 300 bytes of text make the loader allocate half a gigabyte of zeros.
inline constexpr std::size_t kMaxUnbackedElements = 65'536;

inline constexpr std::uint32_t kMaxImageEdge_px = 8192;
/// Largest allocation of the image decoder: 8192² texels of 4 × 16 bit and one filter byte per row, with slack.
inline constexpr std::size_t kMaxImageAllocation = 544 * kMiB;

/// Largest coordinate in mesh space. A float resolves 0.06 at 1e6; beyond it, depth bias and normals become
/// meaningless.
inline constexpr float kMaxPosition_ms = 1.0e6f;
/// Largest coordinate in world space: a hundred times the largest supported scene (1e8 m).
inline constexpr double kMaxPosition_ws_m = 1.0e10;

/// Tolerance for a matrix as translation, rotation, scale: error of the recomposed matrix relative to the longest
/// column. Exporters write floats (6e-8) after a few float products.
inline constexpr double kMatrixTolerance = 1.0e-5;

/// Maximum number of warnings; further ones are only counted.
inline constexpr std::size_t kMaxWarnings = 64;

}  // namespace gnomon::assets::gltf
