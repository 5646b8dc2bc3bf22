// SPDX-License-Identifier: Apache-2.0
// Rough diffuse surfaces such as clay or the moon: V-shaped grooves whose walls are diffuse.
//
//     f = albedo / pi (A + B max(0, cos(phi)) sin(alpha) tan(beta))
//     A = 1 - s^2 / (2 (s^2 + 0.33)),   B = 0.45 s^2 / (s^2 + 0.09)
//
// phi is the angle between both directions around the normal, alpha and beta the larger and the
// smaller of their angles from it, s the deviation of the grooves' slopes. Reciprocal.
//
// [ON94] Oren, Nayar. Generalization of Lambert's reflectance model. SIGGRAPH 1994.       Eq. 30
#include <vestige/cosine_brdf.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class OrenNayar final : public CosineBrdf<OrenNayar> {
 public:
  enum Input { kAlbedo, kSigma };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "oren_nayar",
            .summary = "rough diffuse: clay, plaster, the moon",
            .inputs = {rgb("albedo", 0.5).range(0, 1).doc("reflected fraction"),
                       real("sigma", 20).range(0, 90).in("degrees").doc("0 is diffuse")}};
  }

  Rgb colour(const ScatterPoint& p) const noexcept { return p.inputs.rgb(kAlbedo) / kPi; }

  template <class T>
  T shape(const ScatterPoint& p, const TVec3<T>& prev, const TVec3<T>& next) const noexcept {
    using std::max;
    const Real s = std::clamp(p.inputs.real(kSigma), Real(0), Real(90)) * kPi / 180;
    const Real a = 1 - s * s / (2 * (s * s + Real(0.33)));
    const Real b = Real(0.45) * s * s / (s * s + Real(0.09));
    // sin(alpha) tan(beta) cos(phi) is the flat part of the product over the larger cosine.
    const T flat = prev.x * next.x + prev.y * next.y;
    if (!(value(flat) > 0)) return T(a);
    return T(a) + T(b) * flat / max(prev.z, next.z);
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::OrenNayar)
