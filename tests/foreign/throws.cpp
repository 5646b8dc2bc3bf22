// SPDX-License-Identifier: Apache-2.0
// A plugin whose constructor throws or crashes: as the parameter `how` asks.
#include <vestige/brdf.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class Throws final : public Brdf {
 public:
  static Schema schema() {
    return {.kind = "brdf",
            .name = "throws",
            .summary = "cannot be made",
            .params = {integer("how", 0).doc("0: a number, 1: an exception, 2: a "
                                             "PluginError, 3: it reads from nowhere")}};
  }
  explicit Throws(const Values& values) {
    if (values.integer(0) == 1) throw std::runtime_error("no such fibre");
    if (values.integer(0) == 2) throw PluginError(0, "how is 2: expected less");
    if (values.integer(0) == 3) nowhere_ = *nowhere();
    throw 42;
  }

  ScatterValue evaluate(const ScatterPoint&, Vec3) const noexcept override { return {}; }
  std::optional<ScatterSample> sample(const ScatterPoint&, ScatterNumbers) const noexcept override {
    return std::nullopt;
  }

 private:
  /// An address that nothing is at; the compiler does not know.
  static const int* nowhere() noexcept {
    static const int* volatile address = nullptr;
    return address;
  }
  int nowhere_ = 0;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Throws)
