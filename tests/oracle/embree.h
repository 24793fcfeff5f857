#pragma once
/// Debian 12 has Embree 3, newer systems Embree 4; they differ in how a query is passed, which ends here.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace gnomon::oracle {

#if RTC_VERSION_MAJOR >= 4

using QueryContext = RTCRayQueryContext;

inline void init_query(QueryContext& context) { rtcInitRayQueryContext(&context); }

inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &ray, &arguments);
}

inline void occlude(RTCScene scene, QueryContext& context, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
}

#else

using QueryContext = RTCIntersectContext;

inline void init_query(QueryContext& context) { rtcInitIntersectContext(&context); }
inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray) { rtcIntersect1(scene, &context, &ray); }
inline void occlude(RTCScene scene, QueryContext& context, RTCRay& ray) { rtcOccluded1(scene, &context, &ray); }

#endif

}  // namespace gnomon::oracle
