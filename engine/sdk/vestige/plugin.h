// SPDX-License-Identifier: Apache-2.0
// The one macro of the project: it exports a class as a plugin.
//
//     class Phong final : public vestige::Brdf {
//      public:
//       static Schema schema();            // what the scene language accepts
//       Phong();                           // or Phong(const Values&), or Phong(const Values&,
//       Host&)
//       ...
//     };
//     VESTIGE_PLUGIN(vestige::Brdf, vestige::Phong)
//
// A constructor refuses its parameters by throwing PluginError; nothing else may throw later.
#pragma once
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <type_traits>

#include <vestige/abi.h>
#include <vestige/batch.h>
#include <vestige/host.h>

namespace vestige {

/// Thrown by a plugin's constructor: the message for the user and the row of Schema::params that is
/// to blame (-1: the block as a whole), with the entry of its list (-1: the list as a whole).
class PluginError : public std::runtime_error {
 public:
  PluginError(int input, const std::string& message) : PluginError(input, -1, message) {}
  PluginError(int input, int entry, const std::string& message)
      : std::runtime_error(message), input_(input), entry_(entry) {}
  int input() const noexcept { return input_; }
  int entry() const noexcept { return entry_; }

 private:
  int input_, entry_;
};

namespace detail {

template <class Class>
Class* construct(const Values& values, Host& host) {
  if constexpr (std::is_constructible_v<Class, const Values&, Host&>)
    return new Class(values, host);
  else if constexpr (std::is_constructible_v<Class, const Values&>)
    return new Class(values);
  else
    return new Class();
}

template <class Interface, class Class>
void* create(const void* values, void* host, VestigeError* error) {
  const auto refuse = [&](const char* why, int input, int entry = -1) {
    std::snprintf(error->text, sizeof error->text, "%s", why);
    error->input = input;
    error->entry = entry;
    return nullptr;
  };
  try {
    Interface* made =
        construct<Class>(*static_cast<const Values*>(values), *static_cast<Host*>(host));
    return made;
  } catch (const PluginError& e) {
    return refuse(e.what(), e.input(), e.entry());
  } catch (const std::exception& e) {
    return refuse(e.what(), -1);
  } catch (...) {
    return refuse("unknown failure", -1);
  }
}

/// The methods that Class does not override: the type of the member then names the interface. A
/// member that cannot be named here is hidden by Class, so it is overridden. A base class between
/// the two may have its own default; it defines Class::Differences as itself.
template <class Interface, class Class>
constexpr std::uint32_t lacks() {
  std::uint32_t bits = 0;
  if constexpr (requires {
                  requires std::is_same_v<decltype(&Class::sampleDerivatives),
                                          decltype(&Interface::sampleDerivatives)>;
                })
    bits |= kLacksSampleDerivatives;
  if constexpr (requires {
                  requires std::is_same_v<decltype(&Class::logGradient),
                                          decltype(&Interface::logGradient)>;
                })
    bits |= kLacksLogGradient;
  if constexpr (requires {
                  requires std::is_same_v<decltype(&Class::logIntensityGradient),
                                          decltype(&Class::Differences::logIntensityGradient)>;
                })
    bits |= kLacksLogGradient;
  if constexpr (requires {
                  requires std::is_same_v<decltype(&Class::logRadianceGradient),
                                          decltype(&Class::Differences::logRadianceGradient)>;
                })
    bits |= kLacksLogGradient;
  if constexpr (requires {
                  requires std::is_same_v<decltype(&Class::emit), decltype(&Interface::emit)>;
                })
    bits |= kLacksEmission;
  else if constexpr (requires {
                       requires std::is_same_v<decltype(&Class::emissionDerivatives),
                                               decltype(&Interface::emissionDerivatives)>;
                     })
    bits |= kLacksEmissionDerivatives;
  // Cameras only: other interfaces have no default pdf().
  if constexpr (requires {
                  requires std::is_same_v<decltype(&Class::pdf),
                                          Real (Interface::*)(Vec3, Vec3, Real) const noexcept>;
                })
    bits |= kLacksPdf;
  return bits;
}

/// See VestigePlugin::batch.
template <class Interface, class Class>
constexpr const void* batchOf() {
  if constexpr (std::is_same_v<Interface, Brdf>)
    return &kBrdfBatch<Class>;
  else
    return nullptr;
}

template <class Class>
const Schema& schemaOf() {
  static const Schema schema = Class::schema();
  return schema;
}

}  // namespace detail
}  // namespace vestige

/// `Class::schema()` names kind and word; the version is the SDK's unless VESTIGE_PLUGIN_VERSION is
/// defined before.
#define VESTIGE_PLUGIN(Interface, Class)                                                \
  extern "C" __attribute__((visibility("default"))) const VestigePlugin vestige_plugin; \
  extern "C" const VestigePlugin vestige_plugin = {                                     \
      ::vestige::kPluginMagic,                                                          \
      sizeof(VestigePlugin),                                                            \
      ::vestige::kSdkMajor,                                                             \
      ::vestige::kSdkMinor,                                                             \
      ::vestige::kAbiTag,                                                               \
      ::vestige::detail::schemaOf<Class>().kind.c_str(),                                \
      ::vestige::detail::schemaOf<Class>().name.c_str(),                                \
      VESTIGE_PLUGIN_VERSION,                                                           \
      []() -> const void* { return &::vestige::detail::schemaOf<Class>(); },            \
      &::vestige::detail::create<Interface, Class>,                                     \
      [](void* made) { delete static_cast<Interface*>(made); },                         \
      ::vestige::detail::lacks<Interface, Class>(),                                     \
      ::vestige::detail::batchOf<Interface, Class>()};

#ifndef VESTIGE_PLUGIN_VERSION
#define VESTIGE_PLUGIN_VERSION "1.0"
#endif
