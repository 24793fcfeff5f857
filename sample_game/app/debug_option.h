#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/frame.h"
#include "gnomon/result.h"

/// Debug views by name, for --debug and --list.
namespace gnomon::game {

/// Reads "NAME", "NAME:LIGHT" for views of a light, or "NAME:LIGHT:MAP" with the number of one of its maps.
/// Errors: rules "debug.view" (no such view), "debug.syntax".
Result<debug::Request> read_debug_request(std::string_view text);

/// Checks that `name`, given with `flag`, is among `lights`. Error: rule "debug.light".
std::optional<Error> check_shadowed_light(const char* flag, const std::string& name,
                                          const std::vector<std::string>& lights);

/// Checks that the light of `request`, if it names one, is among `lights`. Error: rule "debug.light".
std::optional<Error> check_debug_light(const debug::Request& request, const std::vector<std::string>& lights);

/// Returns the debug views as --list prints them.
std::string list_debug_views();

}  // namespace gnomon::game
