// SPDX-License-Identifier: Apache-2.0
// A picture from a file.
#include <vestige/pigment.h>
#include <vestige/plugin.h>
#include <vestige/tools/texture_box.h>

namespace vestige {

namespace {

/// Where in the picture, and how that moves along the footprint.
struct Spot {
  Vec2 uv;
  Vec2 dUv[2];
};

Spot byUv(const Lookup& at) noexcept { return {at.uv, {at.footprint.dUv[0], at.footprint.dUv[1]}}; }

/// Along z onto the unit square of x and y.
Spot planar(const Lookup& at) noexcept {
  const auto flat = [](Vec3 v) { return Vec2{v.x, v.y}; };
  return {flat(at.position), {flat(at.footprint.dP[0]), flat(at.footprint.dP[1])}};
}

/// By the direction from the origin, as on a sphere: u is longitude from +x towards +z over 1, v
/// latitude from -y to +y.
Spot spherical(const Lookup& at) noexcept {
  const Vec3 p = at.position;
  const Real across = std::sqrt(p.x * p.x + p.z * p.z);
  const Real turn = std::atan2(p.z, p.x) / (2 * kPi);
  Spot spot{{turn < 0 ? turn + 1 : turn, std::atan2(p.y, across) / kPi + Real(0.5)}, {}};
  const Real axis2 = std::max(across * across, std::numeric_limits<Real>::min());
  const Real r2 = std::max(lengthSquared(p), std::numeric_limits<Real>::min());
  for (int i = 0; i < 2; ++i) {
    const Vec3 d = at.footprint.dP[i];
    const Real outwards = (p.x * d.x + p.z * d.z) / std::sqrt(axis2);
    spot.dUv[i] = {(p.x * d.z - p.z * d.x) / (axis2 * 2 * kPi),
                   (across * d.y - p.y * outwards) / (r2 * kPi)};
  }
  return spot;
}

}  // namespace

class ImagePigment final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "image",
            "a picture from a file",
            {file("file").place().need().doc("PNG, JPEG, EXR, HDR, TIFF or .tx"),
             choice("wrap", {"repeat", "clamp", "mirror"}).doc("what lies beyond the edge"),
             text("color_space", "")
                 .doc("\"\": as the file says; \"raw\" for data; \"srgb\"; or a name of the colour "
                      "config"),
             choice("mapping", {"uv", "planar", "spherical"})
                 .doc("the surface's uv; x and y of the position; its direction"),
             choice("channel", {"rgb", "r", "g", "b", "a", "luminance"})
                 .doc("all, or one of them as grey"),
             rgb("scale_value", 1).doc("multiplies what is looked up")}};
  }

  ImagePigment(const Values& v, Host& host)
      : mapping_(pick<Mapping>(v.text(kMapping), {"uv", "planar", "spherical"})),
        channel_(pick<Channel>(v.text(kChannel), {"rgb", "r", "g", "b", "a", "luminance"})),
        scale_(v.rgb(kScale)) {
    TextureRequest request;
    request.file = v.text(kFile);
    request.span = v.span(kFile);
    request.colourSpace = v.text(kColourSpace);
    request.wrapU = request.wrapV = pick<Wrap>(v.text(kWrap), {"repeat", "clamp", "mirror"});
    std::string error;
    texture_ = host.texture(request, error);
    if (!texture_) throw PluginError(kFile, error);
  }

  Rgba eval(const Lookup& at) const noexcept override {
    const Spot spot = mapping_ == Mapping::uv       ? byUv(at)
                      : mapping_ == Mapping::planar ? planar(at)
                                                    : spherical(at);
    return chosen(at.footprint.alongMajor ? lookupAlongMajor(*texture_, spot.uv, spot.dUv)
                                          : texture_->lookup(spot.uv, spot.dUv));
  }

  Rgba mean() const noexcept override { return chosen(texture_->mean()); }

  Vec2 texels() const noexcept override {
    if (mapping_ != Mapping::uv) return {};
    return {Real(texture_->width()), Real(texture_->height())};
  }

 private:
  enum Row { kFile, kWrap, kColourSpace, kMapping, kChannel, kScale };
  enum class Mapping { uv, planar, spherical };
  enum class Channel { rgb, r, g, b, a, luminance };

  /// The enumerator at the place of a word; the schema has refused other words.
  template <class Enum>
  static Enum pick(const std::string& word, std::initializer_list<const char*> words) {
    const auto at = std::find(words.begin(), words.end(), word);
    return Enum(at == words.end() ? 0 : at - words.begin());
  }

  Rgba chosen(Rgba c) const noexcept {
    switch (channel_) {
      case Channel::rgb:
        return {scale_ * c.colour, c.alpha};
      case Channel::r:
        return {c.colour.r * scale_, 1};
      case Channel::g:
        return {c.colour.g * scale_, 1};
      case Channel::b:
        return {c.colour.b * scale_, 1};
      case Channel::a:
        return {c.alpha * scale_, 1};
      case Channel::luminance:
        return {luminance(c.colour) * scale_, 1};
    }
    return c;
  }

  std::shared_ptr<const Texture> texture_;
  Mapping mapping_;
  Channel channel_;
  Rgb scale_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::ImagePigment)
