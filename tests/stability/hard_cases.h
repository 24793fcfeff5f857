#pragma once
#include <ostream>
#include <span>

#include "tests/stability/hard_cases_world.h"

/// The situations in which shadow maps are known to break, one row each.
namespace gnomon::hard {

/// How a picture of the case is judged against ray-traced truth.
enum class OnGpu {
    no,        // nothing to see, or seen by the check alone
    right,     // few wrong pixels, and none away from an edge
    too_thin,  // what casts may be lost, and that is counted as such, but nothing else is wrong
};

struct HardCase {
    const char* name;    // letters and underscores
    const char* breaks;  // what is known to go wrong
    /// Fills the world. What must be true of any frame (hard_cases_oracle.h) is then judged. Null: no world of its own.
    void (*build)(World&);
    /// Checks what must also be true of this case; may build worlds of its own. Null: nothing.
    void (*check)() = nullptr;
    OnGpu on_gpu = OnGpu::no;
};

inline void PrintTo(const HardCase& row, std::ostream* out) { *out << row.name << ": " << row.breaks; }

/// Returns all rows: light_cases(), camera_cases(), mesh_cases().
std::span<const HardCase> hard_cases();

/// Returns the rows about lights and their projections; about cameras; about casters and receivers.
std::span<const HardCase> light_cases();
std::span<const HardCase> camera_cases();
std::span<const HardCase> mesh_cases();

/// Runs the stages once and expects the oracle to agree. Returns how many points it judged; `darkened`, if given, how
/// many of them lie in shadow.
std::size_t expect_sound(World& world, const char* what, std::size_t* darkened = nullptr);
/// Expects the oracle to agree with the frame that was run last.
std::size_t expect_sound(const Stages& stages, const char* what, std::size_t* darkened = nullptr);

}  // namespace gnomon::hard
