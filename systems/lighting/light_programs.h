#pragma once
#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/device.h"
#include "systems/retry.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// Output of a row's program.
/// - blended: what a light adds to blended surfaces, drawn forward
/// - catcher: what falls on shadow catchers, and what casters take of it, drawn forward
/// - lookups: the lookup, as a debug view shows it
/// - verdicts: what maps of sheets decide
/// - rays: what rays decide of the other pixels (RayList)
/// - kept, kept_visibility: picture and visibility from cached visibility (KeptVisibility)
/// - decided, decided_visibility: picture and visibility without pixels that take the row's filter long
/// - decided_middles, undecided_middles, crossed_areas: for EdgePass, visibility at the middle of these pixels and of
/// the
///   others, and of the areas that an edge crosses
/// - fog: what a light adds to a box of fog
/// - tint: colour that translucent casters let through
/// - found_middles: for EdgePass, visibility at the middles of all pixels, by rays
enum class ShaderPass : std::uint8_t {
    picture,
    visibility,
    blended,
    catcher,
    lookups,
    verdicts,
    rays,
    kept,
    kept_visibility,
    decided,
    decided_visibility,
    decided_middles,
    undecided_middles,
    crossed_areas,
    found_middles,
    tint,
    fog
};

/// Returns whether a row's program draws meshes, in place of passes over the picture.
inline bool is_forward(ShaderPass output) { return output == ShaderPass::blended || output == ShaderPass::catcher; }

/// Returns the row for a light without lookup: one per kind.
inline shadow::ShaderKey kept_row(const shadow::ShaderKey& row) {
    shadow::ShaderKey kept{row.kind_define, {}, {}};
    kept.tint = row.tint;
    return kept;
}

/// Programs of the lighting system, made on first use; one per (row, output, debug view). Owns them. A program that
/// failed is retried after Retry::kFrames; an essential one at every use, as no frame works without it. Finding an
/// existing program allocates nothing.
class LightPrograms {
public:
    explicit LightPrograms(gl::Device& device) : device_(device) {}
    ~LightPrograms();
    LightPrograms(const LightPrograms&) = delete;
    LightPrograms& operator=(const LightPrograms&) = delete;

    static constexpr std::uint32_t kNoLimit = ~0u;
    /// Starts a frame, the clock of retries. `most_rows`: number of programs that must_wait() allows in it.
    void next_frame(std::uint32_t most_rows = kNoLimit) {
        ++frame_;
        rows_left_ = most_rows;
    }

    /// Returns the row's program; {0} if it cannot be made.
    gl::ProgramHandle row(const shadow::ShaderKey& row, ShaderPass output) { return find_or_make(row, output, {}); }
    /// Returns true if row() would have to make the program and this frame's number is used up. Otherwise counts it.
    bool must_wait(const shadow::ShaderKey& row, ShaderPass output);
    /// Returns the program for the row's lookups in a debug view's shader, `fragment`; {0} if it cannot be made.
    gl::ProgramHandle lookups(const shadow::ShaderKey& row, std::string_view fragment) {
        return find_or_make(row, ShaderPass::lookups, fragment);
    }
    /// Sets whether surfaces may be unlit. Programs that add light to the picture then test each pixel.
    void set_some_unlit(bool some) { some_unlit_ = some; }
    /// Sets whether drawn meshes have vertex colours. Drops programs made for the other case.
    void set_coloured(bool coloured);
    /// Returns the program for surfaces. `places`: also writes exact positions, for rows with rays.
    gl::ProgramHandle surface(bool places = false);
    gl::ProgramHandle blended_base();
    /// Returns the programs for unlit surfaces; {0} if they cannot be made: the ones above then draw them.
    gl::ProgramHandle unlit_surface(bool places);
    gl::ProgramHandle unlit_blended();
    /// Returns the program that writes another renderer's surfaces as light passes read them.
    gl::ProgramHandle import_surfaces(bool multisampled, bool has_normals);
    /// Returns the program that marks pixels for EdgePass; {0} if it cannot be made.
    gl::ProgramHandle mark_edges();
    /// Returns the programs for shadow catchers: ambient light on the nearest ones, and their shares over the picture;
    /// {0} if they cannot be made.
    gl::ProgramHandle catcher_base();
    gl::ProgramHandle catcher_shares();
    /// Returns the program of what fog takes and scatters of the light from everywhere; {0} if it cannot be made.
    gl::ProgramHandle fog_base();
    gl::ProgramHandle luminance();
    /// Returns the program that writes the picture. `transparent`: without what is behind all surfaces.
    gl::ProgramHandle tonemap(bool transparent);
    gl::Failure failure() const { return failure_; }  // last program made

private:
    struct Entry {
        gl::ProgramHandle program{};
        Retry retry;
    };
    struct RowEntry {
        shadow::ShaderKey row;
        ShaderPass output;
        std::string_view fragment;  // for lookups
        bool some_unlit;
        Entry entry;
    };
    RowEntry& find_or_add(const shadow::ShaderKey& row, ShaderPass output, std::string_view fragment);
    gl::ProgramHandle find_or_make(const shadow::ShaderKey& row, ShaderPass output, std::string_view fragment);
    /// Makes a program that draws meshes into the picture, with vertex colours if set.
    void make_of_meshes(Entry& entry, const char* label, const char* fragment,
                        std::initializer_list<const char*> defines);
    bool is_due(const Entry& entry) const { return !entry.program && entry.retry.due(frame_); }
    void make(Entry& entry, const std::string& label, std::string_view vertex, std::string_view fragment,
              std::span<const std::string> defines, const shadow::ShaderKey* row);
    gl::ProgramHandle needed(Entry& entry, const char* label, const char* vertex, const char* fragment,
                             std::span<const std::string> defines = {});

    gl::Device& device_;
    std::vector<RowEntry> rows_;
    Entry surface_, surface_places_, blended_base_, luminance_, tonemap_;
    Entry tonemap_transparent_, catcher_base_, catcher_shares_, fog_base_;
    Entry unlit_surface_, unlit_surface_places_, unlit_blended_, mark_edges_;
    std::array<Entry, 4> imports_;  // bit 0: with samples, bit 1: with normals
    bool some_unlit_ = false;
    bool coloured_ = false;
    std::uint64_t frame_ = 0;
    std::uint32_t rows_left_ = kNoLimit;
    gl::Failure failure_ = gl::Failure::none;
};

}  // namespace gnomon::lighting
