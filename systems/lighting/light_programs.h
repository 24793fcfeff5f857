#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/device.h"
#include "systems/retry.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// What a program of a row writes; lookups: what a debug view shows of them.
/// verdicts: what maps of sheets are certain of; rays: what rays find of the others (RayList). kept, kept_visibility:
/// the picture, or the visibility, by what pixels saw in an earlier frame (KeptVisibility). decided: the picture but
/// for pixels that the row's filter takes long for.
enum class RowOutput : std::uint8_t {
    picture,
    visibility,
    blended,
    lookups,
    verdicts,
    rays,
    kept,
    kept_visibility,
    decided
};

/// A light that is not looked up: one row per kind.
inline shadow::ProgramRow kept_row(const shadow::ProgramRow& row) { return {row.kind_define, {}, {}}; }

/// Programs of the lighting system, made when first called for; one per (row, output, debug view). Owns them.
/// One that could not be made is tried again after Retry::kFrames; one that no picture can do without, whenever it is
/// called for: there is no frame to be spared. Finding one that exists allocates nothing.
class LightPrograms {
public:
    explicit LightPrograms(gl::Device& device) : device_(device) {}
    ~LightPrograms();
    LightPrograms(const LightPrograms&) = delete;
    LightPrograms& operator=(const LightPrograms&) = delete;

    static constexpr std::uint32_t kNoLimit = ~0u;
    /// To be called once a frame: the clock of the retries. `most_rows`: must_wait() lets so many be made in it.
    void next_frame(std::uint32_t most_rows = kNoLimit) {
        ++frame_;
        rows_left_ = most_rows;
    }

    /// {0} if it cannot be made.
    gl::ProgramHandle row(const shadow::ProgramRow& row, RowOutput output) { return find_or_make(row, output, {}); }
    /// Whether row() would have to make it and this frame's share is used up. If it is not, that is taken from it.
    bool must_wait(const shadow::ProgramRow& row, RowOutput output);
    /// The row's lookups as `fragment`, a debug view's shader, shows them. {0} if it cannot be made.
    gl::ProgramHandle lookups(const shadow::ProgramRow& row, std::string_view fragment) {
        return find_or_make(row, RowOutput::lookups, fragment);
    }
    /// Whether surfaces may be unlit: programs that add light to the picture then ask each pixel for it, others need
    /// not.
    void set_some_unlit(bool some) { some_unlit_ = some; }
    /// Whether what is drawn by meshes, surfaces and blended ones, has vertices with colours. Drops those programs if
    /// that is not what they were made for.
    void set_coloured(bool coloured);
    /// `places`: writes also where exactly surfaces are, for rows that ask by rays.
    gl::ProgramHandle surface(bool places = false);
    gl::ProgramHandle blended_base();
    /// The same for what is unlit; {0} if they cannot be made: it is then drawn by those above.
    gl::ProgramHandle unlit_surface(bool places);
    gl::ProgramHandle unlit_blended();
    gl::ProgramHandle luminance();
    gl::ProgramHandle tonemap();
    gl::Failure failure() const { return failure_; }  // of the last creation

private:
    struct Entry {
        gl::ProgramHandle program{};
        Retry retry;
    };
    struct RowEntry {
        shadow::ProgramRow row;
        RowOutput output;
        std::string_view fragment;  // of lookups
        bool some_unlit;
        Entry entry;
    };
    RowEntry& find_or_add(const shadow::ProgramRow& row, RowOutput output, std::string_view fragment);
    gl::ProgramHandle find_or_make(const shadow::ProgramRow& row, RowOutput output, std::string_view fragment);
    /// A program that draws meshes into the picture; with their vertices' colours where those are set.
    void make_of_meshes(Entry& entry, const char* label, const char* fragment,
                        std::initializer_list<const char*> defines);
    bool is_due(const Entry& entry) const { return !entry.program && entry.retry.due(frame_); }
    void make(Entry& entry, const std::string& label, std::string_view vertex, std::string_view fragment,
              std::span<const std::string> defines, const shadow::ProgramRow* row);
    gl::ProgramHandle needed(Entry& entry, const char* label, const char* vertex, const char* fragment,
                             std::span<const std::string> defines = {});

    gl::Device& device_;
    std::vector<RowEntry> rows_;
    Entry surface_, surface_places_, blended_base_, luminance_, tonemap_;
    Entry unlit_surface_, unlit_surface_places_, unlit_blended_;
    bool some_unlit_ = false;
    bool coloured_ = false;
    std::uint64_t frame_ = 0;
    std::uint32_t rows_left_ = kNoLimit;
    gl::Failure failure_ = gl::Failure::none;
};

}  // namespace gnomon::lighting
