// SPDX-License-Identifier: Apache-2.0
// Pictures in memory, and how they come from and go to files. OpenImageIO stays behind this header.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <vestige/host.h>

namespace vestige {

/// Float channels, interleaved, row 0 at the top. "R", "G", "B" first; AOVs are "normal.X", ...
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<float> pixels;                    ///< [height][width][channels]
  std::map<std::string, std::string> metadata;  ///< written as string attributes to EXR

  float* at(int x, int y) { return &pixels[(std::size_t(y) * width + x) * channels.size()]; }
  const float* at(int x, int y) const {
    return &pixels[(std::size_t(y) * width + x) * channels.size()];
  }
};

/// Any format that OpenImageIO reads, without colour conversion; nullopt-like: empty() width and
/// `error`.
Image readImage(const std::string& file, std::string& error);

/// How a picture for looking at is made from linear radiance.
struct Display {
  double exposure = 0;       ///< stops
  std::string view = "";     ///< "" the config's default ("Standard"), "ACES 1.0 SDR", "Raw"
  std::string display = "";  ///< "" the config's default
};
/// Displays of the colour config in use and their views, the defaults first; empty with `error` if
/// it cannot be read.
struct DisplayViews {
  std::string display;
  std::vector<std::string> views;
};
std::vector<DisplayViews> displayViews(std::string& error);
/// From radiance to code values of the display, in place: `count` pixels of which the first three
/// of `stride` numbers are R, G, B. Not clamped. False with `error` for an unknown view.
bool applyDisplay(const Display& display, float* pixels, std::size_t count, int stride,
                  std::string& error);
/// The same but the exposure as GLSL 1.30: a function `vec4 displayed(vec4 radiance)`. "" with
/// `error` where the view is unknown or needs tables, which only applyDisplay() has.
std::string displayShader(const Display& display, std::string& error);

struct WriteOptions {
  Display display;         ///< for PNG, JPEG and other integer formats
  bool halfFloat = false;  ///< for EXR
};
/// By the ending: EXR, HDR, TIFF linear with all channels; PNG, JPEG RGB through OpenColorIO.
/// Writes beside the target and renames, so that a full disk never leaves half a picture under its
/// name. False with `error` in the user's words.
bool writeImage(const std::string& file, const Image& image, const WriteOptions& options,
                std::string& error);

/// Whether writeImage() could work: known ending, folder exists and may be written. Asked before
/// rendering.
bool canWrite(const std::string& file, std::string& error);

/// What textures cost, and what went wrong with them.
struct TextureUse {
  std::size_t held = 0;        ///< bytes of textures that are in memory whole
  int paged = 0;               ///< how many are read from files piece by piece
  std::size_t pagedLimit = 0;  ///< bytes that their pieces may take together; 0: none is paged
  std::size_t pagedUsed = 0;   ///< bytes that they take now
  std::size_t readErrors = 0;  ///< pieces that could not be read; the texture's mean was seen there
  std::string unreadable;      ///< one file of those
  int taken = 0, made = 0;     ///< pictures that came from another store, and that were read
};

/// Reads textures once, converts them to rendering space (linear Rec. 709) by their metadata or the
/// named colour space. In order of request they are held in memory as long as the budget has room
/// for the whole of one; others are paged: written into the cache folder once, as .tx, and read
/// from there when looked up. Lookups give the same bits either way.
class TextureStore {
 public:
  static constexpr std::size_t kDefaultBudget = std::size_t(4) << 30;

  TextureStore();
  ~TextureStore();
  /// Bytes for all textures together, for those requested from now on. Paged ones share what is
  /// left of it, but never less than 32 MB.
  void setBudget(std::size_t bytes);
  /// `file` is an absolute name. The same object for the same request; null with `error`. What
  /// another store, `before`, has of a file that has not changed since is not read again: held
  /// texels are shared. What is held and what is paged is as without it.
  std::shared_ptr<const Texture> texture(const std::string& file, const TextureRequest& request,
                                         std::string& error, const TextureStore* before = nullptr);
  /// What the user should know of the last texture though it was loaded, or "".
  std::string takeWarning();
  TextureUse use() const;
  /// Bytes held by all textures but paged ones.
  std::size_t bytes() const;
  /// How many files, once for each colour space they are read in.
  std::size_t pictures() const;
  /// Numbers in all textures that were NaN or infinite; they read as 0.
  std::size_t nonFinite() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// How two pictures differ.
struct Comparison {
  double rmse;             ///< over pixels and channels R, G, B
  double relMse;           ///< mean of (a-b)^2 / (b^2 + 0.01), b the reference
  double relMseTrimmed;    ///< the same without the worst 0.1 % of pixels
  double meanRatio[3];     ///< mean of a / mean of b
  double blockDifference;  ///< mean of |a - b| / (b + 0.01) over 16 x 16 block means
  double flip;             ///< mean of the perceptual difference picture, [0, 1]
};
/// Pictures of the same size only; `difference`, if not null, receives the difference picture.
Comparison compareImages(const Image& a, const Image& reference, Image* difference);

/// Name and version of the image and colour libraries, for --version.
std::string imageLibraryVersions();

}  // namespace vestige
