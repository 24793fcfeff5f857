#include <epoxy/gl.h>
#include <imgui.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sample_game/gui/imgui_renderer.h"
#include "tests/gl/failing_gl.h"
#include "tests/gl/gl_test_context.h"

// Panels over a picture where memory is short: the game goes on without them, and draws them again later.
namespace gnomon {
namespace {

constexpr glm::uvec2 kSize_px{64, 48};
constexpr std::uint64_t kFirst = 0;

class OverlayTest : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        imgui_.reset(ImGui::CreateContext());
        ImGui::SetCurrentContext(imgui_.get());
        ImGui::GetIO().IniFilename = nullptr;
        const std::vector<std::uint8_t> black(std::size_t{4} * kSize_px.x * kSize_px.y, 0);
        picture_ = game::make_image("picture", kSize_px, black.data(), true);
        ASSERT_NE(picture_, 0u);
    }
    void TearDown() override {
        game::destroy_image(picture_);
        imgui_.reset();
        GlTest::TearDown();
    }

    /// Draws a white rectangle over the left half of the picture. Returns the number of pixels that are not black.
    std::size_t white_after(game::Overlay& overlay) {
        ImGui::GetIO().DisplaySize = {float(kSize_px.x), float(kSize_px.y)};
        ImGui::NewFrame();
        ImGui::GetBackgroundDrawList()->AddRectFilled({0.0f, 0.0f}, {0.5f * float(kSize_px.x), float(kSize_px.y)},
                                                      IM_COL32_WHITE);
        ImGui::Render();
        overlay.draw(*ImGui::GetDrawData(), picture_, kSize_px);
        std::vector<std::array<std::uint8_t, 4>> texels(std::size_t{kSize_px.x} * kSize_px.y);
        glGetTextureImage(picture_, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(4 * texels.size()), texels.data());
        std::size_t white = 0;
        for (const auto& texel : texels) white += texel[0] > 0;
        return white;
    }

    struct EndContext {
        void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
    };
    std::unique_ptr<ImGuiContext, EndContext> imgui_;
    unsigned picture_ = 0;
};

TEST_F(OverlayTest, IsNotMadeWithoutMemoryOrAProgramAndLeavesNothing) {
    ASSERT_TRUE(game::Overlay::create()) << "the control: nothing fails";
    FailingGl failing;
    for (const GlFault fault : {GlFault::out_of_memory, GlFault::link_failed}) {
        const std::int64_t before = failing.live_names();
        failing.begin(fault, kFirst, false);
        const auto made = game::Overlay::create();
        failing.end();
        ASSERT_FALSE(made) << to_text(fault);
        EXPECT_EQ(made.error().rule, "gui.device");
        EXPECT_EQ(failing.live_names(), before) << to_text(fault);
    }
}

TEST_F(OverlayTest, LeavesAFrameOutWithoutMemoryForItAndDrawsTheNext) {
    auto made = game::Overlay::create();
    ASSERT_TRUE(made);
    game::Overlay& overlay = *made.value();
    {
        FailingGl failing;
        for (const std::uint64_t buffer : {0u, 1u}) {
            failing.begin(GlFault::out_of_memory, buffer, false);
            EXPECT_EQ(white_after(overlay), 0u) << "buffer " << buffer;
            failing.end();
        }
    }
    EXPECT_EQ(white_after(overlay), std::size_t{kSize_px.x} * kSize_px.y / 2);
}

TEST_F(OverlayTest, AnImageWithoutMemoryIsNone) {
    FailingGl failing;
    const std::int64_t before = failing.live_names();
    failing.begin(GlFault::out_of_memory, kFirst, false);
    EXPECT_EQ(game::make_image("none", kSize_px, nullptr, true), 0u);
    failing.end();
    EXPECT_EQ(failing.live_names(), before);
}

}  // namespace
}  // namespace gnomon
