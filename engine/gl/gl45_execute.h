#pragma once
#include "engine/gl/gl45_objects.h"
#include "engine/gl/gl45_readbacks.h"
#include "engine/gl/gl45_state.h"
#include "engine/gl/gl45_timers.h"
#include "engine/gl/gl45_uploads.h"

namespace gnomon::gl {

/// Keepers of results and memory that outlive a list.
struct ListServices {
    GlTimers& timers;
    GlReadbacks& readbacks;
    GlUploads& uploads;
};

/// Executes a list in a state that GlState defines and gives back. Returns OpenGL's error, or
/// invalid_value if it skipped misused commands.
Failure execute(const CommandList& list, std::uint64_t submission, const GlObjects& objects, GlState& state,
                const ListServices& services);

}  // namespace gnomon::gl
