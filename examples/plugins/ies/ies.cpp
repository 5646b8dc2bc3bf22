// SPDX-License-Identifier: Apache-2.0
// A luminaire with a measured distribution: an IES file (LM-63, type C photometry), scaled to 1 in
// its brightest direction. Its nadir, vertical angle 0, is the light's axis. Bilinear between the
// angles of the file; the derivative is left to the engine.
#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include <vestige/delta_light.h>

namespace vestige::ies_plugin {

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
            .params = {file("file").place().doc("LM-63; without it a downlight"),
                       vec3("location", {}).in("scene units").doc("where it stands"),
                       vec3("point_at", {0, 0, 1}).in("scene units").doc("where the nadir goes"),
                       rgb("intensity", 1).range(0, 1e12).in("W/sr").doc("at the brightest")}};
  }

  Ies(const Values& values, Host& host) : Ies(values, read(values, host)) {}

  Rgb intensity(Vec3 d) const noexcept override {
    const Real down = 180 / kPi * std::atan2(std::hypot(d.x, d.y), d.z);
    if (down < table_.vertical.front() || down > table_.vertical.back()) return {};
    const Real last = table_.horizontal.back();
    Real around = 180 / kPi * std::atan2(d.y, d.x);  // -180 to 180
    if (last > 180 && around < 0) around += 360;
    if (last <= 180) around = std::abs(around);               // both sides are alike
    if (last <= 90) around = std::min(around, 180 - around);  // ... and both ends
    const Real v = place(table_.vertical, down), h = place(table_.horizontal, around);
    const Real v1 = v - std::floor(v), h1 = h - std::floor(h);
    const auto row = [&](Real i) { return std::lerp(value(i, v), value(i, v + 1), v1); };
    return std::lerp(row(h), row(h + 1), h1) * intensity_;
  }

 private:
  Ies(const Values& values, Table table)
      : PointSource(aim(values, kLocation, kPointAt), std::cos(radians(table.vertical.back()))),
        table_(std::move(table)),
        intensity_(values.rgb(kIntensity)) {}

  static Table read(const Values& values, Host& host) {
    std::string error, name;
    if (values.has(kFile)) name = host.find(values.text(kFile), values.span(kFile), error);
    if (!error.empty()) throw PluginError(kFile, error);
    std::stringstream text(name.empty() ? kDownlight : "");
    if (!name.empty()) text << std::ifstream(name).rdbuf();
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
    return Real(next - angles.begin() - 1) +
           std::min((x - next[-1]) / (next[0] - next[-1]), Real(1));
  }
  Real value(Real horizontal, Real vertical) const noexcept {
    const auto i = std::size_t(horizontal) * table_.vertical.size() + std::size_t(vertical);
    return table_.values[std::min(i, table_.values.size() - 1)];  // beyond the last its share is 0
  }

  Table table_;
  Rgb intensity_;
};

}  // namespace vestige::ies_plugin

VESTIGE_PLUGIN(vestige::Light, vestige::ies_plugin::Ies)
