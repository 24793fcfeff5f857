#pragma once
#include <array>
#include <utility>
#include <vector>

#include "tests/gl/device_fixture.h"

namespace gnomon {

/// Vertex of the layout "mesh".
struct MeshVertex {
    std::array<float, 3> position;
    std::array<float, 3> normal;
    std::array<float, 2> uv;
};

/// A quad, and a program that draws it into the cell that a draw item names, in the colour of its value.
class DeviceMeshes : public DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (HasFatalFailure()) return;
        // Before the quad, so that base_vertex must step over it.
        std::vector<MeshVertex> corners(1, MeshVertex{{9, 9, 9}, {}, {}});
        for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {-1.0f, 1.0f}, {1.0f, 1.0f}}) {
            corners.push_back({{x, y, 0.5f}, {0.25f, 0.5f, 0.75f}, {1.0f, 0.0f}});
        }
        vertices = fixed_buffer(corners);
        indices = fixed_buffer(std::vector<std::uint32_t>{99, 99, 99, 0, 1, 2, 2, 1, 3});
        program = keep(device().create_program(
            {"meshes",
             "#version 450 core\n"
             "layout(location = 0) in vec3 position;\nlayout(location = 1) in vec3 normal;\n"
             "layout(location = 2) in vec2 uv;\nlayout(location = 3) in uvec2 item;\n"
             "layout(location = 0) flat out vec4 colour;\n"
             "void main() {\n"
             "  gl_Position = vec4(position.xy * 0.125 + vec2(-0.875 + 0.25 * float(item.x), -0.875), 0.5, 1.0);\n"
             "  colour = vec4(float(item.y) / 255.0, normal.y, uv.x, 1.0);\n}\n",
             "#version 450 core\nlayout(location = 0) flat in vec4 colour;\nlayout(location = 0) out vec4 result;\n"
             "void main() { result = colour; }\n"}));
    }
    gl::BufferHandle vertices, indices;
    gl::ProgramHandle program;
};

}  // namespace gnomon
