// SPDX-License-Identifier: Apache-2.0
// The plain-C description that every plugin library exports, checked before anything else is used.
#pragma once
#include <cstddef>
#include <cstdint>

/// The reason why create() failed. `input` is the index of the offending row of Schema::params, or
/// -1; `entry` is the index in that row's list, or -1.
extern "C" struct VestigeError {
  char text[512];
  int input;
  int entry;
};

/// The one symbol that a plugin library exports: `vestige_plugin`, of this plain-C type. The engine
/// checks magic, size, versions and tag before it touches another field: an incompatible library is
/// refused with a reason instead of crashing. What each version changed:
///   * SDK 1: first release.
///   * SDK 2: SurfacePoint has second derivatives; Host::note(); `lacks`, the derivatives that are
///     missing; Light::usesSpread() and LightHit::spread; SceneView's texels() and usesFootprint();
///     Parameter::isNonlinear; Footprint::alongMajor.
///   * SDK 3: SceneView::opacity(); lights are chosen by place: Light::extent(), chooseLight() and
///     lightChance() of a point.
///   * SDK 4: SceneView's intersect() and shade() fill in place, so does lastSurface();
///     Light::isDrawn(); an InputBuffer is not initialised.
///   * SDK 5: Brdf::matt(), diffuse() since SDK 7; SceneView::patchPoint(); Preparation has a time
///     and warnings; AOVs of elements; Integrator::usesJacobian().
///   * SDK 6: PathRecord::saw().
///   * SDK 7: see docs/abi.md, which has a table for authors of older plugins.
extern "C" struct VestigePlugin {
  std::uint64_t magic;      ///< spells "VESTIGE1"
  std::uint32_t size;       ///< bytes, as the plugin saw it; fields are only ever appended
  std::uint32_t sdkMajor;   ///< must equal the engine's: a virtual table changed
  std::uint32_t sdkMinor;   ///< must not exceed the engine's: something was added
  const char* abiTag;       ///< must equal the engine's: standard library ABI, sizes, Real, build
  const char* kind;         ///< "brdf", "light", "camera", ...: picks the interface
  const char* name;         ///< the word in the scene language
  const char* version;      ///< the plugin's own
  const void* (*schema)();  ///< const Schema*; static, readable without an object [any thread]
  /// const Values*, Host*; null: see error [main thread]
  void* (*create)(const void* values, void* host, VestigeError* error);
  void (*destroy)(void*);  ///< destroys an object made by create() [main thread]
  std::uint32_t lacks;     ///< bits, see below: derivatives left to finite differences
  const void* batch;       ///< of a BRDF: const BrdfBatch*; else null
};

namespace vestige {

inline constexpr std::uint64_t kPluginMagic = 0x3145474954534556;  ///< "VESTIGE1", little endian
inline constexpr std::uint32_t kSdkMajor = 7, kSdkMinor = 0;

/// Bits of VestigePlugin::lacks: methods that the plugin's class does not override.
inline constexpr std::uint32_t kLacksSampleDerivatives = 1, kLacksLogGradient = 2,
                               kLacksEmission = 4, kLacksEmissionDerivatives = 8, kLacksPdf = 16;
/// The bits for which the engine substitutes finite differences.
inline constexpr std::uint32_t kLacksDerivatives =
    kLacksSampleDerivatives | kLacksLogGradient | kLacksEmissionDerivatives;

#define VESTIGE_TEXT_(x) #x
#define VESTIGE_TEXT(x) VESTIGE_TEXT_(x)

/// Compiler versions are omitted on purpose: gcc and clang are compatible if the tag is equal. The
/// SDK's version has its own fields.
inline constexpr const char* kAbiTag =
#if defined(_LIBCPP_VERSION)
    "libc++"
#else
    "libstdc++ cxx11abi=" VESTIGE_TEXT(_GLIBCXX_USE_CXX11_ABI)
#endif
#if defined(_GLIBCXX_DEBUG)
    " debug-containers"
#endif
#if defined(VESTIGE_DOUBLE)
    " real=double"
#else
        " real=float"
#endif
    " pointer=" VESTIGE_TEXT(__SIZEOF_POINTER__);

}  // namespace vestige
