#pragma once
#include "systems/report.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// Reason why a light is not drawn by its own row.
struct Lack {
    Reason reason = Reason::none;
    bool unshadowed = false;  // drawn without its shadow, or not at all; false: by one tap of its map
};

/// Makes the light's report describe the substitute. `plain`: accuracy of one tap. With several pictures, the report
/// describes one with a lack.
void report_lack(const Lack& lack, const shadow::LookupAccuracy& plain, LightReport& report);

/// Makes the report describe a lack for blended surfaces only; the shadow on others is as reported already.
void report_blended_lack(const Lack& lack, const shadow::LookupAccuracy& plain, LightReport& report);

}  // namespace gnomon::lighting
