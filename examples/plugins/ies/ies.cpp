// SPDX-License-Identifier: Apache-2.0
// A luminaire with a measured distribution: an IES file (LM-63, type C photometry). The nadir of
// the file, vertical angle 0, is the light's axis; its values are scaled to 1 in the brightest
// direction. Between the angles of the file the intensity is bilinear. The derivative is left to
// the engine.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include <vestige/delta_light.h>

namespace vestige {
namespace {

const char* const kDownlight =  // without a file
    "TILT=NONE 1 1000 1 7 1 1 2 0 0 0 1 1 10  0 15 30 45 60 75 90  0  1000 950 800 550 300 100 0";

struct Table {
  std::vector<Real> vertical, horizontal, values;  ///< degrees; a row of values a horizontal angle
};

class Ies final : public PointSource {
 public:
  enum Row { kFile, kLocation, kPointAt, kIntensity };

  static Schema schema() {
    return {.kind = "light",
            .name = "ies",
            .summary = "a point with a measured distribution",
            .params = {file("file").place().doc("LM-63, type C; without it a downlight"),
                       vec3("location", {}).in("scene units").doc("where it stands"),
                       vec3("point_at", {0, 0, 1}).in("scene units").doc("where the nadir goes"),
                       rgb("intensity", 1).range(0, 1e12).in("W/sr").doc("at the brightest")}};
  }

  Ies(const Values& values, Host& host) : Ies(values, read(values, host)) {}

  Rgb intensity(Vec3 d) const noexcept override {
    const Real down = 180 / kPi * std::atan2(std::hypot(d.x, d.y), d.z);
    if (down < table_.vertical.front() || down > table_.vertical.back()) return {};
    const Real last = table_.horizontal.back();
    Real around = 180 / kPi * std::atan2(d.y, d.x);
    if (last > 180 && around < 0) around += 360;
    if (last <= 180) around = std::abs(around);               // both sides are alike
    if (last <= 90) around = std::min(around, 180 - around);  // ... and both ends
    const Real v = place(table_.vertical, down), h = place(table_.horizontal, around);
    const auto row = [&](Real i) {
      return std::lerp(value(i, v), value(i, v + 1), v - std::floor(v));
    };
    return std::lerp(row(h), row(h + 1), h - std::floor(h)) * intensity_;
  }

 private:
  Ies(const Values& values, Table table)
      : PointSource(aim(values, kLocation, kPointAt), std::cos(radians(table.vertical.back()))),
        table_(std::move(table)),
        intensity_(values.rgb(kIntensity)) {}

  static Table read(const Values& values, Host& host) {
    std::stringstream text(kDownlight);
    if (values.has(kFile)) {
      std::string error;
      const std::string name = host.find(values.text(kFile), values.span(kFile), error);
      if (name.empty()) throw PluginError(kFile, error);
      text.str("");
      text << std::ifstream(name).rdbuf();
    }
    for (std::string word; word != "TILT=NONE" && text >> word;) continue;
    double head[13] = {};  // lamps, lumens, factor, vertical, horizontal, type, ...
    for (double& x : head) text >> x;
    if (!text || head[5] != 1 || !(head[3] >= 2 && head[3] < 1e4 && head[4] >= 1 && head[4] < 1e4))
      throw PluginError(kFile, "expected an IES file with TILT=NONE and photometry of type C");
    Table t{std::vector<Real>(std::size_t(head[3])), std::vector<Real>(std::size_t(head[4])), {}};
    t.values.resize(t.vertical.size() * t.horizontal.size());
    for (auto* list : {&t.vertical, &t.horizontal, &t.values})
      for (Real& x : *list) text >> x;
    const Real most = *std::max_element(t.values.begin(), t.values.end());
    for (const auto& angles : {t.vertical, t.horizontal})
      if (std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>()) != angles.end())
        throw PluginError(kFile, "the angles of the IES file do not increase");
    if (!text || !(most > 0)) throw PluginError(kFile, "the IES file ends too early, or is dark");
    for (Real& x : t.values) x = std::max(x, Real(0)) / most;
    return t;
  }

  /// Which of the angles x is, and in the fraction how far on to the next.
  static Real place(const std::vector<Real>& angles, Real x) noexcept {
    const auto next = std::upper_bound(angles.begin(), angles.end() - 1, x);
    if (next == angles.begin()) return 0;
    const Real share = std::min((x - next[-1]) / (next[0] - next[-1]), Real(1));
    return Real(next - angles.begin() - 1) + share;
  }
  Real value(Real horizontal, Real vertical) const noexcept {
    const std::size_t n = table_.vertical.size(), h = std::size_t(horizontal);
    return table_.values[std::min(h, table_.horizontal.size() - 1) * n +
                         std::min(std::size_t(vertical), n - 1)];
  }

  Table table_;
  Rgb intensity_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Ies)
