// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/brdf.h>

namespace vestige::test {

/// Another BRDF's evaluate() and sample(); derivatives as Base has them.
template <class Base>
class Forwarding : public Base {
 public:
  explicit Forwarding(const Brdf& full) : full_(full) {}
  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return full_.evaluate(p, toNext);
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    return full_.sample(p, n);
  }

 private:
  const Brdf& full_;
};

}  // namespace vestige::test
