// SPDX-License-Identifier: Apache-2.0
// Sheen: fibres that stand up over another material and shine where it is seen at a grazing angle.
//
//     f = colour D(h) / (4 (a + b - a b)),   a = prev.z, b = next.z
//     D(h) = (2 + 1/r) / (2 pi) sin^(1/r)(angle of h),   h = half way between the two
//
// Reciprocal. Lay it over a base by `brdf mix`.
//
// [EK17]  Estevez, Kulla. Production friendly microfacet sheen BRDF. SIGGRAPH course 2017.    D
// [Ash07] Ashikhmin, Premoze. Distribution-based BRDFs. Tech. report, Univ. of Utah, 2007.  the
// rest
#include <vestige/cosine_brdf.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class Sheen final : public CosineBrdf<Sheen> {
 public:
  enum Input { kColour, kRoughness };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "sheen",
            .summary = "fibres that stand up: bright at grazing angles",
            .inputs = {rgb("colour", 0.5).range(0, 1).doc("of the fibres"),
                       real("roughness", 0.5).range(0.25, 1).doc("of their directions")}};
  }

  Rgb colour(const ScatterPoint& p) const noexcept { return p.inputs.rgb(kColour); }

  template <class T>
  T shape(const ScatterPoint& p, const TVec3<T>& prev, const TVec3<T>& next) const noexcept {
    using std::pow;
    const Real power = 1 / std::clamp(p.inputs.real(kRoughness), Real(0.25), Real(1));
    // sin^2 of the half vector's angle from its sides: 1 - cos^2 has no digits near the axis.
    const TVec3<T> h = prev + next;
    const T side2 = h.x * h.x + h.y * h.y;
    const T d = T((2 + power) / (2 * kPi)) * pow(side2 / (side2 + h.z * h.z), power / 2);
    return d / (T(4) * (prev.z + next.z - prev.z * next.z));
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Sheen)
