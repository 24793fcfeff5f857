#pragma once

/// All of Gnomon's public headers. Each also stands alone.
#include "gnomon/assets.h"
#include "gnomon/box.h"
#include "gnomon/components.h"
#include "gnomon/core.h"
#include "gnomon/entt.h"
#include "gnomon/frame.h"
#include "gnomon/light.h"
#include "gnomon/reason.h"
#include "gnomon/registry.h"
#include "gnomon/result.h"
#include "gnomon/shadow_tuning.h"
#include "gnomon/shadows.h"
#include "gnomon/version.h"
#include "gnomon/window.h"
