// SPDX-License-Identifier: Apache-2.0
// Parameter sets and directions for the tests of a BRDF.
#pragma once
#include <vestige/brdf.h>

#include <sstream>

#include "judge/differences.h"
#include "judge/made.h"

namespace vestige::judge {

/// A plugin with one set of parameters.
struct BrdfCase {
  std::string plugin, settings;  ///< settings as in a scene: "{ alpha 0.3 ior 1.5 }"
  std::shared_ptr<Brdf> brdf;
  InputBuffer inputs;
  int refractiveIndex = -1;  ///< index of the input with the inside's index; -1: none
  Real outside = 1;          ///< refractive index outside
  bool hasInside = false;    ///< whether the BRDF depends on `behind`
  /// Whether its lobes through the surface are reciprocal. The lobe of phong cannot be: it is
  /// centred on the refracted direction, and widens where refraction narrows.
  bool isReciprocalAcross = true;

  ScatterPoint at(Vec3 toPrev, bool behind) const {
    const Real inside =
        refractiveIndex < 0 ? Real(1) : std::max(inputs[refractiveIndex].v[0], Real(0.1));
    const Real around = refractiveIndex < 0 ? Real(1) : outside;
    return {toPrev, behind, behind ? inside : around, behind ? around : inside,
            Inputs(inputs.data())};
  }
  std::string title() const {
    std::ostringstream text;
    text << "brdf " << plugin << " " << settings;
    if (outside != 1) text << " in a medium of index " << outside;
    return text.str();
  }
};

/// A toPrev of given height above the surface, at a random azimuth.
inline Vec3 atHeight(Real z, Random& r) {
  const Real phi = 2 * kPi * r.number(), s = safeSqrt((1 - z) * (1 + z));
  return {s * std::cos(phi), s * std::sin(phi), z};
}
/// Uniform over the hemisphere.
inline Vec3 aboveSurface(Random& r) { return atHeight(std::max(r.number(), Real(1e-6)), r); }
inline Vec3 anywhere(Random& r) {
  const Vec3 d = aboveSurface(r);
  return r.number() < Real(0.5) ? d : Vec3{d.x, d.y, -d.z};
}
inline ScatterNumbers numbers(Random& r) {
  const Real lobe = r.number();
  return {lobe, r.pair()};
}

/// A value of a row: `t` in [0,1] from its low to its high end; over decades by the logarithm of
/// the offset from the low end.
inline Value valueWithin(const Parameter& row, double t) {
  const double low = std::isfinite(row.low) ? row.low : -10;
  const double high = std::isfinite(row.high) ? row.high : 10;
  const double span = high - low;
  return numberValue(low + (span > 1000 ? std::expm1(t * std::log1p(span)) : t * span));
}
inline Value valueWithin(const Parameter& row, Random& r) {
  if (row.type != ValueType::rgb) return valueWithin(row, r.number());
  Value v = colourValue(0, 0, 0);
  for (int c = 0; c < 3; ++c) v.v[c] = valueWithin(row, r.number()).v[0];
  return v;
}
inline Value extremeOf(const Parameter& row, double end) {
  const double x = valueWithin(row, end).v[0];
  return row.type == ValueType::rgb ? colourValue(x, x, x) : numberValue(x);
}

/// Places where formulas break, by the names of the built-in parameters; a set is used for every
/// plugin that has all its names.
inline std::vector<Settings> awkwardSettings() {
  const auto n = [](double x) { return numberValue(x); };
  const auto c = [](double r, double g, double b) { return colourValue(r, g, b); };
  const Value white = c(1, 1, 1), black = c(0, 0, 0);
  return {
      {{"diffuse", c(0.9, 0, 0.2)}},
      {{"specular", c(0.5, 0.3, 0.1)}, {"exponent", n(0)}},
      {{"specular", c(0.7, 0.7, 0.7)}, {"exponent", n(60)}},
      {{"specular", c(0.6, 0.9, 0)}, {"transmission", c(0.6, 0, 0.4)}, {"exponent", n(1e6)}},
      {{"transmission", white}, {"exponent", n(20)}, {"ior", n(1)}},
      {{"transmission", c(0.5, 0.8, 0.8)}, {"exponent", n(200)}, {"ior", n(0.7)}},
      {{"alpha", n(0)}},
      {{"alpha", n(0.02)}},
      {{"alpha", n(0.3)}},
      {{"alpha", n(1)}},
      {{"alpha", n(0.3)}, {"ior", n(0.7)}},
      {{"alpha", n(0.2)}, {"ior", n(1)}},
      {{"alpha", n(0.5)}, {"anisotropy", n(1)}},
      {{"alpha", n(0.15)}, {"eta", c(0.143, 0.375, 1.442)}, {"k", c(3.983, 2.386, 1.603)}},
      {{"ior", n(1)}, {"specular", white}, {"transmission", white}},
      {{"base_color", black}, {"metallic", n(1)}, {"roughness", n(0.4)}},
      {{"base_color", white}, {"metallic", n(1)}, {"roughness", n(1)}},
      {{"base_color", white}, {"roughness", n(0)}},
      {{"base_color", white}, {"roughness", n(0.6)}, {"ior", n(3)}},
      {{"base_color", white}, {"roughness", n(0.3)}, {"ior", n(0.6)}},
      {{"base_color", white}, {"transmission", n(1)}, {"roughness", n(0.3)}},
      {{"base_color", white}, {"transmission", n(1)}, {"roughness", n(0)}, {"ior", n(1)}},
      {{"base_color", c(0.9, 0.1, 0.5)}, {"transmission", n(0.5)}, {"metallic", n(0.3)}},
      {{"base_color", black}, {"specular", n(0)}, {"transmission", n(0)}, {"metallic", n(0)}},
  };
}

inline std::string textOf(const Settings& settings) {
  std::ostringstream text;
  text.precision(9);
  text << "{";
  for (const auto& [name, value] : settings) {
    text << " " << name << " ";
    if (value.kind == Value::Kind::number)
      text << value.v[0];
    else
      text << "rgb <" << value.v[0] << ", " << value.v[1] << ", " << value.v[2] << ">";
  }
  text << " }";
  return text.str();
}

/// Defaults, both ends of all ranges, random values, and the awkward ones that fit.
inline std::vector<Settings> settingsFor(const Schema& schema, int randomSets, unsigned seed = 0) {
  std::vector<Settings> sets = {{}};
  for (const double end : {0.0, 1.0}) {
    Settings s;
    for (const Parameter& row : schema.inputs) s[row.name] = extremeOf(row, end);
    sets.push_back(s);
  }
  Random r(std::uint32_t(schema.name.size() * 7919 + std::size_t(schema.name[0])) + seed);
  for (int i = 0; i < randomSets; ++i) {
    Settings s;
    for (const Parameter& row : schema.inputs) s[row.name] = valueWithin(row, r);
    sets.push_back(s);
  }
  for (const Settings& s : awkwardSettings())
    if (std::all_of(s.begin(), s.end(), [&](const auto& entry) {
          const Parameter* row = schema.find(entry.first);
          return row && (row->type == ValueType::rgb) == (entry.second.kind == Value::Kind::colour);
        }))
      sets.push_back(s);
  return sets;
}

inline BrdfCase brdfCase(const Plugin& plugin, const Settings& s) {
  const std::vector<Parameter>& rows = plugin.schema->inputs;
  const auto index = std::find_if(rows.begin(), rows.end(),
                                  [](const Parameter& row) { return row.isRefractiveIndex; });
  BrdfCase c;
  c.plugin = plugin.name;
  c.settings = textOf(s);
  c.brdf = make<Brdf>(plugin);
  c.inputs = inputsFor(*plugin.schema, s);
  if (index != rows.end()) c.refractiveIndex = int(index - rows.begin());
  c.hasInside = index != rows.end() || !plugin.schema->params.empty();
  c.isReciprocalAcross = plugin.name != "phong";
  return c;
}

/// A plugin with all its parameter sets.
inline std::vector<BrdfCase> brdfCases(const Plugin& plugin, int randomSets, unsigned seed = 0) {
  std::vector<BrdfCase> cases;
  for (const Settings& s : settingsFor(*plugin.schema, randomSets, seed))
    cases.push_back(brdfCase(plugin, s));
  for (std::size_t i = 1; i < cases.size(); i += 3)  // some of them under water
    if (cases[i].refractiveIndex >= 0) cases[i].outside = Real(1.33);
  return cases;
}

/// A plugin with `sets` sets of random values.
inline std::vector<BrdfCase> randomBrdfCases(const Plugin& plugin, int sets, Random& r) {
  std::vector<BrdfCase> cases;
  for (int i = 0; i < sets; ++i) {
    Settings s;
    for (const Parameter& row : plugin.schema->inputs) s[row.name] = valueWithin(row, r);
    cases.push_back(brdfCase(plugin, s));
  }
  return cases;
}

}  // namespace vestige::judge
