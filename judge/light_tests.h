// SPDX-License-Identifier: Apache-2.0
// Tests of the contract in light.h. As for BRDFs, sample(), pdf() and sampleDerivatives() are three
// statements about one map; emit(), power() and the irradiance by sample() are three statements
// about one flux.
#pragma once
#include <vestige/light.h>

#include "judge/differences.h"
#include "judge/made.h"
#include "judge/plain.h"
#include "judge/trusted_difference.h"
#include "judge/verdict.h"

namespace vestige::judge {

/// A light in a scene with the bounds kLightScene.
struct LightCase {
  std::string title;  ///< "light spot falloff 40"
  std::shared_ptr<const Light> light;
  bool emits = true;  ///< the plugin has an emit()
};
using LightCases = std::vector<LightCase>;

inline const Bounds kLightScene = {{-1, -2, -1}, {2, 1, 1}};

/// Random values for every row that plainValue() has one for.
LightCases lightCases(const Plugin& plugin, int sets, unsigned seed, TriedRows* rows = nullptr);

Event lightEvent(const LightCase& c, const Receiver& from, Vec2 u, const std::string& what);

/// A receiver on a surface with some normal, or in a volume.
inline Receiver receiverAt(Vec3 position, int event) {
  if (event % 3 == 0) return {position};
  const double a = 2.4 * event, z = 1 - 2 * std::fmod(0.618 * event, 1.0), s = std::sqrt(1 - z * z);
  return {position, normalize(Vec3{Real(s * std::cos(a)), Real(s * std::sin(a)), Real(z)})};
}

/// Random events: f(case, from, u, random).
template <class F>
void forLightEvents(const LightCases& cases, const Effort& effort, const F& f) {
  Random r(effort.seed);
  for (const LightCase& c : cases)
    for (int i = 0; i < effort.events(); ++i) {
      const Receiver from = receiverAt(r.point(-3, 3), i);
      f(c, from, r.pair(), r);
    }
}

// light_density.cpp
struct LightDensityFindings {
  Finding distribution, mass, ownPdf, ownRadiance;
};
LightDensityFindings lightSamplesFollowPdf(const LightCases& cases, const Effort& effort);

// light_derivatives.cpp
Finding lightAreaIsInverseDensity(const LightCases& cases, const Effort& effort);
Finding lightDuIsTheDerivative(const LightCases& cases, const Effort& effort);
Finding lightFromIsTheDerivative(const LightCases& cases, const Effort& effort);
Finding lightLogGradientIsTheDerivative(const LightCases& cases, const Effort& effort);
Finding emissionIsTheDerivative(const LightCases& cases, const Effort& effort);

// light_flux.cpp
struct FluxFindings {
  Finding power;         ///< power() is the mean power of particles
  Finding arriving;      ///< power of emit() = irradiance of sample() on a sphere, octant by octant
  bool powerIsArriving;  ///< power() agrees with sample(), independent of emit()
};
FluxFindings fluxAgrees(const LightCases& cases, const Effort& effort);

// light_fuzz.cpp
Finding lightIsNeverNan(const LightCases& cases, const Effort& effort);

// light_threads.cpp
Finding lightAnswersStayTheSame(const LightCases& cases, const Effort& effort);
std::vector<Timing> lightTimings(const LightCases& cases);

}  // namespace vestige::judge
