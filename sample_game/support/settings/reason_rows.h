#pragma once
#include <span>

#include "gnomon/reason.h"

/// What a person who meets a reason may want to know beside reason_text(): the states that it comes with, and a cure.
namespace gnomon::game {

struct ReasonRow {
    Reason reason;
    const char* states;  // names of LightState, or the part of a report that has it
    const char* cure;    // what to do; empty: nothing
};
/// Returns a row per reason, in the order of Reason.
std::span<const ReasonRow> reason_rows();

}  // namespace gnomon::game
