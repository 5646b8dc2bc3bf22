// SPDX-License-Identifier: Apache-2.0
// Parameters of a plugin: `Values` when it is created; `Inputs` at every point, with textures
// already evaluated.
#pragma once
#include <cstdint>
#include <span>

#include <vestige/schema.h>

namespace vestige {

/// The values of Schema::params, in that order: the one given or the default. Type and range have
/// already been checked.
class Values {
 public:
  Values(std::span<const Value> rows, const Affine& toWorld) : rows_(rows), toWorld_(toWorld) {}

  Real real(int i) const { return Real(rows_[i].v[0]); }
  std::int64_t integer(int i) const { return std::int64_t(rows_[i].v[0]); }
  bool flag(int i) const { return rows_[i].v[0] != 0; }
  Vec2 vec2(int i) const { return vec2Of(rows_[i]); }
  Vec3 vec3(int i) const { return vec3Of(rows_[i]); }
  Rgb rgb(int i) const { return rgbOf(rows_[i]); }
  const std::string& text(int i) const { return rows_[i].text; }
  /// The given block, or null.
  const Block* block(int i) const { return rows_[i].block.get(); }
  /// The given function, or null; the plugin may keep it.
  std::shared_ptr<const Function> function(int i) const { return rows_[i].function; }
  /// Whether there is a value: given, or a default.
  bool has(int i) const { return rows_[i].kind != Value::Kind::none; }
  Span span(int i) const { return rows_[i].span; }
  const Value& value(int i) const { return rows_[i]; }

  // A list or a map in row i: its number of entries, and entry j. Counts and ranges have been
  // checked against the schema; a row that was not given has no entries.
  int size(int i) const { return rows_[i].list ? int(rows_[i].list->entries.size()) : 0; }
  const Value& value(int i, int j) const { return rows_[i].list->entries[std::size_t(j)].value; }
  Real key(int i, int j) const { return Real(rows_[i].list->entries[std::size_t(j)].key); }
  Real real(int i, int j) const { return Real(value(i, j).v[0]); }
  Vec2 vec2(int i, int j) const { return vec2Of(value(i, j)); }
  Vec3 vec3(int i, int j) const { return vec3Of(value(i, j)); }
  Rgb rgb(int i, int j) const { return rgbOf(value(i, j)); }
  const std::string& text(int i, int j) const { return value(i, j).text; }
  /// The block in entry j, or null.
  const Block* block(int i, int j) const { return value(i, j).block.get(); }
  Span span(int i, int j) const { return rows_[i].list->entries[std::size_t(j)].span; }

  /// Transform from the block's own space to world space. Lights and cameras apply it themselves;
  /// shapes and pigments must not, since the engine calls them in their own space.
  const Affine& toWorld() const { return toWorld_; }

 private:
  static Vec2 vec2Of(const Value& v) { return {Real(v.v[0]), Real(v.v[1])}; }
  static Vec3 vec3Of(const Value& v) { return {Real(v.v[0]), Real(v.v[1]), Real(v.v[2])}; }
  static Rgb rgbOf(const Value& v) { return {Real(v.v[0]), Real(v.v[1]), Real(v.v[2])}; }

  std::span<const Value> rows_;
  Affine toWorld_;
};

/// One evaluated input: a colour with alpha, or a number in v[0].
struct InputValue {
  Real v[4];
};

/// Upper limit of a BRDF's inputs, including the engine's (normal map, opacity) and those of nested
/// BRDFs.
inline constexpr int kMaxInputs = 48;

/// The values of Schema::inputs at one point, in that order, filtered over the path's footprint.
/// A view: the integrator's InputBuffer owns the values.
class Inputs {
 public:
  Inputs() = default;
  explicit Inputs(const InputValue* values) : values_(values) {}
  /// The inputs from index `first` on: those of a nested plugin.
  Inputs from(int first) const noexcept { return Inputs(values_ + first); }
  Real real(int i) const noexcept { return values_[i].v[0]; }
  Rgb rgb(int i) const noexcept { return {values_[i].v[0], values_[i].v[1], values_[i].v[2]}; }

 private:
  const InputValue* values_ = nullptr;
};
using InputBuffer = std::array<InputValue, kMaxInputs>;

}  // namespace vestige
