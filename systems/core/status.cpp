#include <cstddef>
#include <iterator>

#include "gnomon/core.h"

namespace gnomon::core {
namespace {

struct Row {
    Status status;
    const char* code;
    const char* sentence;
};

/// Rows in the order of Status.
constexpr Row kRows[] = {
    {Status::fitted, "fitted", "The light has maps."},
    {Status::error_above_target, "error_above_target",
     "The light has the largest maps that it may have, and edges may still be off by more than max_error_px."},
    {Status::resolution_clamped, "resolution_clamped",
     "resolution_px is below 16 texels or above the device's limit: the nearest size is used."},
    {Status::cascades_clamped, "cascades_clamped", "More than 8 cascades were wanted: the light has 8."},
    {Status::splits_invalid, "splits_invalid",
     "split_m, split_lambda or blend lies outside its range: the defaults are used."},
    {Status::range_invalid, "range_invalid", "near_m and far_m are no range: the fitted one is used."},
    {Status::filter_cut, "filter_cut",
     "A number of the filter or of the light's source lies outside its range, or is too large for the map: it was "
     "cut."},
    {Status::depth_coarse, "depth_coarse",
     "Steps of the depth format are wider than texels of the map where receivers are: near contacts light leaks in."},
    {Status::off, "off", "The light is not enabled."},
    {Status::invalid_light, "invalid_light", "A number of the light is not finite or lies outside its range."},
    {Status::no_camera, "no_camera", "No usable camera was given."},
    {Status::no_visible_receiver, "no_visible_receiver", "No camera sees a receiver that the light reaches."},
    {Status::no_caster, "no_caster", "Nothing can darken a receiver that a camera sees."},
    {Status::fit_degenerate, "fit_degenerate", "What is seen spans no finite volume from the light."},
};

constexpr bool rows_are_in_order() {
    for (std::size_t i = 0; i < std::size(kRows); ++i)
        if (static_cast<std::size_t>(kRows[i].status) != i) return false;
    return true;
}
static_assert(rows_are_in_order());

const Row* row_of(Status status) {
    const auto index = static_cast<std::size_t>(status);
    return index < std::size(kRows) ? &kRows[index] : nullptr;
}

}  // namespace

const char* to_text(Status status) {
    const Row* row = row_of(status);
    return row ? row->code : "unknown";
}

const char* sentence(Status status) {
    const Row* row = row_of(status);
    return row ? row->sentence : "This is no status.";
}

}  // namespace gnomon::core
