#pragma once
#include <cstddef>
#include <cstdint>

/// Every limit that the glTF door enforces, in Release too. A file beyond one of them is refused by a named rule.
namespace gnomon::assets::gltf {

inline constexpr std::size_t kMiB = std::size_t{1} << 20;

/// Main file, and all files it names together: far above real scenes, far below the memory of a small machine.
inline constexpr std::size_t kMaxFileBytes = 256 * kMiB;
inline constexpr std::size_t kMaxExternalBytes = 512 * kMiB;

/// tinygltf walks JSON recursively; 64 levels are ten times what glTF needs and a thousandth of the stack.
inline constexpr std::size_t kMaxJsonDepth = 64;

/// A parsed JSON value costs about 100 bytes, twice (ours and tinygltf's): at most 0.8 GB.
inline constexpr std::size_t kMaxJsonValues = 4'000'000;

/// tinygltf spends about 550 bytes on a node: 140 MiB. Instances cannot outnumber nodes.
inline constexpr std::size_t kMaxNodes = 262'144;
inline constexpr std::size_t kMaxNodeDepth = 256;

/// Meshes, accessors, materials, … each; primitives of one mesh.
inline constexpr std::size_t kMaxItems = 262'144;

/// 16 M triangles are what the topology analysis does in about 10 s on one slow core.
inline constexpr std::size_t kMaxTriangles = 16'000'000;

/// Morph targets of one mesh: faces of film characters have some hundred.
inline constexpr std::size_t kMaxTargets = 4096;

/// Vertices, indices, morph targets, keys and texels that stay in memory, and the expanded size of any one accessor.
inline constexpr std::size_t kMaxDecodedBytes = 512 * kMiB;

/// An accessor without a buffer view is zero wherever its sparse part says nothing. It stands beside other accessors of
/// the same count, which take at least a byte per element; so it may have as many elements as the file's buffers have
/// bytes, and these few more. Without this, 300 bytes of text make the loader fill half a gigabyte with zeros.
inline constexpr std::size_t kMaxUnbackedElements = 65'536;

inline constexpr std::uint32_t kMaxImageEdge_px = 8192;
/// One allocation of the image decoder: 8192² texels of 4 × 16 bit and one filter byte per row, with slack.
inline constexpr std::size_t kMaxImageAllocation = 544 * kMiB;

/// In mesh space a float still resolves 0.06 at 1e6; beyond it depth bias and normals lose their meaning.
inline constexpr float kMaxPosition_ms = 1.0e6f;
/// In world space: a hundred times the largest scene that the system promises to shadow (1e8 m).
inline constexpr double kMaxPosition_ws_m = 1.0e10;

/// A matrix counts as translation, rotation, scale if recomposing them is off by less than this, relative to its
/// longest column: exporters write floats (6e-8) after a few float products.
inline constexpr double kMatrixTolerance = 1.0e-5;

/// Warnings past this number are only counted.
inline constexpr std::size_t kMaxWarnings = 64;

}  // namespace gnomon::assets::gltf
