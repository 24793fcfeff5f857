#pragma once
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/traced_world.h"

namespace gnomon::oracle {

struct ReferenceTracer::World {
    TracedWorld traced;
    unsigned threads;
};

}  // namespace gnomon::oracle
