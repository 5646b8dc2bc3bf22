// SPDX-License-Identifier: Apache-2.0
#include "engine/texture/texture_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>
#include <locale>
#include <sstream>
#include <type_traits>
#include <vector>

#include "engine/picture/picture_file.h"

namespace vestige {

namespace fs = std::filesystem;

namespace {

std::string title() { return fmt::format("vestige texture {}", kTextureFileVersion); }

/// Stored in TIFF's only free text field. Numbers are written with all digits.
std::string description(const Texels& t, const std::string& key) {
  return fmt::format("{}\n{}\n{} {} {} {}\n{}\n", title(), key, t.mean.colour.r, t.mean.colour.g,
                     t.mean.colour.b, t.mean.alpha, t.nonFinite);
}

std::optional<TextureFacts> parsed(const std::string& text, const std::string& key) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::string first, second;
  TextureFacts f;
  std::getline(in, first), std::getline(in, second);
  in >> f.mean.colour.r >> f.mean.colour.g >> f.mean.colour.b >> f.mean.alpha >> f.nonFinite;
  if (!in || first != title() || second != key) return std::nullopt;
  return f;
}

template <class Number>
constexpr OIIO::TypeDesc::BASETYPE kFormat =
    std::is_same_v<Number, float> ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT16;

OIIO::ImageSpec specOf(int width, int height, int channels, OIIO::TypeDesc format) {
  OIIO::ImageSpec spec(width, height, channels, format);
  spec.tile_width = spec.tile_height = kTileSide;
  spec.tile_depth = 1;
  // Numbers, not colours: nothing must be multiplied by what looks like alpha.
  spec.alpha_channel = -1;
  for (int c = 0; c < channels; ++c) spec.channelnames[std::size_t(c)] = fmt::format("c{}", c);
  spec.attribute("textureformat", "Plain Texture");  // its pictures are levels of one
  spec.attribute("compression", "zip");
  // The library decides by the first level alone, and all of them may exceed the 4 GB of plain
  // TIFF.
  spec.attribute("tiff:bigtiff", 1);
  return spec;
}

/// Writes [width][channels] numbers of a row, counted from the top.
template <class Number>
using FillRow = std::function<void(int y, Number* row)>;

/// A row of tiles at a time. What lies beyond the edge is 0: left to the library it would be
/// whatever memory held. False if the library fails.
template <class Number>
bool writeLevel(OIIO::ImageOutput& out, const FillRow<Number>& fillRow) {
  const OIIO::ImageSpec spec = out.spec();
  const std::size_t side = std::size_t(kTileSide) * spec.nchannels;  // of a tile, in numbers
  const std::size_t columns = std::size_t((spec.width + kTileSide - 1) / kTileSide);
  std::vector<Number> rows(side * columns * kTileSide), tile(side * kTileSide);
  for (int y = 0; y < spec.height; y += kTileSide) {
    std::fill(rows.begin(), rows.end(), Number(0));
    for (int i = y; i < std::min(y + kTileSide, spec.height); ++i)
      fillRow(i, &rows[side * columns * (i - y)]);
    for (std::size_t x = 0; x < columns; ++x) {
      for (std::size_t i = 0; i < kTileSide; ++i)
        std::copy_n(&rows[side * (columns * i + x)], side, &tile[side * i]);
      if (!out.write_tile(int(x) * kTileSide, y, 0, kFormat<Number>, tile.data())) return false;
    }
  }
  return true;
}

/// Number: of all levels.
template <class Number>
bool writeLevels(OIIO::ImageOutput& out, const std::string& file, const Texels& t,
                 const std::string& key, const FillRow<Number>& fullRow) {
  OIIO::ImageSpec spec = specOf(t.width, t.height, t.channels, kFormat<Number>);
  spec.attribute("ImageDescription", description(t, key));
  if (!out.open(file, spec) || !writeLevel(out, fullRow)) return false;
  const auto& numbers = std::get<std::vector<Number>>(t.pyramid.texels);
  for (const Level& level : t.pyramid.levels) {
    const int width = level.width + 2, height = level.height + 2;
    const std::size_t row = std::size_t(width) * t.channels;
    const FillRow<Number> fill = [&](int y, Number* to) {
      std::copy_n(&numbers[level.start + row * (height - 1 - y)], row, to);
    };
    if (!out.open(file, specOf(width, height, t.channels, kFormat<Number>),
                  OIIO::ImageOutput::AppendSubimage) ||
        !writeLevel(out, fill))
      return false;
  }
  return out.close();
}

/// Whichever kind of codes the texture has.
bool writeAll(OIIO::ImageOutput& out, const std::string& file, const Texels& t,
              const std::string& key) {
  const std::size_t row = std::size_t(t.width) * t.channels;
  const auto write = [&]<class Code>(const TexelArray<Code>& array) {
    const Code* codes = array.codes.data();
    if (std::holds_alternative<std::vector<std::uint16_t>>(t.pyramid.texels))
      return writeLevels<std::uint16_t>(out, file, t, key, [=](int y, std::uint16_t* to) {
        for (std::size_t i = 0; i < row; ++i) to[i] = std::uint16_t(codes[y * row + i]);
      });
    const int channels = t.channels, colours = channels - (t.hasAlpha() ? 1 : 0);
    return writeLevels<float>(out, file, t, key, [&, codes](int y, float* to) {
      for (std::size_t i = 0; i < row; ++i)
        if constexpr (std::is_same_v<Code, float>)
          to[i] = codes[y * row + i];
        else
          to[i] = (*(int(i % channels) < colours ? array.colour : array.alpha))[codes[y * row + i]];
    });
  };
  return std::visit(write, t.data);
}

/// Waits until the file's bytes are on the disk, so that no crash leaves a name without contents.
bool reachesDisk(const std::string& file) {
  const int fd = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = fd >= 0 && (fsync(fd) == 0 || errno == EINVAL);  // EINVAL: cannot be synced
  if (fd >= 0) close(fd);
  return synced;
}

/// Drafts of programs that were killed while they wrote.
void sweep(const fs::path& folder) {
  const auto yesterday = fs::file_time_type::clock::now() - std::chrono::hours(24);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".part" && entry.last_write_time(ignored) < yesterday)
      fs::remove(entry.path(), ignored);
}

}  // namespace

bool writeTextureFile(const std::string& file, const Texels& texels, const TexelPlan& plan,
                      const std::string& key, std::string& why) {
  const fs::path folder = fs::path(file).parent_path();
  static std::atomic<int> count = 0;
  const std::string draft = fmt::format("{}.{}-{}.part", file, getpid(), ++count);
  sweep(folder);
  const auto out = OIIO::ImageOutput::create("tif");
  if (!out)
    why = "this OpenImageIO cannot write TIFF";
  else if (!writeAll(*out, draft, texels, key) || !reachesDisk(draft))
    why = out->has_error() ? reason(out->geterror(), draft) : "it could not be written";
  std::error_code code;
  // Some writers report success on a full disk, so the file is checked again.
  if (why.empty() && !readTextureFile(draft, plan, key)) why = "it came out incomplete";
  if (!why.empty() && fs::space(folder, code).available < plan.bytes && !code)
    why = "the disk is full";
  if (why.empty()) {
    fs::rename(draft, file, code);
    if (code) why = code.message();
  }
  if (!why.empty()) fs::remove(draft, code);
  return why.empty();
}

std::optional<TextureFacts> readTextureFile(const std::string& file, const TexelPlan& plan,
                                            const std::string& key) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) {
    OIIO::geterror();  // cleared, so that it is not reported with a later error
    return std::nullopt;
  }
  const auto format = plan.isInteger() ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
  std::vector<float> tile(std::size_t(kTileSide) * kTileSide * plan.channels);
  const auto isLevel = [&](int index, int width, int height) {
    const OIIO::ImageSpec s = input->spec(0, index);
    if (s.width != width || s.height != height || s.nchannels != plan.channels ||
        s.format != format || s.tile_width != kTileSide || s.tile_height != kTileSide ||
        s.depth > 1 || s.x != 0 || s.y != 0)
      return false;
    // A truncated file lacks the last tile of some level, even if all headers are complete.
    const int x = (width - 1) / kTileSide * kTileSide, y = (height - 1) / kTileSide * kTileSide;
    return input->read_native_tile(0, index, x, y, 0, tile.data());
  };
  const auto facts = parsed(input->spec().get_string_attribute("ImageDescription"), key);
  if (!facts || !isLevel(0, plan.width, plan.height)) return std::nullopt;
  const auto levels = pyramidLevels(plan.width, plan.height, plan.channels);
  for (int i = 0; i < levels.size(); ++i)
    if (!isLevel(i + 1, levels[i].width + 2, levels[i].height + 2)) return std::nullopt;
  return facts;
}

}  // namespace vestige
