// SPDX-License-Identifier: Apache-2.0
#include "app/window/steer.h"

#include <fmt/format.h>

namespace vestige::app {
namespace {

constexpr Real kNearest = Real(1e-4);      ///< of a camera's distance from the origin
constexpr Real kNearestPole = Real(0.01);  ///< radians between the view and the sky

std::optional<Vec3> vectorOf(const Block& block, const Schema& schema, const std::string& name) {
  const Value* value = block.find(name);
  const Parameter* row = schema.find(name);
  if (!row || row->type != ValueType::vec3) return std::nullopt;
  if (!value) value = &row->initial;
  if (value->kind == Value::Kind::number)
    return Vec3{Real(value->v[0]), Real(value->v[0]), Real(value->v[0])};
  return Vec3{Real(value->v[0]), Real(value->v[1]), Real(value->v[2])};
}

void set(Block& block, const std::string& name, Value value) {
  std::erase_if(block.settings.edit(), [&](const Setting& s) { return s.name == name; });
  block.settings.push_back({name, std::move(value), {}});
}

Vec3 rotated(Vec3 v, Vec3 axis, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + (1 - c) * dot(axis, v) * axis;
}

struct Axes {
  Vec3 right, up, forward;
};
Axes axesOf(const View& v) {
  const Vec3 forward = normalize(v.lookAt - v.location);
  const Vec3 right = normalize(cross(normalize(v.sky), forward));
  return {right, cross(forward, right), forward};
}

/// The direction of view, turned: `right` about the sky, `up` no farther than to the poles.
Vec3 turned(const View& v, Real right, Real up) {
  const Vec3 sky = normalize(v.sky), forward = normalize(v.lookAt - v.location);
  const Real height = std::acos(std::clamp(dot(sky, forward), Real(-1), Real(1)));
  const Real wanted = std::clamp(height - up, kNearestPole, kPi - kNearestPole);
  const Vec3 level = rotated(forward, axesOf(v).right, wanted - height);
  return rotated(level, sky, right);
}

std::string text(double x) { return fmt::format("{:.7g}", std::abs(x) < 1e-9 ? 0.0 : x); }
/// As the text would say it: who pastes the camera has the one that was seen, to the bit.
double rounded(double x) { return std::stod(text(x)); }
Value rounded(Vec3 v) { return vectorValue({rounded(v.x), rounded(v.y), rounded(v.z)}); }

std::string text(const Value& v) {
  switch (v.kind) {
    case Value::Kind::number:
      return text(v.v[0]);
    case Value::Kind::text:
      return '"' + v.text.str() + '"';
    case Value::Kind::vector:
    case Value::Kind::colour: {
      std::string t = v.kind == Value::Kind::colour ? "rgb <" : "<";
      const int size = v.kind == Value::Kind::colour ? 3 : v.size;
      for (int i = 0; i < size; ++i) t += (i ? ", " : "") + text(v.v[i]);
      return t + '>';
    }
    default:
      return "";
  }
}

}  // namespace

std::optional<View> viewOf(const Block& camera, const Schema& schema) {
  const auto location = vectorOf(camera, schema, "location");
  const auto lookAt = vectorOf(camera, schema, "look_at");
  if (!location || !lookAt) return std::nullopt;
  const Vec3 sky = vectorOf(camera, schema, "sky").value_or(Vec3{0, 1, 0});
  const Affine& m = camera.world;
  return View{m.point(*location), m.point(*lookAt), normalize(m.vector(sky))};
}

Block withView(const Block& camera, const Schema& schema, const View& view) {
  Block b = camera;
  // What the transforms did to lengths and points they do no more.
  const double size = std::cbrt(std::abs(camera.world.determinant()));
  for (Setting& s : b.settings.edit()) {
    const Parameter* row = schema.find(s.name);
    if (!row || row->unit != "scene units") continue;
    if (row->type == ValueType::real) s.value.v[0] = rounded(s.value.v[0] * size);
    if (row->type == ValueType::vec3) {
      const Vec3 p =
          camera.world.point({Real(s.value.v[0]), Real(s.value.v[1]), Real(s.value.v[2])});
      s.value = rounded(p);
    }
  }
  set(b, "location", rounded(view.location));
  set(b, "look_at", rounded(view.lookAt));
  if (schema.find("sky")) set(b, "sky", rounded(view.sky));
  b.own = b.world = {};
  return b;
}

Block placed(const Block& camera, const Schema& schema) {
  const auto view = viewOf(camera, schema);
  return view ? withView(camera, schema, *view) : camera;
}

Block withNumber(Block camera, const std::string& name, double value) {
  // The camera takes one of them.
  if (name == "focus_distance")
    std::erase_if(camera.settings.edit(), [](const Setting& s) { return s.name == "focal_point"; });
  set(camera, name, numberValue(rounded(value)));
  return camera;
}

std::optional<double> numberOf(const Block& camera, const Schema& schema, const std::string& name) {
  const Parameter* row = schema.find(name);
  if (!row) return std::nullopt;
  const Value* value = camera.find(name);
  if (!value) value = &row->initial;
  if (value->kind != Value::Kind::number) return std::nullopt;
  return value->v[0];
}

View orbit(const View& v, Real right, Real up) {
  View next = v;
  next.location = v.lookAt - distance(v) * turned(v, right, up);
  return next;
}

View turn(const View& v, Real right, Real up) {
  View next = v;
  next.lookAt = v.location + distance(v) * turned(v, right, up);
  return next;
}

View pan(const View& v, Real right, Real up) {
  const Axes a = axesOf(v);
  const Vec3 by = right * a.right + up * a.up;
  return {v.location + by, v.lookAt + by, v.sky};
}

View dolly(const View& v, Real factor) {
  // No nearer than numbers of this size can tell two points apart.
  const Real nearest = kNearest * (length(v.location) + length(v.lookAt));
  if (distance(v) * factor < nearest) return v;
  return {v.lookAt + factor * (v.location - v.lookAt), v.lookAt, v.sky};
}

View walk(const View& v, Real forward) {
  const Vec3 by = forward * axesOf(v).forward;
  return {v.location + by, v.lookAt + by, v.sky};
}

Real distance(const View& v) { return length(v.lookAt - v.location); }

std::string cameraText(const Block& camera) {
  std::string t = fmt::format("camera {} {{\n", camera.plugin);
  for (const Setting& s : camera.settings)
    if (const std::string value = text(s.value); !value.empty())
      t += fmt::format("  {} {}\n", s.name, value);
  return t + "}\n";
}

}  // namespace vestige::app
