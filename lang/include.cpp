// SPDX-License-Identifier: Apache-2.0
#include "lang/include.h"

#include <filesystem>

#include "lang/text_store.h"

namespace vestige::lang {
namespace {

namespace fs = std::filesystem;

bool isBelow(const fs::path& path, const fs::path& folder) {
  const auto [rest, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return rest == folder.end() || (std::next(rest) == folder.end() && rest->empty());
}

}  // namespace

bool isBelowFolder(const std::string& path, const std::string& folder) {
  return isBelow(canonical(path), canonical(folder));
}

Includes::Includes(Context& context, const std::string& sceneFile)
    : context_(context), sceneFolder_(fs::path(sceneFile).parent_path().string()) {}

Includes::File Includes::add(const std::string& name, std::string text) {
  TextStore* const store = context_.options.store;
  const int file = context_.sources.add(name, std::move(text));
  const std::string& whole = context_.sources.text(file).text;
  const auto known = store ? store->find(name, whole) : nullptr;
  lists_.push_back(tokenise(file, context_.sources, context_.names, &context_.reporter,
                            context_.budget, known ? &known->tokens : nullptr));
  if (store && !known) store->keep(name, whole, lists_.back());
  return {file, &lists_.back()};
}

std::optional<Includes::File> Includes::load(const std::string& path, std::string& why) {
  if (const auto found = loaded_.find(path); found != loaded_.end()) return found->second;
  auto text = readText(context_.options, path, std::uintmax_t(context_.options.limits.memory), why);
  if (!text) return {};
  return loaded_[path] = add(path, std::move(*text));
}

std::string Includes::find(const std::string& name, int askingFile,
                           std::vector<std::string>& tried) const {
  const fs::path wanted(name);
  std::vector<fs::path> folders;
  if (wanted.is_absolute()) {
    folders.push_back("");
  } else {
    folders.push_back(fs::path(context_.sources.text(askingFile).name).parent_path());
    folders.push_back("");
    for (const std::string& p : context_.options.includePaths) folders.push_back(p);
  }
  for (const fs::path& folder : folders) {
    const std::string path = (folder / wanted).lexically_normal().string();
    if (isText(context_.options, path)) return path;
    if (std::find(tried.begin(), tried.end(), path) == tried.end()) tried.push_back(path);
  }
  return {};
}

std::string Includes::declaredIn(const std::string& name) const {
  constexpr std::uintmax_t kLargest = 1 << 20;  // a hint is not worth reading more
  for (const std::string& folder : context_.options.includePaths) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const fs::path& path = entry->path();
      if (path.extension() != ".inc" || !isText(context_.options, path.string())) continue;
      std::string ignored;
      const auto text = readText(context_.options, path.string(), kLargest, ignored);
      for (const char* directive : {"#declare ", "#macro "})
        if (text && (text->find(directive + name + " ") != std::string::npos ||
                     text->find(directive + name + "(") != std::string::npos))
          return path.filename().string();
    }
  }
  return {};
}

bool Includes::isAllowed(const std::string& path) const {
  if (!context_.options.sandbox) return true;
  const fs::path whole = canonical(path);
  if (isBelow(whole, canonical(sceneFolder_.empty() ? "." : sceneFolder_))) return true;
  for (const std::string& p : context_.options.includePaths)
    if (isBelow(whole, canonical(p))) return true;
  return false;
}

std::string Includes::outside(const std::string& path) {
  return "'" + path + "' lies outside the scene's folder and the include paths, which --sandbox " +
         "forbids";
}

void Includes::missing(const std::string& message, const Span& span,
                       const std::vector<std::string>& tried) {
  Diagnostic& d = context_.reporter.error(span, message);
  std::string places;
  for (const std::string& t : tried) places += (places.empty() ? "" : ", ") + t;
  d.notes.push_back({{}, "looked for " + places + "; -I adds a folder"});
}

}  // namespace vestige::lang
