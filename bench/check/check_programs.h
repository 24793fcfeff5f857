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
    std::size_t left_out = 0;           // by the selection
    std::vector<std::string> not_here;  // labels of those that need an extension which is not there;
                                        // nothing asks for them
    std::vector<ProgramFailure> failed;
    double took_s = 0.0;
};

/// Those that frames of the check's rows ask for, as a device without a GPU records them: of all outputs, and of the
/// widths that the rows have.
std::vector<gl::ProgramDesc> programs_of_rows();

/// Every program that a frame can ask for, each once, labels told apart where
/// two would have the same.
std::vector<gl::ProgramDesc> check_programs();

/// Whether this device cannot have it, and Gnomon does not ask for it there.
bool is_not_here(const gl::ProgramDesc& program, const gl::DeviceInfo& info);

/// Calls `use` on the calling thread with a device that only it uses, or not at
/// all if there can be none.
using OtherDevice = std::function<void(const std::function<void(gl::Device& device)>& use)>;

/// Makes and drops each, on the given device and on `others` more, a thread
/// each, which make their own by `other`.
ProgramChecks compile_programs(gl::Device& device, std::span<const gl::ProgramDesc> programs,
                               const CheckProgress& progress, unsigned others = 0, const OtherDevice& other = {});

}  // namespace gnomon::bench
