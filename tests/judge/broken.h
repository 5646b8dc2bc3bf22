// SPDX-License-Identifier: Apache-2.0
// Plugins that are wrong in one place each: a good one, and one method spoilt.
#pragma once
#include <vestige/brdf.h>

#include <atomic>
#include <memory>

namespace vestige::test {

/// Everything as the good one has it.
class AsGood : public Brdf {
 public:
  explicit AsGood(std::shared_ptr<const Brdf> good) : good(std::move(good)) {}
  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return good->evaluate(p, toNext);
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    return good->sample(p, n);
  }
  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    return good->sampleDerivatives(p, n);
  }
  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return good->logGradient(p, toNext);
  }
  DiffusePart diffuse(const ScatterPoint& p) const noexcept override { return good->diffuse(p); }
  Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return good->etaScale(p, toNext);
  }

 protected:
  std::shared_ptr<const Brdf> good;
};

/// Another direction for another lobe number, which it denies.
struct HiddenLobe final : AsGood {
  using AsGood::AsGood;
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    if (n.lobe > Real(0.5)) n.u = {1 - n.u.x, n.u.y};
    return good->sample(p, n);
  }
  bool usesLobeNumber() const noexcept override { return false; }
};

struct HalfPdf final : AsGood {
  using AsGood::AsGood;
  ScatterValue evaluate(const ScatterPoint& p, Vec3 d) const noexcept override {
    ScatterValue v = good->evaluate(p, d);
    v.pdf = v.pdf / 2;
    return v;
  }
};

/// Both densities alike, but of the hemisphere's uniform map.
struct UniformPdf final : AsGood {
  using AsGood::AsGood;
  ScatterValue evaluate(const ScatterPoint& p, Vec3 d) const noexcept override {
    return {good->evaluate(p, d).fCos, d.z > 0 ? 1 / (2 * kPi) : 0};
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    auto s = good->sample(p, n);
    if (!s) return s;
    s->weight = s->weight * (s->pdf * 2 * kPi), s->pdf = s->lobePdf = 1 / (2 * kPi);
    return s;
  }
};

/// A sample() that was spoilt by `how`.
template <class How>
struct SpoiltSample final : AsGood {
  SpoiltSample(std::shared_ptr<const Brdf> good, How how) : AsGood(std::move(good)), how(how) {}
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    auto s = good->sample(p, n);
    if (s) how(*s);
    return s;
  }
  How how;
};

/// Draws with its numbers changed, but derives as if they were not.
struct BiasedSample final : AsGood {
  using AsGood::AsGood;
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const auto s = good->sample(p, {n.lobe, {n.u.x * n.u.x, n.u.y}});
    return s;
  }
};

struct WrongSign final : AsGood {
  using AsGood::AsGood;
  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    ScatterJacobian j = good->sampleDerivatives(p, n);
    j.du.c[1] = -j.du.c[1];
    return j;
  }
};

struct ForgottenPrev final : AsGood {
  using AsGood::AsGood;
  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    return {.du = good->sampleDerivatives(p, n).du, .dPrev = {}};
  }
};

/// Cosine lobe by the polar disk: r = sqrt(u.x), whose derivative has no bound at the pole.
struct PolarPole final : AsGood {
  using AsGood::AsGood;
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Real r = std::sqrt(n.u.x), phi = 2 * kPi * n.u.y;
    const Real z = std::max(safeSqrt(1 - n.u.x), Real(1e-4));
    auto s = good->sample(p, n);
    s->toNext = {r * std::cos(phi), r * std::sin(phi), z}, s->pdf = s->lobePdf = z / kPi;
    return s;
  }
  ScatterJacobian sampleDerivatives(const ScatterPoint&, ScatterNumbers n) const noexcept override {
    const Real r = std::sqrt(n.u.x), phi = 2 * kPi * n.u.y, c = std::cos(phi), s = std::sin(phi);
    const Real z = std::max(safeSqrt(1 - n.u.x), Real(1e-4));
    const Vec3 outwards = {c / (2 * r), s / (2 * r), -1 / (2 * z)};
    return {.du = {outwards, 2 * kPi * r * Vec3{-s, c, 0}}, .dPrev = {}};
  }
};

struct SwappedEta final : AsGood {
  using AsGood::AsGood;
  Real etaScale(const ScatterPoint& p, Vec3 d) const noexcept override {
    return 1 / good->etaScale(p, d);
  }
};

/// Too bright everywhere, consistently.
struct EnergyGain final : AsGood {
  using AsGood::AsGood;
  ScatterValue evaluate(const ScatterPoint& p, Vec3 d) const noexcept override {
    const ScatterValue v = good->evaluate(p, d);
    return {2 * v.fCos, v.pdf};
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    auto s = good->sample(p, n);
    if (s) s->weight = 2 * s->weight;
    return s;
  }
};

/// Darker where toPrev is low, but not where toNext is.
struct OneWay final : AsGood {
  using AsGood::AsGood;
  ScatterValue evaluate(const ScatterPoint& p, Vec3 d) const noexcept override {
    const ScatterValue v = good->evaluate(p, d);
    return {p.toPrev.z * v.fCos, v.pdf};
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    auto s = good->sample(p, n);
    if (s) s->weight = p.toPrev.z * s->weight;
    return s;
  }
};

struct NanAtGrazing final : AsGood {
  using AsGood::AsGood;
  ScatterValue evaluate(const ScatterPoint& p, Vec3 d) const noexcept override {
    ScatterValue v = good->evaluate(p, d);
    if (p.toPrev.z < Real(1e-7)) v.fCos = v.fCos * std::numeric_limits<Real>::quiet_NaN();
    return v;
  }
};

/// Derives what was drawn last, by whatever thread.
struct SharedState final : AsGood {
  using AsGood::AsGood;
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    x = n.u.x, y = n.u.y;
    return good->sample(p, n);
  }
  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    return good->sampleDerivatives(p, {n.lobe, {x, y}});
  }
  mutable std::atomic<Real> x = 0, y = 0;
};

struct WrongLogGradient final : AsGood {
  using AsGood::AsGood;
  LogGradient logGradient(const ScatterPoint& p, Vec3 d) const noexcept override {
    const LogGradient g = good->logGradient(p, d);
    return {g.dNext, g.dPrev};
  }
};

struct TooDiffuse final : AsGood {
  using AsGood::AsGood;
  DiffusePart diffuse(const ScatterPoint&) const noexcept override {
    return {grey(Real(0.9)), false};
  }
};

}  // namespace vestige::test
