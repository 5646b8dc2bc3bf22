// SPDX-License-Identifier: Apache-2.0
#include "engine/texture/decode.h"

#include <OpenImageIO/strutil.h>

#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <tuple>

namespace vestige {

namespace {

Encoding byMetadata(const OIIO::ImageSpec& spec) {
  if (spec.format.is_floating_point()) return {};
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const float gamma = spec.get_float_attribute("oiio:Gamma", 0);
  if (OIIO::Strutil::iequals(space, "linear") || OIIO::Strutil::iequals(space, "scene_linear"))
    return {};
  if (OIIO::Strutil::istarts_with(space, "Gamma") && gamma > 0) {
    // 1/2.2 is what writers of sRGB pictures put into a gAMA chunk; other exponents mean it.
    if (std::abs(gamma - 2.2f) < 0.01f) return {Encoding::Kind::srgb, 1, nullptr};
    return {Encoding::Kind::power, gamma, nullptr};
  }
  return {Encoding::Kind::srgb, 1, nullptr};
}

double decode(double code, const Encoding& e) {
  switch (e.kind) {
    case Encoding::Kind::srgb:
      return decodeSrgb(code);
    case Encoding::Kind::power:
      return std::pow(std::max(code, 0.0), e.exponent);
    case Encoding::Kind::linear:
    case Encoding::Kind::config:
      break;
  }
  return code;
}

DecodeTable makeIntegerTable(int bits, const Encoding& e) {
  DecodeTable table(std::size_t(1) << bits);
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = float(decode(double(i) / double(table.size() - 1), e));
  return table;
}

DecodeTable makeHalfTable(const Encoding& e) {
  std::vector<std::uint16_t> bits(65536);
  std::iota(bits.begin(), bits.end(), std::uint16_t(0));
  DecodeTable table(65536);
  OIIO::convert_pixel_values(OIIO::TypeHalf, bits.data(), OIIO::TypeFloat, table.data(), 65536);
  for (float& x : table) x = std::isfinite(x) ? float(decode(x, e)) : 0.f;
  return table;
}

/// Each table is created once and destroyed with the last texture that uses it.
template <class Make>
std::shared_ptr<const DecodeTable> shared(int bits, bool half, const Encoding& e, Make make) {
  static std::mutex mutex;
  static std::map<std::tuple<int, bool, Encoding::Kind, double>, std::weak_ptr<const DecodeTable>>
      tables;
  const auto kind = e.kind == Encoding::Kind::config ? Encoding::Kind::linear : e.kind;
  const std::lock_guard lock(mutex);
  auto& known = tables[{bits, half, kind, e.exponent}];
  auto table = known.lock();
  if (!table) known = table = std::make_shared<const DecodeTable>(make());
  return table;
}

}  // namespace

bool chooseEncoding(const OIIO::ImageSpec& spec, const std::string& colourSpace, Encoding& encoding,
                    std::string& error) {
  using OIIO::Strutil::iequals;
  encoding = {};
  if (colourSpace.empty())
    encoding = byMetadata(spec);
  else if (iequals(colourSpace, "srgb"))
    encoding.kind = Encoding::Kind::srgb;
  else if (!iequals(colourSpace, "raw") && !iequals(colourSpace, "linear")) {
    encoding.transform = fromColourSpace(colourSpace, error);
    if (!encoding.transform) return false;
    if (!encoding.transform->isIdentity()) encoding.kind = Encoding::Kind::config;
  }
  return true;
}

std::shared_ptr<const DecodeTable> integerTable(int bits, const Encoding& e) {
  return shared(bits, false, e, [&] { return makeIntegerTable(bits, e); });
}
std::shared_ptr<const DecodeTable> halfTable(const Encoding& e) {
  return shared(16, true, e, [&] { return makeHalfTable(e); });
}

void decodeColours(const Encoding& encoding, float* rgb, std::size_t pixels) {
  if (encoding.kind == Encoding::Kind::config)
    encoding.transform->apply(rgb, pixels, 3);
  else
    for (std::size_t i = 0; i < 3 * pixels; ++i) rgb[i] = float(decode(rgb[i], encoding));
}

}  // namespace vestige
