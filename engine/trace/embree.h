// SPDX-License-Identifier: Apache-2.0
// Embree 3 or 4, whichever is installed, behind the few calls that we make. Included by
// engine/trace/*.cpp only.
#pragma once
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace vestige::embree {

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
inline void initialise(Context& context) noexcept { rtcInitRayQueryContext(&context); }
inline void intersect(RTCScene scene, RTCRayHit& ray, Context& context) noexcept {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}
inline void occluded(RTCScene scene, RTCRay& ray, Context& context) noexcept {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using Context = RTCIntersectContext;
inline void initialise(Context& context) noexcept { rtcInitIntersectContext(&context); }
inline void intersect(RTCScene scene, RTCRayHit& ray, Context& context) noexcept {
  rtcIntersect1(scene, &context, &ray);
}
inline void occluded(RTCScene scene, RTCRay& ray, Context& context) noexcept {
  rtcOccluded1(scene, &context, &ray);
}
#endif

struct Release {
  void operator()(RTCDevice d) const noexcept { rtcReleaseDevice(d); }
  void operator()(RTCScene s) const noexcept { rtcReleaseScene(s); }
  void operator()(RTCGeometry g) const noexcept { rtcReleaseGeometry(g); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;
using Device = Owned<RTCDevice>;
using Scene = Owned<RTCScene>;
using Geometry = Owned<RTCGeometry>;

/// Throws if a call on this device has failed since the last check.
inline void check(RTCDevice device, const char* doing) {
  const char* reason = nullptr;
  switch (rtcGetDeviceError(device)) {
    case RTC_ERROR_NONE:
      return;
    case RTC_ERROR_OUT_OF_MEMORY:
      reason = "out of memory";
      break;
    case RTC_ERROR_UNSUPPORTED_CPU:
      reason = "this processor is not supported";
      break;
    case RTC_ERROR_INVALID_ARGUMENT:
      reason = "invalid argument";
      break;
    case RTC_ERROR_INVALID_OPERATION:
      reason = "invalid operation";
      break;
    case RTC_ERROR_CANCELLED:
      reason = "cancelled";
      break;
    default:
      reason = "unknown error";
      break;
  }
  throw std::runtime_error(std::string("Embree failed while ") + doing + ": " + reason);
}

/// Never with `threads=`: that limits every user of the task scheduler in the process.
inline Device newDevice() {
  Device device(rtcNewDevice(nullptr));
  check(device.get(), "starting");
  if (!device) throw std::runtime_error("Embree failed while starting: unknown error");
  return device;
}

}  // namespace vestige::embree
