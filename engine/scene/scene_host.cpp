// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/scene_host.h"

#include <fmt/format.h>

#include <filesystem>

#include <vestige/tools/regular_file.h>

namespace vestige {

namespace fs = std::filesystem;

std::string SceneHost::find(const std::string& file, Span span, std::string& error) {
  if (file.empty()) {
    error = "the file name is empty";
    return "";
  }
  const std::int32_t text = span.file >= 0 ? span.file : place_.file;
  std::vector<fs::path> tried = {fs::path(file)};
  if (!tried[0].is_absolute() && text >= 0 && text < int(description_.files.size()))
    tried.insert(tried.begin(),
                 fs::path(description_.files[std::size_t(text)]).parent_path() / file);
  std::error_code ignored;
  std::string places;
  for (const fs::path& path : tried) {
    const fs::path whole = fs::absolute(path, ignored).lexically_normal();
    if (files_) files_->insert(whole.string());
    if (record_) record_->files.emplace(whole.string(), stampOf(whole.string()));
    if (fs::exists(whole, ignored)) {
      const std::string why = whyNotRegular(whole.string());
      if (why.empty()) return whole.string();
      error = fmt::format("'{}' {}", whole.string(), why);
      return "";
    }
    if (places.find(whole.string()) == places.npos)
      places += (places.empty() ? "" : " and ") + whole.string();
  }
  error = fmt::format("cannot find '{}': looked for {}", file, places);
  return "";
}

std::shared_ptr<const Texture> SceneHost::texture(const TextureRequest& request,
                                                  std::string& error) {
  const std::string file = find(request.file, request.span, error);
  if (file.empty()) return nullptr;
  auto texture = textures_.texture(file, request, error, before_);
  if (const std::string why = textures_.takeWarning(); !why.empty()) warn(request.span, why);
  return texture;
}

void SceneHost::warn(Span span, const std::string& message) {
  if (record_) record_->said.push_back({span, message, false});
  diagnostics_.warning(span.file >= 0 ? span : place_, message);
}

void SceneHost::note(const std::string& message) {
  if (record_) record_->said.push_back({{}, message, true});
  if (noted_.insert(message).second) diagnostics_.note(place_, message);
}

}  // namespace vestige
