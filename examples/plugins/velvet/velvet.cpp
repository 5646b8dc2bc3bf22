// SPDX-License-Identifier: Apache-2.0
// Velvet: fibres that stand up, so their microfacets look sideways and it shines where it is seen
// at a grazing angle.
//
//     f(prev, next) = colour D(h) / (4 (a + b - a b)),   a = prev.z, b = next.z
//     D(h) = (2 + 1/r) / (2 pi) sin^(1/r)(angle of h),   h = half way between the two
//
// Reciprocal. By numerical integration it reflects at most `colour` for r >= 1/4, hence the range.
// Both derivatives come from dual numbers.
//
// [EK17]  Estevez, Kulla. Production friendly microfacet sheen BRDF. SIGGRAPH course 2017.   D
// [Ash07] Ashikhmin, Premoze. Distribution-based BRDFs. Tech. report, Univ. of Utah, 2007.   the
// rest
#include <vestige/dual_brdf.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class Velvet final : public DualBrdf<Velvet> {
 public:
  enum Input { kColour, kRoughness };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "velvet",
            .summary = "fibres that stand up: bright at grazing angles",
            .inputs = {rgb("colour", 0.5).range(0, 1).doc("of the fibres"),
                       real("roughness", 0.4)
                           .range(kSmoothest, 1)
                           .doc("of their directions; a small one shines at the rim alone")}};
  }

  /// Evenly over the hemisphere: by the cosine the weights would have no bound. z = 1 - |d|^2.
  template <class T>
  TVec3<T> direction(const ScatterPoint&, const TVec3<T>&, Real, const TVec2<T>& u) const noexcept {
    using std::sqrt;
    const TVec2<T> d = concentricDisk(u);
    const T q = d.x * d.x + d.y * d.y, m = sqrt(T(2) - q);
    return {d.x * m, d.y * m, T(1) - q};
  }

  template <class T>
  T logValue(const ScatterPoint& p, const TVec3<T>& toPrev, const TVec3<T>& toNext) const noexcept {
    using std::log;
    return T(1 / (2 * roughness(p))) * log(sine2(toPrev, toNext)) -
           log(toPrev.z + toNext.z - toPrev.z * toNext.z);
  }

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    if (!(toNext.z > 0)) return {};
    const Real power = 1 / roughness(p), a = p.toPrev.z, b = toNext.z;
    const Real d =
        (2 + power) / (2 * kPi) * std::pow(sine2(lifted(p.toPrev), lifted(toNext)), power / 2);
    return {b * d / (4 * (a + b - a * b)) * p.inputs.rgb(kColour), kDensity};
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Vec3 toNext = uniformCap(n.u, 0).d;
    if (!(toNext.z > 0)) return std::nullopt;
    return ScatterSample::only(toNext, evaluate(p, toNext).fCos / kDensity, kDensity);
  }

 private:
  static constexpr Real kSmoothest = Real(0.25);
  static constexpr Real kDensity = 1 / (2 * kPi);

  /// A texture may say anything.
  static Real roughness(const ScatterPoint& p) noexcept {
    return std::clamp(p.inputs.real(kRoughness), kSmoothest, Real(1));
  }

  /// sin^2 of the half vector's angle; from its sides, as 1 - cos^2 has no digits near the axis.
  template <class T>
  static T sine2(const TVec3<T>& a, const TVec3<T>& b) noexcept {
    const TVec3<T> h = a + b;
    const T side2 = h.x * h.x + h.y * h.y;
    return side2 / (side2 + h.z * h.z);
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Velvet)
