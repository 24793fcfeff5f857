#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/check/check_progress.h"
#include "engine/gl/device.h"

namespace gnomon::bench {

struct ProgramFailure {
    std::string label, log;  // the driver's own words, all lines
};

struct ProgramChecks {
    std::size_t all = 0;                // that there are
    std::size_t compiled = 0;           // and linked
    std::size_t left_out = 0;           // number that the selection leaves out
    std::vector<std::string> not_here;  // labels of programs that need a missing extension;
                                        // no frame uses them here
    std::vector<ProgramFailure> failed;
    double took_s = 0.0;
};

/// Returns the programs that frames of the check's rows use, for all outputs and the rows' widths. A device without a
/// GPU records them.
std::vector<gl::ProgramDesc> programs_of_rows();

/// Returns every program that a frame can use, each once, with distinct labels.
std::vector<gl::ProgramDesc> check_programs();

/// Returns whether this device cannot have a program, so that no frame uses it.
bool is_not_here(const gl::ProgramDesc& program, const gl::DeviceInfo& info);

/// Calls `use` on the calling thread with a device that only it uses, or not at
/// all if there can be none.
using OtherDevice = std::function<void(const std::function<void(gl::Device& device)>& use)>;

/// Makes and drops each, on the given device and on `others` more, a thread
/// each, which make their own by `other`.
ProgramChecks compile_programs(gl::Device& device, std::span<const gl::ProgramDesc> programs,
                               const CheckProgress& progress, unsigned others = 0, const OtherDevice& other = {});

}  // namespace gnomon::bench
