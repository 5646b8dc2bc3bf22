// SPDX-License-Identifier: Apache-2.0
// Glossy reflection around the mirror direction and glossy transmission around the refracted one:
// the modified Phong model with both lobes of [PD01], without Fresnel.
//
//     f(prev, next) = specular     (n + 2) / (2 pi) cos^n a   next on the same side
//                   = transmission (n + 2) / (2 pi) cos^n a   next on the far side
//     a = angle(next, axis),   axis = mirrored or refracted prev
//
// Conserves energy for specular + transmission <= 1; what a texture makes larger is scaled down to
// it. The reflecting lobe is reciprocal, the refracting one is not: no lobe about a refracted axis
// is. Each is sampled in closed form; directions that end on the other side of the surface are
// absorbed, and so is the transmitted part where reflection is total.
//
// [LW94]  Lafortune, Willems. Using the modified Phong reflectance model for physically based
//         rendering. Report CW 197, K.U.Leuven, 1994.                              the model
// [PD01]  Suykens, Willems. Path differentials and applications. EGWR 2001. Fig. 2  the derivative
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/fresnel.h>
#include <vestige/tools/sampling.h>

namespace vestige {
namespace {

class Phong final : public Brdf {
 public:
  enum Input { kSpecular, kExponent, kTransmission, kIor };
  enum Lobe { kReflected, kRefracted };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "phong",
            .summary = "glossy reflection and transmission, cosine-power lobes",
            .inputs = {rgb("specular", 0).range(0, 1).doc("reflected fraction at normal incidence"),
                       real("exponent", 50).range(0, 1e6).doc("0 diffuse, 1000 almost a mirror"),
                       rgb("transmission", 0).range(0, 1).doc("transmitted fraction, likewise"),
                       real("ior", 1.5)
                           .range(0.1, 10)
                           .refractiveIndex()
                           .doc("refractive index of the inside")}};
  }

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Lobe lobe = side(toNext);
    const Real n = exponent(p), reflect = reflectChance(p);
    if (!(reflect >= 0)) return {};
    const Real power = cosPower(axis(p, lobe), toNext, n) / (2 * kPi);
    const Real chance = lobe == kReflected ? reflect : 1 - reflect;
    return {fCos(p, toNext, n, power), chance * (n + 1) * power};
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers r) const noexcept override {
    const Real n = exponent(p), reflect = reflectChance(p);
    if (!(reflect >= 0)) return std::nullopt;
    const Lobe lobe = r.lobe < reflect ? kReflected : kRefracted;
    const Axis a = axis(p, lobe);
    const Vec3 toNext = Frame::around(a.direction).toWorld(around(n, r.u).direction);
    const Real chance = lobe == kReflected ? reflect : 1 - reflect;
    const Real density = (n + 1) / (2 * kPi) * cosPower(a, toNext, n);
    if (side(toNext) != lobe || !(density * chance > 0)) return std::nullopt;
    // f cos / pdf: the powers cancel, so the weight is finite for every exponent.
    const Rgb weight = (n + 2) / (n + 1) * std::abs(toNext.z) / chance * fraction(p, lobe);
    return ScatterSample{.toNext = toNext,
                         .weight = weight,
                         .pdf = density * chance,
                         .lobePdf = density,
                         .lobeChance = chance,
                         .lobe = lobe,
                         .specular = false};
  }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers r) const noexcept override {
    const Axis a = axis(p, r.lobe < reflectChance(p) ? kReflected : kRefracted);
    const Frame frame = Frame::around(a.direction);
    const Around l = around(exponent(p), r.u);
    const Vec3 toNext = frame.toWorld(l.direction);
    // The axis turns by d(axis) and takes the sample along, without spin:
    // d(toNext) = (axis x d(axis)) x toNext = (axis . toNext) d(axis) - (toNext . d(axis)) axis.
    const Mat3 turn = dot(a.direction, toNext) * identity() - outer(a.direction, toNext);
    return {.du = {frame.toWorld(l.du.c[0]), frame.toWorld(l.du.c[1])}, .dPrev = turn * a.dPrev};
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Real n = exponent(p);
    const Axis a = axis(p, side(toNext));
    if (isBlack(fCos(p, toNext, n, cosPower(a, toNext, n) / (2 * kPi)))) return {};
    // log f = n log(axis . next) + const
    const Real slope = n / dot(a.direction, toNext);
    return {slope * (transpose(a.dPrev) * toNext), slope * a.direction};
  }

 private:
  /// Axis of a lobe, with its derivative by toPrev.
  struct Axis {
    Vec3 direction;  ///< unit; zero where reflection is total and nothing refracted
    Mat3 dPrev;
  };
  struct Around {
    Vec3 direction;  ///< around +z
    Mat3x2 du;       ///< its derivative by u
  };

  static Lobe side(Vec3 toNext) noexcept { return toNext.z > 0 ? kReflected : kRefracted; }

  /// A texture may hold any number.
  static Real exponent(const ScatterPoint& p) noexcept {
    return std::clamp(p.inputs.real(kExponent), Real(0), Real(1e6));
  }

  static Axis axis(const ScatterPoint& p, Lobe lobe) noexcept {
    constexpr Vec3 normal = {0, 0, 1};
    if (lobe == kRefracted && refractedCosine(p.toPrev.z, p.eta()) < 0) return {};
    const Deflection t =
        lobe == kReflected ? reflectAt(p.toPrev, normal) : refractAt(p.toPrev, normal, p.eta());
    return {t.direction, t.dPrev()};
  }

  /// The lobe's colour, scaled so that both lobes together conserve energy.
  static Rgb fraction(const ScatterPoint& p, Lobe lobe) noexcept {
    const Rgb s = p.inputs.rgb(kSpecular), t = p.inputs.rgb(kTransmission), sum = s + t;
    const Rgb own = lobe == kReflected ? s : t;
    const auto fit = [](Real x, Real total) { return total > 1 ? x / total : x; };
    return {fit(own.r, sum.r), fit(own.g, sum.g), fit(own.b, sum.b)};
  }

  /// f |cos| of a direction; `power`: cosPower() / (2 pi).
  static Rgb fCos(const ScatterPoint& p, Vec3 toNext, Real n, Real power) noexcept {
    return (n + 2) * power * std::abs(toNext.z) * fraction(p, side(toNext));
  }

  /// Probability of the lobe by luminance; negative if both are black.
  static Real reflectChance(const ScatterPoint& p) noexcept {
    const bool total = refractedCosine(p.toPrev.z, p.eta()) < 0;
    const Real s = luminance(fraction(p, kReflected));
    const Real t = total ? 0 : luminance(fraction(p, kRefracted));
    return s + t > 0 ? s / (s + t) : Real(-1);
  }

  /// [0,1)^2 -> unit vector with density (n+1)/(2 pi) cos^n, and the derivative of that same map:
  /// cos a = (1 - q)^e with q = |disk point|^2, e = 1 / (n + 1). Through log1p and expm1: for large
  /// n the cosine is so near 1 that 1 - cos^2 has no digits.
  static Around around(Real n, Vec2 u) noexcept {
    const Disk k = concentricDisk(u);
    const Real q = std::min(dot(k.d, k.d), kOneMinusEpsilon), e = 1 / (n + 1);
    const Real logPower = std::log1p(-q);
    const Real c = std::exp(e * logPower), dc = -e * c / (1 - q);  // cos a; by q
    const Real sin2 = -std::expm1(2 * e * logPower);
    const bool pole = q < Real(1e-6);                              // series, not 0/0
    const Real g = pole ? std::sqrt(2 * e) : std::sqrt(sin2 / q);  // sin a / |d|; by q
    const Real dg = pole ? e * (1 - 2 * e) / (2 * g) : (-2 * c * dc * q - sin2) / (2 * q * q * g);
    const auto column = [&](Vec2 d) {
      const Real dq = 2 * dot(k.d, d);
      return Vec3{d.x * g + k.d.x * dg * dq, d.y * g + k.d.y * dg * dq, dc * dq};
    };
    return {{k.d.x * g, k.d.y * g, c}, {column(k.du[0]), column(k.du[1])}};
  }

  /// cos^n a, dimensionless; 0 for a > 90 degrees. Near the axis it uses the sine: the lobe of
  /// exponent 1e6 is a thousandth of a radian wide, where a float's cosine has three values.
  static Real cosPower(const Axis& a, Vec3 toNext, Real n) noexcept {
    const Real c = dot(a.direction, toNext);
    if (!(c > 0)) return 0;
    if (c < Real(0.5)) return std::pow(c, n);
    const Real sin2 = lengthSquared(cross(a.direction, toNext));
    return std::exp(n / 2 * std::log1p(-sin2));
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Phong)
