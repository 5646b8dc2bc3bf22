// SPDX-License-Identifier: Apache-2.0
#include "app/path_drawing.h"

#include <fmt/format.h>
#include <vestige/tools/path_report.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace vestige::app {
namespace {

// All in pixels.
constexpr double kWidth = 760, kSideHeight = 300, kMargin = 40;
constexpr double kPanelWidth = 250, kPanelHeight = 230, kDrawn = 80;  // half of what is drawn in
constexpr int kPanelsInRow = 3;
constexpr double kLine = 16;  // between lines of text

constexpr std::array<const char*, VertexDifferentials::kMost> kColours = {
    "#1f6f8b", "#63b0cc", "#c1440e", "#e8954f", "#4f7d22", "#9dc36a", "#7a4fa3", "#b794d6"};

std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string label(double x, double y, const std::string& text, const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, more, plain(text));
}

std::string line(Vec2 a, Vec2 b, const char* more) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", a.x,
                     a.y, b.x, b.y, more);
}

std::string outline(std::span<const Vec2> points, const char* more) {
  std::string text = "<polygon points=\"";
  for (const Vec2 p : points) text += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
  return text + fmt::format("\" {}/>\n", more);
}

std::string picture(double height, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n{2}</svg>\n",
      kWidth, height, body);
}

/// 1, 2 or 5 times a power of ten, at most x.
double roundNumber(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  return power * (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1);
}

bool hasSurface(const PathVertex& v) { return v.surface.object >= 0; }

/// An orthographic look at the path along the direction in which it spreads least.
class SideView {
 public:
  explicit SideView(const std::vector<PathVertex>& path) {
    const Vec3 start = path[0].surface.position + path[0].surface.distance * path[0].toPrev;
    points_ = {start};
    for (const PathVertex& v : path)
      if (hasSurface(v)) points_.push_back(v.surface.position);
    const Vec3 along = farthest([&](Vec3 p) { return p - start; });
    const Vec3 axis = normalize(along);
    const Vec3 beside = farthest([&](Vec3 p) { return across(p - start, axis); });
    const bool isLine = length(beside) < Real(1e-4) * length(along);
    normal_ = isLine ? Frame::around(axis).s : normalize(cross(axis, beside));
    const Vec3 y = across({0, 1, 0}, normal_);
    up_ = normalize(length(y) > Real(0.2) ? y : across({0, 0, 1}, normal_));
    right_ = cross(up_, normal_);
    if (dot(along, right_) < 0) right_ = -right_, normal_ = -normal_;
    for (const Vec3 p : points_) include(p);
    for (const PathVertex& v : path)
      for (const Vec3 half : v.differentials.footprint.dP)
        for (const Real side : {Real(-0.5), Real(0.5)})
          if (hasSurface(v)) include(v.surface.position + side * half);
    const double width = kWidth - 4 * kMargin, height = kSideHeight - 2 * kMargin;
    scale_ = std::min(width / std::max(1e-9, double(high_.x - low_.x)),
                      height / std::max(1e-9, double(high_.y - low_.y)));
  }

  Vec2 operator()(Vec3 p) const {
    const Vec2 middle = Real(0.5) * (low_ + high_);
    return {Real(kWidth / 2 + scale_ * (dot(p, right_) - middle.x)),
            Real(kSideHeight / 2 - scale_ * (dot(p, up_) - middle.y))};
  }
  const std::vector<Vec3>& points() const { return points_; }
  Vec3 normal() const { return normal_; }
  Vec3 right() const { return right_; }
  double scale() const { return scale_; }

 private:
  void include(Vec3 p) {
    const Vec2 q = {dot(p, right_), dot(p, up_)};
    low_ = {std::min(low_.x, q.x), std::min(low_.y, q.y)};
    high_ = {std::max(high_.x, q.x), std::max(high_.y, q.y)};
  }
  static Vec3 across(Vec3 v, Vec3 axis) { return v - dot(v, axis) * axis; }
  template <class F>
  Vec3 farthest(F f) const {
    Vec3 most;
    for (const Vec3 p : points_)
      if (length(f(p)) > length(most)) most = f(p);
    return most;
  }

  std::vector<Vec3> points_;
  Vec3 normal_, up_, right_;
  Vec2 low_{kInfinity, kInfinity}, high_{-kInfinity, -kInfinity};
  double scale_ = 1;
};

/// The ellipse of two full axes around `centre`, through `to`, which maps to the drawing.
template <class F>
std::vector<Vec2> ellipseOf(Vec3 centre, const Footprint& f, F to) {
  std::vector<Vec2> points;
  for (int i = 0; i < 64; ++i) {
    const Real angle = 2 * kPi * Real(i) / 64;
    points.push_back(
        to(centre + Real(0.5) * (std::cos(angle) * f.dP[0] + std::sin(angle) * f.dP[1])));
  }
  return points;
}

std::string scaleBar(double x, double y, double pixelsPerUnit) {
  const double size = roundNumber(70 / pixelsPerUnit);
  return line({Real(x), Real(y)}, {Real(x + size * pixelsPerUnit), Real(y)},
              "stroke=\"black\" stroke-width=\"2\"") +
         label(x, y - 5, fmt::format("{:g} scene unit{}", size, size == 1 ? "" : "s"));
}

std::string sideText(const SideView& view, const std::vector<PathVertex>& path) {
  std::string text, marks;
  Vec2 from = view(view.points()[0]);
  marks += label(from.x - 8, from.y - 8, "camera", "text-anchor=\"end\"");
  int number = 0;
  for (const PathVertex& v : path) {
    ++number;
    if (!hasSurface(v)) {  // it goes on into the distance
      const Vec3 end = view.points().back() - Real(60 / view.scale()) * v.toPrev;
      text += line(from, view(end), "stroke=\"#555\" stroke-dasharray=\"4 3\"");
      continue;
    }
    const Vec2 to = view(v.surface.position);
    text += line(from, to, "stroke=\"#555\" stroke-width=\"1.5\"");
    const Vec3 tangent = cross(v.surface.geometricNormal, view.normal());
    const Vec3 reach = Real(26 / view.scale()) * normalize(tangent);
    marks += line(view(v.surface.position - reach), view(v.surface.position + reach),
                  "stroke=\"#999\" stroke-width=\"3\"");
    if (v.differentials.size > 0)
      marks += outline(ellipseOf(v.surface.position, v.differentials.footprint, view),
                       "fill=\"#c1440e\" fill-opacity=\"0.3\" stroke=\"#c1440e\"");
    marks += label(to.x + 10, to.y + 18, std::to_string(number), "font-weight=\"bold\"");
    from = to;
  }
  return text + marks + scaleBar(kMargin, kSideHeight - 12, view.scale());
}

/// What a vertex's footprint is made of, seen along its normal.
std::string panelText(std::size_t k, const PathVertex& v, const std::vector<std::string>& names,
                      const LoadedScene& loaded, Vec3 right) {
  const VertexDifferentials& d = v.differentials;
  const Frame frame = Frame::along(v.surface.geometricNormal, right);
  std::vector<Vec2> vectors;
  Real reach = 0;
  for (int j = 0; j < d.size; ++j) {
    const Vec3 world = d.delta[j] * d.dVertex[j];
    vectors.push_back({dot(world, frame.s), dot(world, frame.t)});
  }
  std::vector<Vec2> corners(2 * vectors.size());
  polygon(vectors, corners);
  for (const Vec2 c : corners) reach = std::max(reach, std::sqrt(dot(c, c)));
  const double scale = reach > 0 ? kDrawn / reach : 1;
  const Vec2 centre = {Real(kPanelWidth / 2), Real(kPanelHeight / 2 + 4)};
  const auto flat = [&](Vec2 p) {
    return Vec2{Real(centre.x + scale * p.x), Real(centre.y - scale * p.y)};
  };
  const auto to = [&](Vec3 p) { return flat({dot(p, frame.s), dot(p, frame.t)}); };
  const ObjectInfo& o = loaded.scene->object(v.surface.object);
  std::string text =
      label(8, 18, fmt::format("{}  {} {}", k, o.shape, o.brdf), "font-weight=\"bold\"");
  for (Vec2& c : corners) c = flat(c);
  text += outline(corners, "fill=\"#eee\" stroke=\"#999\" stroke-dasharray=\"4 3\"");
  text += outline(ellipseOf({}, d.footprint, to),
                  "fill=\"#c1440e\" fill-opacity=\"0.2\" stroke=\"#c1440e\"");
  std::vector<std::size_t> order(vectors.size());  // the shorter over the longer
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return dot(vectors[i], vectors[i]) > dot(vectors[j], vectors[j]);
  });
  for (const std::size_t j : order) {
    const Vec2 half = Real(0.5) * vectors[j];
    text += line(flat(Real(-1) * half), flat(half),
                 fmt::format("stroke=\"{}\" stroke-width=\"2.5\"", kColours[j]).c_str());
  }
  if (reach > 0) text += scaleBar(8, kPanelHeight - 8, scale);
  for (std::size_t j = 0; j < vectors.size(); ++j) {
    const double y = kPanelHeight + 14 + kLine * double(j);
    text += fmt::format("<rect x=\"8\" y=\"{:.0f}\" width=\"10\" height=\"10\" fill=\"{}\"/>\n",
                        y - 10, kColours[j]);
    text += label(24, y,
                  fmt::format("{}: {:.3g} x {:.3g}", names[j], double(d.delta[j]),
                              double(length(d.dVertex[j]))));
  }
  return text;
}

}  // namespace

std::string pathSvg(const RecordedPath& path, const LoadedScene& loaded) {
  const std::vector<PathVertex>& all = path.vertices;
  if (all.empty() || !hasSurface(all[0]))
    return picture(kPanelHeight, label(kMargin, kMargin, "The path meets no surface."));
  const auto names = numberNames(all);
  const SideView view(all);
  std::string body = sideText(view, all);
  double y = kSideHeight, height = 0;
  int column = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].differentials.size == 0) continue;
    if (column == kPanelsInRow) y += height, column = 0, height = 0;
    body +=
        fmt::format("<g transform=\"translate({:.0f} {:.0f})\">\n{}</g>\n", kPanelWidth * column++,
                    y, panelText(k + 1, all[k], names[k], loaded, view.right()));
    height = std::max(height, kPanelHeight + 24 + kLine * all[k].differentials.size);
  }
  return picture(y + height, body);
}

}  // namespace vestige::app
