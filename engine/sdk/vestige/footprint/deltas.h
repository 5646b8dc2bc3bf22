// SPDX-License-Identifier: Apache-2.0
// Deltas: the interval of each random number that one path represents.
//
// The paths of a pixel (or of a light) share the unit square of each number among them; delta is
// the share of one of them. Few paths: wide footprints. [PD01 Sec. 3, MATH 3]
#pragma once
#include <vestige/math.h>

#include <cstdint>

namespace vestige {

/// The bounds of deltas; words of the scene language (docs/language.md, footprint).
enum class Bound {
  none,       ///< no footprints at all
  pixel,      ///< the film's numbers only: Igehy's ray differentials
  local,      ///< 1/sqrt of the samples drawn at that event: splitting [PD01 Sec. 3.1]
  global,     ///< N_eff^(-1/M): all numbers share what the whole path has [PD01 Sec. 3.1]
  roughness,  ///< a cone, opened by the lobe's roughness: for comparison (cone.h)
  density,    ///< a cone, opened by the density of what was drawn: for comparison
  safe,  ///< by the sample's index in the pixel, safeDelta(): shrinks fast enough never to be worse
         ///< than points
};

struct DeltaPolicy {
  Bound bound = Bound::safe;
  /// Largest relative change of the contribution over a footprint [PD01 Eq. 14]; infinite: no
  /// limit.
  Real limit = kInfinity;
  Real scale = 1;     ///< multiplies the bound
  Real exponent = 0;  ///< replaces that of global (1/M) or safe (2/3); 0: as it is
  /// Least number of random numbers that `global` counts. With two (exponent 1/2) an element would
  /// never receive more than one particle, however many are sent; with three (1/3) it does [MATH
  /// 4].
  int fewest = 1;
};

/// Delta of the n-th sample: n^(-2/3). Samples with the film's two random numbers only lie
/// scattered over the pixel and must overlap to cover it: 1.6 times that (docs/adr/0006).
inline Real safeDelta(Real n, int variables) noexcept {
  const Real delta = 1 / sqr(std::cbrt(n));
  return variables <= 2 ? std::min(Real(1), Real(1.6) * delta) : delta;
}

/// The number of paths like this one, and of its random numbers.
class PathCount {
 public:
  /// `index`: of this sample in its pixel; `declared`: samples a pixel (particles of all lights)
  /// in the scene, 0 if open ended: index + 1 then replaces it.
  void begin(std::uint64_t index, std::uint64_t declared, int variables) noexcept {
    index_ = Real(index + 1);
    total_ = declared > 0 ? Real(declared) : index_;
    share_ = 1, variables_ = variables;
  }
  /// Records a discrete choice that this path survived, with its probability: roulette (of
  /// survival), lobe, light, opacity. Reduces the number of paths like it.
  void chance(Real probability) noexcept { share_ *= probability; }
  /// Records a split into n children.
  void split(Real n) noexcept { share_ *= n; }
  /// Records the random numbers of an event: 2, or 0 if specular.
  void drew(int numbers) noexcept { variables_ += numbers; }

  Real effective() const noexcept { return total_ * share_; }  ///< N_eff
  Real effectiveIndex() const noexcept { return index_ * share_; }
  Real total() const noexcept { return total_; }
  int variables() const noexcept { return variables_; }  ///< M

 private:
  Real index_ = 1, total_ = 1, share_ = 1;
  int variables_ = 0;
};

/// The bound common to all random numbers of a path, in [0, 1]; for `pixel` and `local` that of the
/// film's.
inline Real commonDelta(const DeltaPolicy& policy, const PathCount& count) noexcept {
  Real delta = 0;
  switch (policy.bound) {
    case Bound::none:
      return 0;
    case Bound::pixel:
    case Bound::local:
    case Bound::roughness:
    case Bound::density:
      delta = 1 / std::sqrt(count.total());
      break;
    case Bound::global: {
      const Real e = policy.exponent > 0
                         ? policy.exponent
                         : Real(1) / Real(std::max(policy.fewest, count.variables()));
      delta = std::pow(count.effective(), -e);
      break;
    }
    case Bound::safe:
      delta = policy.exponent > 0 ? std::pow(count.effectiveIndex(), -policy.exponent)
                                  : safeDelta(count.effectiveIndex(), count.variables());
      break;
  }
  return std::clamp(policy.scale * delta, Real(0), Real(1));
}

}  // namespace vestige
