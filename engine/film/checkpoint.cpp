// SPDX-License-Identifier: Apache-2.0
// Layout: lines of text (what the file is, the label, the effort), then little-endian numbers:
// Film::storage() and a checksum of everything before it.
#include "engine/film/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <vestige/tools/regular_file.h>

namespace vestige {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "vestige checkpoint ";
constexpr int kLayout = 2;  ///< of the file; incremented when older files become unreadable
constexpr const char* kLastLine = "film";  ///< of the text
constexpr char kTab = '\t';                ///< between the name of a fact and its value
constexpr std::size_t kPiece = 1 << 20;    ///< bytes read at once

using Numbers = std::array<std::uint64_t, 6>;
static_assert(sizeof(Counters) == sizeof(Numbers), "the format has another number of counters");

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw std::runtime_error("checkpoint '" + path + "' " + why);
}

/// FNV-1a, 64 bits [Fowler, Noll, Vo].
class Checksum {
 public:
  void add(const void* data, std::size_t size) noexcept {
    for (std::size_t i = 0; i < size; ++i)
      value_ = (value_ ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// File names may hold any character.
std::string onOneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, '?');
  return text;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) (text += text.empty() ? "" : between) += word;
  return text;
}

/// "-32": exponents of two.
std::string unitsOf(const Film& film) {
  std::vector<std::string> units;
  for (const FilmLayer& l : film.layers()) units.push_back(std::to_string(std::ilogb(l.unit)));
  return units.empty() ? "empty" : joined(units, ",");
}

CheckpointLabel wholeLabel(const Film& film, CheckpointLabel label) {
  std::vector<std::string> size, crop, aovs;
  for (const int n : {film.width(), film.height()}) size.push_back(std::to_string(n));
  const Crop c = film.crop();
  for (const int n : {c.x0, c.y0, c.x1, c.y1}) crop.push_back(std::to_string(n));
  for (const FilmLayer& l : film.layers()) aovs.push_back(l.name);
  label.push_back({"the film's size", joined(size, " x ")});
  label.push_back({"the crop window", joined(crop, ",")});
  label.push_back({"the list of AOVs", aovs.empty() ? "empty" : joined(aovs, ",")});
  label.push_back({"the list of the AOVs' units", unitsOf(film)});
  for (CheckpointFact& f : label) f.what = onOneLine(f.what), f.value = onOneLine(f.value);
  return label;
}

/// A temporary file beside `path`: finish() renames it to `path`, otherwise it is deleted.
class Replacement {
 public:
  explicit Replacement(const std::string& path)
      : path_(path), partial_(path + ".part-" + std::to_string(getpid())) {
    file_ = open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file_ < 0) giveUp();
  }
  ~Replacement() {
    if (file_ >= 0) close(file_);
    if (!isDone_) unlink(partial_.c_str());
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  void write(const void* data, std::size_t size) {
    checksum_.add(data, size);
    const char* from = static_cast<const char*>(data);
    while (size > 0) {
      const ssize_t written = ::write(file_, from, size);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) giveUp();
      from += written, size -= std::size_t(written);
    }
  }

  void finish() {
    const std::uint64_t sum = checksum_.value();
    write(&sum, sizeof sum);
    if (fsync(file_) != 0 || close(std::exchange(file_, -1)) != 0) giveUp();
    if (std::rename(partial_.c_str(), path_.c_str()) != 0) giveUp();
    isDone_ = true;
    // The folder's entry must reach the disk too. Some file systems cannot do that; ignore them.
    const fs::path folder = fs::path(path_).parent_path();
    const int opened = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (opened < 0) return;
    fsync(opened);
    close(opened);
  }

 private:
  [[noreturn]] void giveUp() const {
    fail(path_, std::string("could not be written: ") + std::strerror(errno));
  }

  std::string path_, partial_;
  int file_ = -1;
  bool isDone_ = false;
  Checksum checksum_;
};

/// Whether the checksum is right. Then the stream is at its beginning again.
bool isWhole(std::ifstream& in, std::uintmax_t size) {
  std::uint64_t wanted = 0;
  if (size < sizeof wanted) return false;
  Checksum sum;
  std::vector<char> piece(kPiece);
  for (std::uintmax_t left = size - sizeof wanted; left > 0 && in;) {
    in.read(piece.data(), std::streamsize(std::min<std::uintmax_t>(left, kPiece)));
    sum.add(piece.data(), std::size_t(in.gcount()));
    left -= std::uintmax_t(in.gcount());
  }
  in.read(reinterpret_cast<char*>(&wanted), sizeof wanted);
  if (!in || wanted != sum.value()) return false;
  in.seekg(0);
  return true;
}

/// Throws unless the first line names the layout that this program writes.
void checkFirstLine(const std::string& line, const std::string& path) {
  const std::string name = kName;
  if (line == name + std::to_string(kLayout)) return;
  if (line.rfind(name, 0) != 0) fail(path, "is no checkpoint; choose another name");
  fail(path, "has layout " + onOneLine(line.substr(name.size(), 10)) +
                 ", and this version of the program reads layout " + std::to_string(kLayout) +
                 " only; delete it to begin anew, or choose another name");
}

std::uintmax_t bytesOf(const Film& film) {
  std::uintmax_t bytes = 0;
  for (const auto& part : film.storage()) bytes += part.size();
  return bytes;
}

CheckpointLabel readLabel(std::istream& in) {
  CheckpointLabel label;
  for (std::string line; in.peek() != kTab && std::getline(in, line);) {
    const std::size_t tab = line.find(kTab);
    if (tab == line.npos) break;
    label.push_back({line.substr(0, tab), line.substr(tab + 1)});
  }
  return label;
}

/// The first difference between the labels, for the user; "" if there is none.
std::string difference(const CheckpointLabel& then, const CheckpointLabel& now) {
  for (std::size_t i = 0; i < std::max(then.size(), now.size()); ++i) {
    if (i >= now.size()) return then[i].what + " is missing now";
    if (i >= then.size() || then[i].what != now[i].what) return now[i].what + " is new";
    if (then[i].value == now[i].value) continue;
    if (now[i].isFingerprint) return now[i].what + " has changed";
    return now[i].what + " was " + then[i].value + " and is " + now[i].value + " now";
  }
  return "";
}

}  // namespace

void saveCheckpoint(const Film& film, const CheckpointLabel& label, const Effort& effort,
                    const std::string& path) {
  std::ostringstream text;
  text.precision(17);
  text << kName << kLayout << '\n';
  for (const CheckpointFact& f : wholeLabel(film, label)) text << f.what << kTab << f.value << '\n';
  text << kTab << effort.seconds;
  for (const std::uint64_t n : std::bit_cast<Numbers>(effort.counters)) text << ' ' << n;
  text << '\n' << kLastLine << '\n';
  Replacement file(path);
  file.write(text.str().data(), text.str().size());
  for (const auto& part : film.storage()) file.write(part.data(), part.size());
  file.finish();
}

Effort loadCheckpoint(Film& film, const CheckpointLabel& label, const std::string& path) {
  std::string why;
  std::ifstream in = openRegular(path, why);
  if (!in) fail(path, "cannot be read: it " + why);
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  std::string line;
  std::getline(in, line);
  checkFirstLine(line, path);
  in.seekg(0);
  if (!isWhole(in, size))
    fail(path, "is damaged, or only the beginning of one; delete it to begin anew");
  std::getline(in, line);
  if (const std::string what = difference(readLabel(in), wholeLabel(film, label)); !what.empty())
    fail(path,
         "is of another render: " + what + "; delete it to begin anew, or choose another name");
  Effort effort;
  Numbers counters{};
  in >> effort.seconds;
  for (std::uint64_t& n : counters) in >> n;
  in >> line;
  in.get();
  if (!in || line != kLastLine ||
      std::uintmax_t(in.tellg()) + bytesOf(film) + sizeof(std::uint64_t) != size)
    fail(path, "is damaged; delete it to begin anew");
  for (const auto& part : film.storage())
    in.read(reinterpret_cast<char*>(part.data()), std::streamsize(part.size()));
  if (!in) fail(path, std::string("cannot be read: ") + std::strerror(errno));
  effort.counters = std::bit_cast<Counters>(counters);
  return effort;
}

}  // namespace vestige
