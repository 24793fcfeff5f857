#pragma once

/// Zones for a profiler of the engine's choice. GNOMON_ZONE(name) marks the rest of a block; `name` is a string literal.
/// Without a profiler it does nothing. Build with `cmake -D GNOMON_ZONE_HEADER=my_zones.h` to have zones: that header
/// defines the macro. For Tracy it is `#define GNOMON_ZONE(name) ZoneScopedN(name)`.
#ifdef GNOMON_ZONE_HEADER
#include GNOMON_ZONE_HEADER
#endif
#ifndef GNOMON_ZONE
#define GNOMON_ZONE(name) static_cast<void>(0)
#endif
