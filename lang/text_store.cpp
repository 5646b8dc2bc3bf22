// SPDX-License-Identifier: Apache-2.0
#include "lang/text_store.h"

#include <filesystem>
#include <limits>

#include <vestige/tools/regular_file.h>

#include "lang/lang.h"

namespace vestige::lang {
namespace {

namespace fs = std::filesystem;

/// When the texts take more bytes, all are dropped and tokenised anew: far above what one scene
/// reads, so that only those of scenes read before remain.
constexpr std::size_t kMostBytes = 256 << 20;

}  // namespace

std::shared_ptr<const TokenisedText> tokenisedText(std::string text) {
  Limits limits;  // none: the caller has the text, and its tokens are a multiple of it
  limits.memory = limits.expandedTokens = std::numeric_limits<std::int64_t>::max();
  Diagnostics diagnostics;
  Edits edits;
  Reporter reporter(diagnostics, edits, limits.errors);
  Budget budget(limits, reporter);
  Sources sources;
  auto made = std::make_shared<TokenisedText>();
  const int file = sources.add("", text);
  made->tokens = tokenise(file, sources, made->names, nullptr, budget).tokens;
  made->text = std::move(text);
  return made;
}

void TextStore::setBuffer(const std::string& path, std::string text) {
  auto shared = std::make_shared<const std::string>(std::move(text));
  const std::lock_guard lock(mutex_);
  buffers_[canonical(path)] = std::move(shared);
}

void TextStore::dropBuffer(const std::string& path) {
  const std::lock_guard lock(mutex_);
  buffers_.erase(canonical(path));
}

std::shared_ptr<const std::string> TextStore::buffer(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  if (buffers_.empty()) return nullptr;
  const auto found = buffers_.find(canonical(path));
  return found == buffers_.end() ? nullptr : found->second;
}

std::shared_ptr<const TokenisedText> TextStore::find(const std::string& name,
                                                     const std::string& text) const {
  std::shared_ptr<const TokenisedText> known;
  {
    const std::lock_guard lock(mutex_);
    const auto found = texts_.find(name);
    if (found != texts_.end()) known = found->second;
  }
  return known && known->text == text ? known : nullptr;
}

void TextStore::keep(const std::string& name, const std::string& text, const TokenList& list) {
  auto made = std::make_shared<TokenisedText>();
  made->text = text;
  made->tokens = list.tokens;
  for (StoredToken& t : made->tokens)
    if (t.kind != Token::Kind::number) t.text = made->names.intern(*t.text);
  const std::lock_guard lock(mutex_);
  ++tokenised_;
  if (const auto old = texts_.find(name); old != texts_.end()) {
    bytes_ -= old->second->bytes();
    texts_.erase(old);
  }
  if (made->bytes() > kMostBytes) return;
  if (bytes_ + made->bytes() > kMostBytes) {
    texts_.clear();
    bytes_ = 0;
  }
  bytes_ += made->bytes();
  texts_[name] = std::move(made);
}

std::size_t TextStore::tokenised() const {
  const std::lock_guard lock(mutex_);
  return tokenised_;
}

std::string canonical(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
  return (error ? fs::path(path) : whole).string();
}

std::optional<std::string> readText(const Options& options, const std::string& path,
                                    std::uintmax_t most, std::string& why) {
  const auto buffer = options.store ? options.store->buffer(path) : nullptr;
  if (!buffer) return readRegular(path, most, why);
  if (buffer->size() <= most) return *buffer;
  why = "is larger than " + std::to_string(most >> 20) + " MB";
  return std::nullopt;
}

bool isText(const Options& options, const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) || (options.store && options.store->buffer(path));
}

}  // namespace vestige::lang
