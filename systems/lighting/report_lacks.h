#pragma once
#include "systems/report.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// What keeps a light from being drawn by its own row.
struct Lack {
    Reason reason = Reason::none;
    bool unshadowed = false;  // it is drawn without its shadow, or not at all; else by one tap of its map
};

/// Makes the light's report say what is drawn instead: `plain` is what that one tap comes to. Of several pictures, in
/// one of which something lacks, it says what of that one is so.
void report_lack(const Lack& lack, const shadow::LookupAccuracy& plain, LightReport& report);

/// The same of blended surfaces alone: on all others its shadow is what the report says already.
void report_blended_lack(const Lack& lack, const shadow::LookupAccuracy& plain, LightReport& report);

}  // namespace gnomon::lighting
