#pragma once
#include <filesystem>
#include <functional>
#include <vector>

#include "bench/audit/audit.h"
#include "bench/common/stage.h"

namespace gnomon::bench {

struct AuditCommand {
    StageOptions stage;                         // its camera alone, if one is named; else each of a scene's
    std::vector<std::filesystem::path> scenes;  // empty: the built-in ones; with a camera the courtyard
    std::function<void(const Audit& audit)> on_audit = [](const Audit&) {};  // as each picture is done
};

/// Audits every picture of every scene. Errors: those of Stage::open and audit_frame().
Result<std::vector<Audit>> run_audit(const AuditCommand& command);

}  // namespace gnomon::bench
