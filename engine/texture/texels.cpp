// SPDX-License-Identifier: Apache-2.0
#include "engine/texture/texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <type_traits>

#include "engine/files/fingerprint.h"
#include "engine/picture/picture_file.h"
#include "engine/texture/decode.h"

namespace vestige {

namespace {

/// Which channels of a file make the texture, in the order grey/RGB, alpha.
std::vector<int> chooseChannels(const OIIO::ImageSpec& spec) {
  const int r = spec.channelindex("R"), g = spec.channelindex("G"), b = spec.channelindex("B");
  std::vector<int> list;
  const bool rgb = r >= 0 && g >= 0 && b >= 0;
  if (rgb)
    list = {r, g, b};
  else
    for (int c = 0; c < spec.nchannels && list.size() < 3; ++c)
      if (c != spec.alpha_channel) list.push_back(c);
  if (list.empty()) list = {0};  // nothing but alpha
  if (list.size() == 2) list.pop_back();
  if (spec.alpha_channel >= 0 && spec.alpha_channel != list[0]) list.push_back(spec.alpha_channel);
  return list;
}

/// Keeps the channels of `list` (indices) out of `from` interleaved ones, in that order.
template <class Code>
void keepChannels(std::vector<Code>& codes, int from, const std::vector<int>& list) {
  bool asTheyAre = int(list.size()) == from;
  for (std::size_t i = 0; i < list.size(); ++i) asTheyAre = asTheyAre && list[i] == int(i);
  if (asTheyAre) return;
  const std::size_t pixels = codes.size() / from, to = list.size();
  std::vector<Code> kept(pixels * to);
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t c = 0; c < to; ++c) kept[p * to + c] = codes[p * from + list[c]];
  codes = std::move(kept);
}

/// Reads the chosen channels as Code.
template <class Code>
bool readCodes(OIIO::ImageInput& input, const std::string& file, std::vector<int> list,
               OIIO::TypeDesc format, std::vector<Code>& codes, std::string& error) {
  const OIIO::ImageSpec& spec = input.spec();
  const auto [low, high] = std::minmax_element(list.begin(), list.end());
  const int begin = *low, count = *high - *low + 1;
  const long long values = (long long)spec.width * spec.height * count;
  if (values * (long long)sizeof(Code) > kMaxPictureBytes) throw std::bad_alloc();
  codes.resize(std::size_t(values));
  if (!readPicture(input, file, begin, begin + count, format, codes.data(), error)) return false;
  for (int& c : list) c -= begin;
  keepChannels(codes, count, list);
  return true;
}

/// Codes were multiplied by alpha when the file was written: divides them again, as codes.
template <class Code>
void divideByAlpha(std::vector<Code>& codes, int channels) {
  for (std::size_t i = 0; i < codes.size(); i += channels) {
    const double alpha = double(codes[i + channels - 1]);
    if (!(alpha > 0)) continue;
    for (int c = 0; c < channels - 1; ++c) {
      Code& code = codes[i + c];
      if constexpr (std::is_same_v<Code, float>)
        code = float(code / alpha);
      else
        code = Code(std::min<double>(code / alpha, 1) * std::numeric_limits<Code>::max() + 0.5);
    }
  }
}

std::size_t zeroNonFinite(std::vector<float>& values) {
  std::size_t count = 0;
  for (float& x : values)
    if (!std::isfinite(x)) x = 0, ++count;
  return count;
}

template <class Code>
float decoded(const TexelArray<Code>& array, std::size_t i, bool alpha) {
  if constexpr (std::is_same_v<Code, float>)
    return array.codes[i];
  else
    return (*(alpha ? array.alpha : array.colour))[array.codes[i]];
}

/// Fills Texels::mean and bytes.
template <class Code>
void summarise(Texels& t, const TexelArray<Code>& array) {
  double sum[4] = {};
  const int colours = t.hasAlpha() ? t.channels - 1 : t.channels;
  for (std::size_t i = 0; i < array.codes.size(); i += t.channels)
    for (int c = 0; c < t.channels; ++c) sum[c] += decoded(array, i + c, c >= colours);
  const double n = double(t.width) * t.height;
  const auto at = [&](int c) { return Real(sum[c] / n); };
  t.mean.colour = colours == 1 ? grey(at(0)) : Rgb{at(0), at(1), at(2)};
  t.mean.alpha = t.hasAlpha() ? at(colours) : Real(1);
  t.bytes = array.codes.size() * sizeof(Code);
}

/// `unit`: the tables end at 1.
template <class Code>
void addPyramid(Texels& t, const TexelArray<Code>& array, bool unit) {
  const int n = t.channels, colours = t.hasAlpha() ? n - 1 : n;
  const std::size_t length = std::size_t(t.width) * n;
  t.pyramid = makePyramid(t.width, t.height, n, unit, [&](std::int32_t y, float* row) {
    const std::size_t start = std::size_t(t.height - 1 - y) * length;
    for (std::size_t i = 0; i < length; ++i)
      row[i] = decoded(array, start + i, int(i % n) >= colours);
  });
  t.bytes += t.pyramid.bytes();
}

/// One texture on its way from file to memory.
struct Loading {
  OIIO::ImageInput& input;
  const std::string& file;
  const Encoding& encoding;
  std::vector<int> channels;
  bool premultiplied;
  Texels& texels;
  std::string& error;

  /// uint8_t or uint16_t, kept as they are.
  template <class Code>
  bool integers(OIIO::TypeDesc format) {
    TexelArray<Code> array;
    if (!readCodes(input, file, channels, format, array.codes, error)) return false;
    if (premultiplied) divideByAlpha(array.codes, texels.channels);
    array.colour = integerTable(8 * sizeof(Code), encoding);
    array.alpha = integerTable(8 * sizeof(Code), {});
    return keep(std::move(array), true);
  }

  /// Halfs, kept as their bits.
  bool halfs() {
    TexelArray<std::uint16_t> array;
    if (!readCodes(input, file, channels, OIIO::TypeHalf, array.codes, error)) return false;
    for (const std::uint16_t code : array.codes)
      texels.nonFinite += (code & 0x7c00) == 0x7c00;  // exponent all ones: infinity or NaN
    array.colour = halfTable(encoding);
    array.alpha = halfTable({});
    return keep(std::move(array));
  }

  /// Converted through float; kept as halfs if the file has no more precision, else as float.
  bool floats(bool asHalfs) {
    TexelArray<float> array;
    if (!readCodes(input, file, channels, OIIO::TypeFloat, array.codes, error)) return false;
    texels.nonFinite = zeroNonFinite(array.codes);
    if (premultiplied) divideByAlpha(array.codes, texels.channels);
    decodeFloats(array.codes);
    if (!asHalfs) return keep(std::move(array));
    return keep(halved(array.codes));
  }

 private:
  void decodeFloats(std::vector<float>& values) const {
    if (encoding.kind == Encoding::Kind::linear) return;
    const int n = texels.channels, colours = n - (texels.hasAlpha() ? 1 : 0);
    const std::size_t row = std::size_t(texels.width);
    std::vector<float> rgb(row * 3);
    for (std::size_t start = 0; start < values.size(); start += row * n) {
      for (std::size_t i = 0; i < row * 3; ++i)
        rgb[i] = values[start + i / 3 * n + (colours == 3 ? i % 3 : 0)];
      decodeColours(encoding, rgb.data(), row);
      for (std::size_t x = 0; x < row; ++x)
        for (int c = 0; c < colours; ++c) values[start + x * n + c] = rgb[x * 3 + c];
    }
  }

  TexelArray<std::uint16_t> halved(std::vector<float>& values) const {
    constexpr float kLargestHalf = 65504;
    TexelArray<std::uint16_t> array;
    array.codes.resize(values.size());
    array.colour = array.alpha = halfTable({});
    const std::size_t row = std::size_t(texels.width) * texels.channels;
    for (float& x : values) x = std::clamp(x, -kLargestHalf, kLargestHalf);
    for (std::size_t start = 0; start < values.size(); start += row)  // its count is an int
      OIIO::convert_pixel_values(OIIO::TypeFloat, &values[start], OIIO::TypeHalf,
                                 &array.codes[start], int(row));
    return array;
  }

  template <class Code>
  bool keep(TexelArray<Code>&& array, bool unit = false) {
    summarise(texels, array);
    addPyramid(texels, array, unit);
    texels.data = std::move(array);
    return true;
  }
};

/// The smallest form that loses nothing the file has.
Storage storageOf(OIIO::TypeDesc format, bool mixesChannels) {
  switch (format.basetype) {
    case OIIO::TypeDesc::UINT8:
      return mixesChannels ? Storage::halfs : Storage::bytes;
    case OIIO::TypeDesc::UINT16:
      return mixesChannels ? Storage::floats : Storage::shorts;
    case OIIO::TypeDesc::HALF:
      return Storage::halfs;
    default:
      return Storage::floats;
  }
}

bool load(Loading& loading, OIIO::TypeDesc format) {
  const bool mixes = loading.encoding.kind == Encoding::Kind::config;
  switch (storageOf(format, mixes)) {
    case Storage::bytes:
      return loading.integers<std::uint8_t>(OIIO::TypeUInt8);
    case Storage::shorts:
      return loading.integers<std::uint16_t>(OIIO::TypeUInt16);
    case Storage::halfs:
      return mixes || loading.premultiplied ? loading.floats(true) : loading.halfs();
    default:
      return loading.floats(false);
  }
}

/// Bytes of the full resolution and the pyramid.
std::size_t bytesFor(const TexelPlan& p) {
  const std::size_t code = p.storage == Storage::bytes    ? 1
                           : p.storage == Storage::floats ? sizeof(float)
                                                          : sizeof(std::uint16_t);
  const std::size_t level = p.isInteger() ? sizeof(std::uint16_t) : sizeof(float);
  return std::size_t(p.width) * p.height * p.channels * code +
         pyramidNumbers(pyramidLevels(p.width, p.height, p.channels), p.channels) * level;
}

/// A description of the encoding. For a transform of the colour config it includes the results for
/// a grid of colours, because a config may change under the same name.
std::string keyOf(const Encoding& e) {
  std::string key = fmt::format("{} {}", int(e.kind), e.exponent);
  if (e.kind != Encoding::Kind::config) return key;
  constexpr int kSide = 17;
  std::vector<float> grid;
  for (const float most : {1.f, 64.f})
    for (int i = 0; i < kSide * kSide * kSide; ++i)
      for (const int k : {i % kSide, i / kSide % kSide, i / (kSide * kSide)})
        grid.push_back(most * float(k) / (kSide - 1));
  e.transform->apply(grid.data(), grid.size() / 3, 3);
  return key + ' ' + fingerprint(grid.data(), grid.size() * sizeof(float));
}

}  // namespace

std::optional<TexelPlan> planTexels(const std::string& file, const std::string& colourSpace,
                                    std::string& error) {
  const auto input = openPicture(file, error);
  Encoding encoding;
  if (!input || !chooseEncoding(input->spec(), colourSpace, encoding, error)) return std::nullopt;
  const OIIO::ImageSpec& spec = input->spec();
  TexelPlan p;
  p.width = spec.width, p.height = spec.height;
  p.channels = int(chooseChannels(spec).size());
  p.storage = storageOf(spec.format, encoding.kind == Encoding::Kind::config);
  p.bytes = bytesFor(p);
  p.colourKey = keyOf(encoding);
  if (p.isInteger()) {
    const int bits = p.storage == Storage::bytes ? 8 : 16;
    p.colour = integerTable(bits, encoding), p.alpha = integerTable(bits, {});
  }
  return p;
}

std::shared_ptr<const Texels> loadTexels(const std::string& file, const std::string& colourSpace,
                                         std::string& error) {
  const auto input = openPicture(file, error);
  Encoding encoding;
  if (!input || !chooseEncoding(input->spec(), colourSpace, encoding, error)) return nullptr;
  const OIIO::ImageSpec spec = input->spec();
  auto texels = std::make_shared<Texels>();
  texels->width = spec.width, texels->height = spec.height;
  const std::vector<int> channels = chooseChannels(spec);
  texels->channels = int(channels.size());
  const bool premultiplied =
      texels->hasAlpha() && !spec.get_int_attribute("oiio:UnassociatedAlpha", 0);
  Loading loading{*input, file, encoding, channels, premultiplied, *texels, error};
  try {
    if (!load(loading, spec.format)) return nullptr;
  } catch (const std::bad_alloc&) {
    error = fmt::format("the picture '{}' ({} x {} pixels) does not fit into memory", file,
                        spec.width, spec.height);
    return nullptr;
  }
  return texels;
}

}  // namespace vestige
