// SPDX-License-Identifier: Apache-2.0
// Which file an #include means, and its tokens.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lang/context.h"

namespace vestige::lang {

class Includes {
 public:
  Includes(Context& context, const std::string& sceneFile);

  struct File {
    int file = -1;  ///< in Sources
    const TokenList* tokens = nullptr;
  };
  /// A text under a name, tokenised.
  File add(const std::string& name, std::string text);
  /// The file's text and tokens, kept for the next time; nothing if it cannot be read.
  std::optional<File> load(const std::string& path);
  /// Where the name is found: beside the text that asks, in the working directory, then in the
  /// include paths. "" if nowhere; `tried` gets every path.
  std::string find(const std::string& name, int askingFile, std::vector<std::string>& tried) const;
  /// The file beside an include path that declares a name, or "": for a hint.
  std::string declaredIn(const std::string& name) const;
  /// With --sandbox: lies below the scene's folder or an include path?
  bool isAllowed(const std::string& path) const;

 private:
  Context& context_;
  std::string sceneFolder_;
  std::map<std::string, File> loaded_;  ///< by path
  std::deque<TokenList> lists_;
};

/// A whole file; nothing if it is no readable file or too large for spans (4 GB).
std::optional<std::string> readFile(const std::string& path);

}  // namespace vestige::lang
