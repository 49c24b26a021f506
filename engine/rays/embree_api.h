// Embree 3 or 4, whichever the build found, as the one that the engine is written for.
#pragma once

#if TARN_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace tarn {

// What a query hands through to filters, and how a query brings a filter of its own: Embree 3 has it in the
// context, Embree 4 in the arguments, and there asks to be told that it is to be called for every geometry.
#if RTC_VERSION_MAJOR >= 4

using EmbreeContext = RTCRayQueryContext;
inline constexpr RTCSceneFlags EMBREE_QUERY_FILTER = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void init_context(EmbreeContext& context) {
    rtcInitRayQueryContext(&context);
}

inline void intersect_one(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    arguments.filter = filter;
    if (filter != nullptr) {
        arguments.flags = RTCRayQueryFlags(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
    }
    rtcIntersect1(scene, &ray, &arguments);
}

inline void occlude_one(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    arguments.filter = filter;
    if (filter != nullptr) {
        arguments.flags = RTCRayQueryFlags(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
    }
    rtcOccluded1(scene, &ray, &arguments);
}

// Eight rays that run alike; `valid`: -1 for those that count, else 0.
inline void intersect_eight(const int* valid, RTCScene scene, EmbreeContext& context,
                            RTCFilterFunctionN filter, RTCRayHit8& rays) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    arguments.filter = filter;
    arguments.flags = RTCRayQueryFlags(arguments.flags | RTC_RAY_QUERY_FLAG_COHERENT);
    if (filter != nullptr) {
        arguments.flags = RTCRayQueryFlags(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
    }
    rtcIntersect8(valid, scene, &rays, &arguments);
}

#else

using EmbreeContext = RTCIntersectContext;
inline constexpr RTCSceneFlags EMBREE_QUERY_FILTER = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void init_context(EmbreeContext& context) {
    rtcInitIntersectContext(&context);
}

inline void intersect_one(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRayHit& ray) {
    context.filter = filter;
    rtcIntersect1(scene, &context, &ray);
}

inline void occlude_one(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRay& ray) {
    context.filter = filter;
    rtcOccluded1(scene, &context, &ray);
}

inline void intersect_eight(const int* valid, RTCScene scene, EmbreeContext& context,
                            RTCFilterFunctionN filter, RTCRayHit8& rays) {
    context.filter = filter;
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &context, &rays);
}

#endif

}  // namespace tarn
