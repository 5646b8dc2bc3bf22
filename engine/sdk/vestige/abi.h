// SPDX-License-Identifier: Apache-2.0
// What crosses the boundary of a plugin library before anything else may.
#pragma once
#include <cstddef>
#include <cstdint>

/// Why create() refused; `input` is the schema row (of params) to blame, or -1; `entry` that of the
/// row's list, or -1.
extern "C" struct VestigeError {
  char text[512];
  int input;
  int entry;
};

/// The one symbol that a plugin library exports: `vestige_plugin`, of this plain-C type. The engine
/// checks magic, size, versions and tag before it touches another field, so a stranger's library is
/// refused with a reason, not a crash.
/// SDK 1: first release.   (each later version: one line saying what changed)
/// SDK 2: SurfacePoint has second derivatives; Host::note(); `lacks`, which derivatives are
/// missing; Light::usesSpread() and LightHit::spread; SceneView's texels() and usesFootprint();
/// Parameter::isNonlinear; Footprint::alongMajor.
/// SDK 3: SceneView::opacity(); lights are chosen by place: Light::extent(), chooseLight() and
/// lightChance() of a point.
/// SDK 4: SceneView's intersect() and shade() fill in place, so does lastSurface();
/// Light::isDrawn(); an InputBuffer is not initialised.
/// SDK 5: Brdf::matt(); SceneView::patchPoint(); Preparation has a time and warnings; Aovs of
/// elements; Integrator::usesJacobian().
/// SDK 6: PathRecord::saw().
/// SDK 7: Brdf::evaluate() in place of eval() and pdf(), diffuse() in place of matt(); ScatterPoint
/// has both refractive indices; batches; BRDFs, pigments and media inside other plugins; rays and
/// surfaces carry MediumStacks.
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
  void (*destroy)(void*);  ///< takes what create() gave [main thread]
  std::uint32_t lacks;     ///< bits, see below: derivatives left to finite differences
  const void* batch;       ///< of a BRDF: const BrdfBatch*; else null
};

namespace vestige {

inline constexpr std::uint64_t kPluginMagic = 0x3145474954534556;  ///< "VESTIGE1", little endian
inline constexpr std::uint32_t kSdkMajor = 7, kSdkMinor = 0;

/// Bits of VestigePlugin::lacks: methods that the plugin's class leaves as its interface has them.
inline constexpr std::uint32_t kLacksSampleDerivatives = 1, kLacksLogGradient = 2,
                               kLacksEmission = 4, kLacksEmissionDerivatives = 8, kLacksPdf = 16;
/// Those for which finite differences stand in.
inline constexpr std::uint32_t kLacksDerivatives =
    kLacksSampleDerivatives | kLacksLogGradient | kLacksEmissionDerivatives;

#define VESTIGE_TEXT_(x) #x
#define VESTIGE_TEXT(x) VESTIGE_TEXT_(x)

/// Compiler versions are left out on purpose: gcc and clang agree on all that is named here. The
/// SDK's version has fields of its own.
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
