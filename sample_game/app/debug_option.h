#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "systems/debug/debug_view.h"

/// Debug views by name, for --debug and --list.
namespace gnomon::game {

/// "NAME", or of views of a light "NAME:LIGHT", or "NAME:LIGHT:MAP" with a number for one of its maps.
/// Errors: rules "debug.view" (no such view), "debug.syntax".
Result<debug::Request> read_debug_request(std::string_view text);

/// Error: rule "debug.light", if `name`, given with `flag`, is not among `lights`.
std::optional<Error> check_shadowed_light(const char* flag, const std::string& name,
                                          const std::vector<std::string>& lights);

/// The same, if `request` names a light that is not among `lights`.
std::optional<Error> check_debug_light(const debug::Request& request, const std::vector<std::string>& lights);

/// What --list prints of them.
std::string list_debug_views();

}  // namespace gnomon::game
