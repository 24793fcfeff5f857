#pragma once

/// All of Gnomon's public headers. Each also stands alone.
#include "gnomon/core.h"
#include "gnomon/entt.h"
#include "gnomon/reason.h"
#include "gnomon/shadows.h"
#include "gnomon/version.h"
#include "gnomon/window.h"
