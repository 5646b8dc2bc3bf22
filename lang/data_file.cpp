// SPDX-License-Identifier: Apache-2.0
#include "lang/data_file.h"

#include <filesystem>
#include <utility>

#include <vestige/tools/regular_file.h>

#include "lang/write_below.h"

namespace vestige::lang {
namespace {

namespace fs = std::filesystem;

std::string keyOf(const std::string& name) { return fs::path(name).lexically_normal().string(); }

}  // namespace

DataFilePtr DataFiles::open(const std::string& name, DataFile::Mode mode, int asking,
                            const Span& span) {
  context_.step(span, kFileSteps);
  auto file = std::make_shared<DataFile>();
  file->mode = mode;
  file->name = name;
  if (isBeingWritten(keyOf(name))) {
    context_.reporter.error(span, "'" + name + "' is being written: #fclose it first");
    return nullptr;
  }
  const bool isOpen =
      file->isWritten() ? openToWrite(*file, span) : openToRead(*file, asking, span);
  if (!isOpen) return nullptr;
  if (file->isWritten()) {
    context_.budget.reserveOne(span, open_);
    open_.push_back(file);
  }
  return file;
}

bool DataFiles::isBeingWritten(const std::string& key) const {
  return std::any_of(open_.begin(), open_.end(),
                     [&](const DataFilePtr& f) { return keyOf(f->name) == key; });
}

// ---------------------------------------------------------------- to write
bool DataFiles::mayWrite(const std::string& name, const Span& span) {
  const fs::path path(name);
  const bool leaves =
      std::any_of(path.begin(), path.end(), [](const auto& p) { return p == ".."; });
  if (context_.options.writeFolder.empty())
    context_.reporter.error(span, "this scene writes the file '" + name +
                                      "': --write-folder DIR allows it, in that folder only");
  else if (path.is_absolute() || leaves || !path.has_filename())
    context_.reporter.error(span, "'" + name + "' is no file below the folder of --write-folder: " +
                                      "give a name without '..' and without a leading '/'");
  else
    return true;
  return false;
}

/// The file is made at once, so that an error appears where it is opened.
bool DataFiles::openToWrite(DataFile& file, const Span& span) {
  if (!mayWrite(file.name, span)) return false;
  const std::string key = keyOf(file.name);
  if (file.mode == DataFile::Mode::append) {
    const auto before = written_.find(key);
    std::string why;
    std::optional<std::string> text;
    if (before != written_.end())
      text = before->second.text;
    else if (const std::string path = below(file.name); !path.empty())
      text = readRegular(path, std::uintmax_t(context_.options.limits.memory), why);
    if (!why.empty()) {
      context_.reporter.error(span, "'" + file.name + "' " + why);
      return false;
    }
    if (text) write(file, *text, span);
  }
  return save(key, file.text, span);
}

void DataFiles::write(DataFile& file, const std::string& part, const Span& span) {
  context_.budget.copy(span, part.size());
  context_.budget.need(span, 2.0 * double(file.text.size() + part.size()));  // grows by doubling
  if (file.bytes.isEmpty()) file.bytes = context_.budget.take(span, 0);
  file.bytes.grow(std::int64_t(part.size()));
  file.text += part;
}

void DataFiles::close(DataFile& file, const Span& span) {
  if (!std::exchange(file.isOpen, false) || !file.isWritten()) return;
  const std::string key = keyOf(file.name);
  save(key, file.text, span);
  written_[key] = {std::move(file.text), std::move(file.bytes)};
  open_.erase(std::remove_if(open_.begin(), open_.end(),
                             [&](const DataFilePtr& f) { return f.get() == &file; }),
              open_.end());
}

void DataFiles::closeAll() {
  while (!open_.empty()) {
    const DataFilePtr last = open_.back();
    close(*last, {});
  }
}

bool DataFiles::save(const std::string& key, const std::string& text, const Span& span) {
  if (!context_.options.writes) return true;
  std::string why;
  if (writeBelow(context_.options.writeFolder, key, text, why)) return true;
  context_.reporter.error(
      span, "cannot write '" + key + "' below '" + context_.options.writeFolder + "': " + why);
  return false;
}

// ---------------------------------------------------------------- to read
/// The path of a file in the write folder, or "" if there is none that may be read.
std::string DataFiles::below(const std::string& name) const {
  const std::string& folder = context_.options.writeFolder;
  if (folder.empty() || fs::path(name).is_absolute()) return {};
  const std::string path = (fs::path(folder) / name).lexically_normal().string();
  std::error_code error;
  return fs::is_regular_file(path, error) && isBelowFolder(path, folder) ? path : std::string();
}

bool DataFiles::openToRead(DataFile& file, int asking, const Span& span) {
  const auto written = written_.find(keyOf(file.name));
  std::vector<std::string> tried;
  std::string path = below(file.name), why;
  std::optional<std::string> text;
  if (written != written_.end()) {
    path = file.name;
    text = written->second.text;
  } else {
    const bool isBelow = !path.empty();
    if (!isBelow) path = includes_.find(file.name, asking, tried);
    if (path.empty()) {
      includes_.missing("no file '" + file.name + "' to read", span, tried);
      return false;
    }
    if (!isBelow && !includes_.isAllowed(path)) {
      context_.reporter.error(span, Includes::outside(path));
      return false;
    }
    text = readRegular(path, std::uintmax_t(context_.options.limits.memory), why);
    if (!text) context_.reporter.error(span, "the file '" + path + "' " + why);
    if (!text) return false;
  }
  context_.budget.copy(span, text->size());
  const auto before = texts_.find(path);
  const bool isKnown =
      before != texts_.end() && context_.sources.text(before->second.file).text == *text;
  if (!isKnown) texts_[path] = includes_.add(path, std::move(*text));
  file.tokens = texts_[path].tokens;
  return true;
}

bool DataFiles::exists(const std::string& name) const {
  return written_.count(keyOf(name)) > 0 || !below(name).empty();
}

}  // namespace vestige::lang
