// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/brdf.h>

namespace vestige::test {

/// Another BRDF's eval, sample and pdf; derivatives as Base has them.
template <class Base>
class Forwarding : public Base {
 public:
  explicit Forwarding(const Brdf& full) : full_(full) {}
  Rgb eval(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return full_.eval(p, toNext);
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    return full_.sample(p, n);
  }
  Real pdf(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return full_.pdf(p, toNext);
  }

 private:
  const Brdf& full_;
};

}  // namespace vestige::test
