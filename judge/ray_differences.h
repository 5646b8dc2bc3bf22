// SPDX-License-Identifier: Apache-2.0
// Compares derivatives of particles' and cameras' rays with finite differences.
#pragma once
#include <array>

#include "judge/trusted_difference.h"
#include "judge/verdict.h"

namespace vestige::judge {

inline constexpr double kRayStep = kDouble ? 1e-3 : 1e-2, kRayTolerance = kDouble ? 1e-6 : 4e-3;

inline std::string toldVectors(const std::string& what, Vec3 found, Vec3 expected) {
  std::ostringstream text;
  text.precision(9);
  text << what << " is " << found << ", expected " << expected;
  return text.str();
}

/// Result of a finite difference, and the error of the derivative in units of the tolerance.
struct Compared {
  Vec3 seen;
  double error;
};

/// Compares `found` with differences of a map from a Real to an optional Vec3 of magnitude `noise`;
/// nullopt if they are inconclusive.
template <class Map>
std::optional<Compared> compared(const Map& map, Vec3 found, double noise) {
  const double allowed = kRayTolerance * std::max({1.0, noise, sizeOf(found)});
  const auto seen = trustedDifference(map, kRayStep, allowed, std::max(noise, 0.1));
  if (!seen || hasFineBends(map, *seen, kRayStep, allowed, std::max(noise, 0.1)))
    return std::nullopt;
  return Compared{*seen, sizeOf(found - *seen) / allowed};
}

/// The same as an event of a finding.
template <class Map, class Describe>
void seeDifference(Finding& f, const Map& map, Vec3 found, double noise, const std::string& what,
                   const Describe& describe) {
  if (!isFinite(found)) {  // else no difference could be told from it
    f.worst.see(HUGE_VAL, [&] { return describe(what + " is not finite"); });
    return;
  }
  ++f.asked;
  const auto c = compared(map, found, noise);
  if (!c) return;
  ++f.judged;
  f.worst.see(c->error, [&] { return describe(toldVectors(what, found, c->seen)); });
}

}  // namespace vestige::judge
