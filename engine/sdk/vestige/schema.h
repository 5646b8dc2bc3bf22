// SPDX-License-Identifier: Apache-2.0
// The parameters of a plugin as data: type checking, error messages, `vestige describe`, the manual
// and completion are derived from these rows.
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <vestige/scene_desc.h>

namespace vestige {

enum class ValueType {
  real,      ///< number
  integer,   ///< whole number
  boolean,   ///< true/false, on/off, yes/no, or a number
  rgb,       ///< colour; a number or a 3-vector is taken as grey or as linear Rec. 709
  vec2,      ///< <a, b>
  vec3,      ///< <a, b, c>: a number is promoted, POV-Ray's rule
  text,      ///< "string"
  file,      ///< "file name", looked for beside the scene text
  choice,    ///< one of `choices`, as a string or as a bare word
  block,     ///< a block of kind `blockKind`
  vec4,      ///< <a, b, c, d>
  list,      ///< [a b c]: values of `entryType`
  map,       ///< [k a] [l b]: values of `entryType`, each behind a key
  function,  ///< of `arity` numbers, to a number
};

/// One row of a schema. Built by the functions below and the setters, which chain:
///   real("exponent", 50).range(0, 1e6).doc("0 diffuse, 1000 almost a mirror")
struct Parameter {
  std::string name;
  ValueType type = ValueType::real;
  Value initial;  ///< the default; Kind::none: no value unless given
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool openLow = false;            ///< low itself is refused, as for a radius
  bool required = false;           ///< must be given in a scene
  bool positional = false;         ///< may stand without its name, in the order of the rows
  bool texturable = false;         ///< takes a pigment in place of a constant
  bool isRefractiveIndex = false;  ///< refractive index of the inside of the surface
  bool isNonlinear = false;        ///< light is not linear in it: evaluated at points, not averaged
  std::string unit;                ///< "degrees", "scene units", "W/sr", ...; "" is a plain number
  std::string help;                ///< one line
  std::vector<std::string> choices;
  std::string blockKind;
  /// Type of each value of a list or a map. Range, unit, choices, block kind and pigments apply to
  /// each value.
  ValueType entryType = ValueType::real;
  int minEntries = 1;
  int maxEntries = std::numeric_limits<int>::max();
  double lowKey = -std::numeric_limits<double>::infinity();
  double highKey = std::numeric_limits<double>::infinity();
  int arity = 0;  ///< of a function

  Parameter&& range(double from, double to) && { return low = from, high = to, std::move(*this); }
  Parameter&& positive() && { return low = 0, openLow = true, std::move(*this); }
  Parameter&& need() && { return required = true, initial = {}, std::move(*this); }
  Parameter&& place() && { return positional = true, std::move(*this); }
  /// Marks an input as the refractive index of the inside: ScatterPoint::etaPrev and etaNext
  /// follow.
  Parameter&& refractiveIndex() && {
    isRefractiveIndex = isNonlinear = true;
    return std::move(*this);
  }
  Parameter&& nonlinear() && { return isNonlinear = true, std::move(*this); }
  Parameter&& textured() && { return texturable = true, std::move(*this); }
  Parameter&& entries(int from, int to) && {
    minEntries = from;
    maxEntries = to;
    return std::move(*this);
  }
  Parameter&& keys(double from, double to) && {
    lowKey = from;
    highKey = to;
    return std::move(*this);
  }
  /// Sets the kind of the blocks in a list.
  Parameter&& of(std::string kind) && { return blockKind = std::move(kind), std::move(*this); }
  Parameter&& in(std::string u) && { return unit = std::move(u), std::move(*this); }
  Parameter&& doc(std::string h) && { return help = std::move(h), std::move(*this); }
  Parameter&& unset() && { return initial = {}, std::move(*this); }

  bool isList() const noexcept { return type == ValueType::list || type == ValueType::map; }
  /// The row that each value of a list must fit.
  Parameter entry() const {
    Parameter row = *this;
    row.type = entryType;
    row.initial = {};
    return row;
  }
};

inline Value numberValue(double x) {
  Value v;
  v.kind = Value::Kind::number, v.v[0] = x;
  return v;
}
inline Value vectorValue(std::initializer_list<double> x) {
  Value v;
  v.kind = Value::Kind::vector;
  for (const double c : x) v.v[v.size++] = c;
  return v;
}
inline Value colourValue(double r, double g, double b) {
  Value v = vectorValue({r, g, b, 0, 0});
  v.kind = Value::Kind::colour;
  return v;
}
inline Value textValue(std::string s) {
  Value v;
  v.kind = Value::Kind::text, v.text = std::move(s);
  return v;
}
inline Value blockValue(Block block) {
  Value v;
  v.kind = Value::Kind::block;
  v.span = block.span;
  v.block = std::make_shared<const Block>(std::move(block));
  return v;
}
/// Of a map: with its keys.
inline Value mapValue(std::vector<std::pair<double, Value>> entries) {
  auto list = std::make_shared<List>();
  for (auto& [key, value] : entries) {
    list->holdsBlocks |= value.kind == Value::Kind::block;
    list->entries.push_back({key, value, value.span});
  }
  Value v;
  v.kind = Value::Kind::list;
  v.list = std::move(list);
  return v;
}
inline Value listValue(std::vector<Value> values) {
  std::vector<std::pair<double, Value>> entries;
  for (Value& value : values) entries.emplace_back(0, std::move(value));
  return mapValue(std::move(entries));
}

inline Parameter parameter(std::string name, ValueType type, Value initial) {
  Parameter p;
  p.name = std::move(name), p.type = type, p.initial = std::move(initial);
  return p;
}
inline Parameter real(std::string name, double initial) {
  return parameter(std::move(name), ValueType::real, numberValue(initial));
}
inline Parameter integer(std::string name, std::int64_t initial) {
  return parameter(std::move(name), ValueType::integer, numberValue(double(initial)));
}
inline Parameter boolean(std::string name, bool initial) {
  return parameter(std::move(name), ValueType::boolean, numberValue(initial));
}
inline Parameter rgb(std::string name, double grey) {
  return parameter(std::move(name), ValueType::rgb, colourValue(grey, grey, grey));
}
inline Parameter vec2(std::string name, Vec2 initial) {
  return parameter(std::move(name), ValueType::vec2, vectorValue({initial.x, initial.y}));
}
inline Parameter vec3(std::string name, Vec3 initial) {
  return parameter(std::move(name), ValueType::vec3,
                   vectorValue({initial.x, initial.y, initial.z}));
}
inline Parameter text(std::string name, std::string initial) {
  return parameter(std::move(name), ValueType::text, textValue(std::move(initial)));
}
/// No default: a file is given or it is not.
inline Parameter file(std::string name) { return parameter(std::move(name), ValueType::file, {}); }
/// The first word is the default.
inline Parameter choice(std::string name, std::vector<std::string> words) {
  Parameter p = parameter(std::move(name), ValueType::choice, textValue(words.front()));
  p.choices = std::move(words);
  return p;
}
/// A nested block of some kind; no default.
inline Parameter block(std::string name, std::string kind) {
  Parameter p = parameter(std::move(name), ValueType::block, {});
  p.blockKind = std::move(kind);
  return p;
}

/// `profile [<0, 0> <1, 2>]`: one or more values of a type (or as many as entries() allows); no
/// default. A name of an array gives them too.
inline Parameter list(std::string name, ValueType entryType) {
  Parameter p = parameter(std::move(name), ValueType::list, {});
  p.entryType = entryType;
  return p;
}
/// `colour_map { [0 rgb 0] [1 rgb 1] }`: the same with keys, which never decrease.
inline Parameter map(std::string name, ValueType entryType) {
  Parameter p = parameter(std::move(name), ValueType::map, {});
  p.entryType = entryType;
  return p;
}
/// `f function(x, y) { x*y }`, of that many numbers; no default.
inline Parameter function(std::string name, int arity) {
  Parameter p = parameter(std::move(name), ValueType::function, {});
  p.arity = arity;
  return p;
}

/// The complete description of a plugin for the scene language.
struct Schema {
  std::string kind;     ///< "brdf", "light", "camera", "integrator", "pigment", "shape", ...
  std::string name;     ///< the word in the language; "" for a block without plugin (film, union)
  std::string summary;  ///< one line
  std::vector<Parameter> params = {};      ///< fixed when the plugin is created: see Values
  std::vector<Parameter> inputs = {};      ///< may be textured, evaluated at each point: see Inputs
  std::vector<std::string> children = {};  ///< kinds of blocks that may stand inside
  // The engine sets these for the plugins of its own kinds.
  bool standsAlone = false;  ///< may stand outside every other block
  bool isSingle = false;     ///< only the last one that stands alone is used, with a warning
  bool isMovable = true;     ///< takes transforms: it has a place in space

  /// The row with this name, or null.
  const Parameter* find(const std::string& word) const noexcept {
    for (const auto* rows : {&params, &inputs})
      for (const Parameter& p : *rows)
        if (p.name == word) return &p;
    return nullptr;
  }
};

}  // namespace vestige
