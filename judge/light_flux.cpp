// SPDX-License-Identifier: Apache-2.0
// Three estimates of the flux: the mean of emit(), power(), and the irradiance of sample() on a
// sphere that every particle crosses.
#include <vestige/tools/sampling.h>

#include "judge/light_sphere.h"

namespace vestige::judge {
namespace {

struct Mean {
  double sum = 0, squares = 0;
  int n = 0;
  void add(double x) { sum += x, squares += x * x, ++n; }
  double value() const { return sum / n; }
  double error() const { return std::sqrt(std::max(0.0, squares / n - value() * value()) / n); }
};

std::size_t octant(Vec3 d) { return (d.x > 0 ? 1 : 0) + (d.y > 0 ? 2 : 0) + (d.z > 0 ? 4 : 0); }

using Octants = std::array<Mean, 8>;

Octants emitted(const Light& light, const LightSphere& s, int n, Random& r, Mean& all) {
  Octants parts;
  for (int i = 0; i < n; ++i) {
    const auto p = light.emit({r.pair(), r.pair()});
    const double power = p ? double(luminance(p->power)) : 0;
    all.add(power);
    const auto at = p ? crossing(*p, s, light.traits().isInfinite) : std::nullopt;
    for (std::size_t k = 0; k < 8; ++k) parts[k].add(at && octant(*at) == k ? power : 0);
  }
  return parts;
}

Octants arriving(const Light& light, const LightSphere& s, int n, Random& r, Mean& all) {
  Octants parts;
  const double area = 4 * M_PI * double(sqr(s.radius));
  for (int i = 0; i < n; ++i) {
    const Vec3 d = uniformCap(r.pair(), -1).d, normal = light.traits().isInfinite ? d : -d;
    const double flux = area * irradiance(light, s.centre + s.radius * d, normal, r.pair());
    all.add(flux);
    for (std::size_t k = 0; k < 8; ++k) parts[k].add(octant(d) == k ? flux : 0);
  }
  return parts;
}

}  // namespace

FluxFindings fluxAgrees(const LightCases& cases, const Effort& effort) {
  FluxFindings f{{"the mean power of emit() is power()", "power()"},
                 {"emit() brings to a sphere the irradiance of sample()", "emit()"},
                 true};
  Random r(effort.seed + 4);
  for (const LightCase& c : cases) {
    const LightSphere s = sphereFor(*c.light, r);
    if (!(s.radius > 0)) continue;
    Mean out, in;
    const Octants a = emitted(*c.light, s, effort.samples, r, out);
    const Octants b = arriving(*c.light, s, effort.samples, r, in);
    const double power = double(luminance(c.light->power()));
    // power() is an estimate; an error of 2 % has no visible effect.
    const double slack = 0.02 * std::abs(power);
    const Mean& flux = c.emits ? out : in;
    f.power.worst.see(std::abs(flux.value() - power) / (5 * flux.error() + slack), [&] {
      return lightEvent(
          c, {s.centre}, {},
          told("power() is", power, flux.value()) + (c.emits ? " by emit()" : " by sample()"));
    });
    if (!c.emits) continue;
    f.powerIsArriving &= std::abs(in.value() - power) <= 5 * in.error() + slack;
    for (std::size_t k = 0; k < 8; ++k) {
      const double allowed =
          5 * std::hypot(a[k].error(), b[k].error()) + 2e-3 * in.value() + 1e-6 * out.value();
      f.arriving.worst.see(std::abs(a[k].value() - b[k].value()) / allowed, [&] {
        return lightEvent(
            c, {s.centre}, {},
            told("the flux by emit() through an octant around it is", a[k].value(), b[k].value()) +
                " by sample(), octant " + std::to_string(k));
      });
    }
  }
  return f;
}

}  // namespace vestige::judge
