// SPDX-License-Identifier: Apache-2.0
// Landscape from the brightness of an image, as POV-Ray's: the image lies over the unit square of x
// and z (its lower left corner at the origin), white is y = 1. Each texel is a corner.
#include <vestige/plugin.h>
#include <vestige/shape.h>

namespace vestige {
namespace {

/// Each sample becomes two triangles, of some 150 bytes with what rays need to find them.
constexpr std::int64_t kMostSamples = 4096 * 4096;

/// Corner of a piece of landscape on its way through the water level.
struct Corner {
  Vec3 position, normal;
};
Corner blend(const Corner& a, const Corner& b, Real t) {
  return {a.position + t * (b.position - a.position),
          normalize(a.normal + t * (b.normal - a.normal))};
}

class HeightField final : public MeshShape {
 public:
  enum Row { kFile, kSmooth, kWaterLevel };

  static Schema schema() {
    return {.kind = "shape",
            .name = "height_field",
            .summary = "landscape over the unit square from the brightness of an image",
            .params = {file("file").need().place().doc(
                           "a picture of at most 4096 x 4096 texels: its brightness is the height"),
                       boolean("smooth", false).doc("blends the normals of neighbours"),
                       real("water_level", 0).range(0, 1).doc("what lies below is left out")}};
  }

  HeightField(const Values& v, Host& host) : smooth_(v.flag(kSmooth)), water_(v.real(kWaterLevel)) {
    std::string error;
    const auto image = host.texture({v.text(kFile), v.span(kFile), "raw"}, error);
    if (!image) throw PluginError(kFile, error);
    w_ = image->width(), h_ = image->height();
    if (w_ < 2 || h_ < 2)
      throw PluginError(kFile, "the image is " + std::to_string(w_) + " x " + std::to_string(h_) +
                                   " texels, expected at least 2 x 2");
    if (std::int64_t(w_) * h_ > kMostSamples)
      throw PluginError(kFile, "the image is " + std::to_string(w_) + " x " + std::to_string(h_) +
                                   " texels, at most " + std::to_string(kMostSamples) +
                                   " become a height field (as 4096 x 4096): scale it down");
    heights_.reserve(std::size_t(w_) * h_);
    for (int y = 0; y < h_; ++y)
      for (int x = 0; x < w_; ++x) heights_.push_back(luminance(image->texel(x, y).colour));
    parts_.emplace_back();
    build(parts_.back().mesh);
    if (parts_.back().mesh.triangles.empty())
      throw PluginError(kWaterLevel, "all of the height field lies below the water level");
    heights_.clear();
  }

 private:
  void build(TriangleMesh& m) const {
    for (int y = 0; y < h_; ++y)
      for (int x = 0; x < w_; ++x) add(m, corner(x, y));
    const auto index = [&](int x, int y) { return std::uint32_t(y * w_ + x); };
    for (int y = 0; y + 1 < h_; ++y)
      for (int x = 0; x + 1 < w_; ++x) {  // cross of the edges points up
        addDry(m, {index(x, y), index(x, y + 1), index(x + 1, y)});
        addDry(m, {index(x + 1, y + 1), index(x + 1, y), index(x, y + 1)});
      }
  }

  /// The part of a triangle above the water: of none, three or four corners.
  void addDry(TriangleMesh& m, std::array<std::uint32_t, 3> t) const {
    const auto height = [&](int k) { return m.positions[t[k % 3]].y; };
    const int dry = (height(0) >= water_) + (height(1) >= water_) + (height(2) >= water_);
    if (dry == 0) return;
    if (dry == 3) return m.triangles.push_back(t);
    std::vector<std::uint32_t> rim;
    for (int k = 0; k < 3; ++k) {
      if (height(k) >= water_) rim.push_back(t[k]);
      if ((height(k) >= water_) == (height(k + 1) >= water_)) continue;
      const auto at = [&](int j) {
        const std::uint32_t i = t[j % 3];
        return Corner{m.positions[i], smooth_ ? m.normals[i] : Vec3{0, 1, 0}};
      };
      rim.push_back(std::uint32_t(m.positions.size()));
      add(m, blend(at(k), at(k + 1), (water_ - height(k)) / (height(k + 1) - height(k))));
    }
    for (std::size_t k = 2; k < rim.size(); ++k)
      m.triangles.push_back({rim[0], rim[k - 1], rim[k]});
  }

  void add(TriangleMesh& m, const Corner& c) const {
    m.positions.push_back(c.position);
    m.uvs.push_back({c.position.x, c.position.z});
    if (smooth_) m.normals.push_back(c.normal);
  }

  Corner corner(int x, int y) const {
    const Real dx = Real(1) / (w_ - 1), dz = Real(1) / (h_ - 1);
    return {{x * dx, height(x, y), y * dz},
            normalize({-slope(x, y, 1, 0) / dx, 1, -slope(x, y, 0, 1) / dz})};
  }
  Real height(int x, int y) const { return heights_[std::size_t(y) * w_ + x]; }
  /// Height by texel along x or y: central difference, one-sided at the rim.
  Real slope(int x, int y, int sx, int sy) const {
    const int x0 = std::max(x - sx, 0), y0 = std::max(y - sy, 0);
    const int x1 = std::min(x + sx, w_ - 1), y1 = std::min(y + sy, h_ - 1);
    return (height(x1, y1) - height(x0, y0)) / Real(x1 - x0 + y1 - y0);
  }

  std::vector<Real> heights_;
  int w_ = 0, h_ = 0;
  bool smooth_;
  Real water_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::HeightField)
