// SPDX-License-Identifier: BSD-3-Clause
// Embree 3 (Debian 12) and Embree 4 (Debian 13) as one interface. Only this file knows that there are two; CMake, too,
// takes 4 if it finds it.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace bubblesim::rays {

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
constexpr RTCSceneFlags kFilterOfQuery = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using EmbreeContext = RTCIntersectContext;
constexpr RTCSceneFlags kFilterOfQuery = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

/// What holds for all rays of a query.
struct EmbreeQuery {
  EmbreeContext context;                ///< must be first: callbacks get a pointer to it
  bool coherent = false;                ///< the rays are nearly parallel
  RTCFilterFunctionN filter = nullptr;  ///< rejects hits; in scenes with kFilterOfQuery

  EmbreeQuery() {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
#else
    rtcInitIntersectContext(&context);
#endif
  }
};

/// Shortens the rays that hit something, and sets their hits. `use`: a lane for each ray, 0 or -1; aligned to 64 bytes.
inline void intersect_packet(const int* use, RTCScene scene, EmbreeQuery& query, RTCRayHit16& packet) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.context;
  arguments.filter = query.filter;
  // Without the second flag the filter is not called, without a warning.
  arguments.flags =
      static_cast<RTCRayQueryFlags>((query.coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT) |
                                    (query.filter != nullptr ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : 0));
  rtcIntersect16(use, scene, &packet, &arguments);
#else
  query.context.flags = query.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  query.context.filter = query.filter;
  rtcIntersect16(use, scene, &query.context, &packet);
#endif
}

/// Sets tfar of the rays that hit something to -infinity. The query's filter is not called. Never coherent: with that
/// flag Embree may not return from a query for occlusion.
inline void occlude_packet(const int* use, RTCScene scene, EmbreeQuery& query, RTCRay16& rays) {
#if RTC_VERSION_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &query.context;
  rtcOccluded16(use, scene, &rays, &arguments);
#else
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  query.context.filter = nullptr;
  rtcOccluded16(use, scene, &query.context, &rays);
#endif
}

/// For a callback that reports a hit of ray `i`: the instance in which the query is.
inline void set_instance(RTCHitN* hits, unsigned count, unsigned i, const EmbreeContext& context) {
  RTCHitN_instID(hits, count, i, 0) = context.instID[0];
#ifdef RTC_GEOMETRY_INSTANCE_ARRAY
  RTCHitN_instPrimID(hits, count, i, 0) = context.instPrimID[0];
#endif
}

}  // namespace bubblesim::rays
