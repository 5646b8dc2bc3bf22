// SPDX-License-Identifier: Apache-2.0
// Texts that outlive a run: the tokens of files that have not changed, and an editor's unsaved
// buffers.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lang/lexer.h"

namespace vestige::lang {

struct Options;

/// A text with its tokens, apart from any run. Immutable.
struct TokenisedText {
  std::string text = {};
  Total nameBytes = std::make_shared<std::atomic<std::int64_t>>(0);
  Names names{nameBytes};                ///< of the tokens
  std::vector<StoredToken> tokens = {};  ///< the last of kind `end`

  std::size_t bytes() const {
    return text.size() + tokens.size() * sizeof(StoredToken) + std::size_t(*nameBytes);
  }
};
/// For tools that need the tokens of one text and nothing else. Unpaired directives and `bad`
/// tokens stay in it without a diagnostic.
std::shared_ptr<const TokenisedText> tokenisedText(std::string text);

/// May be shared by runs on several threads. A run gives the same result with a store as without
/// one: files are read again each time, and tokens are used only if the text is equal.
class TextStore {
 public:
  /// From now on `text` counts in place of the file, which need not exist.
  void setBuffer(const std::string& path, std::string text);
  /// The file counts again.
  void dropBuffer(const std::string& path);
  /// Null: the file counts. Two paths of one file have the same buffer.
  std::shared_ptr<const std::string> buffer(const std::string& path) const;

  /// The tokens of the text that was last kept under this name; null if that is another one.
  std::shared_ptr<const TokenisedText> find(const std::string& name, const std::string& text) const;
  void keep(const std::string& name, const std::string& text, const TokenList& list);
  /// Number of texts that had to be tokenised so far.
  std::size_t tokenised() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const std::string>> buffers_;  ///< by canonical path
  std::map<std::string, std::shared_ptr<const TokenisedText>> texts_;  ///< by name
  std::size_t bytes_ = 0;                                              ///< of texts_
  std::size_t tokenised_ = 0;
};

/// The path without links and relative parts, whether or not the file exists.
std::string canonical(const std::string& path);
/// The buffer or the file; nothing, with the end of a sentence in `why`, if it is longer than
/// `most` bytes or cannot be read.
std::optional<std::string> readText(const Options& options, const std::string& path,
                                    std::uintmax_t most, std::string& why);
/// Whether readText() has something to read.
bool isText(const Options& options, const std::string& path);

}  // namespace vestige::lang
