#pragma once
#include "systems/truth/metrics.h"

/// The figures are the library's own; the oracle's truth is what they are taken from here.
namespace gnomon::oracle {

using truth::compare;
using truth::ComparedPictures;
using truth::EdgeDisplacement;
using truth::kEdgeBandPx;
using truth::kEdgeSearchPx;
using truth::Metrics;

}  // namespace gnomon::oracle
