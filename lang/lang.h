// SPDX-License-Identifier: Apache-2.0
// The interface of the scene language: text in, scene description and diagnostics out.
#pragma once
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <vestige/schema.h>

#include "lang/edit.h"

namespace vestige::lang {

class Sources;    // lang/source.h: texts and expansions that spans refer to
class TextStore;  // lang/text_store.h
class Observer;   // lang/observer.h
class Measure;    // lang/measure.h

/// Limits on the cost of hostile texts: steps and bytes bound time and memory whatever the text
/// does (budget.h); the others find a mistake sooner. Each has its own message, which names the
/// option that raises it.
struct Limits {
  int includeDepth = 32;
  int macroDepth = 200;
  std::int64_t loopIterations = 10'000'000;  ///< in the whole run
  std::int64_t expandedTokens = 100'000'000;
  std::int64_t memory = 768 << 20;  ///< bytes of the text, its names, values and blocks
  std::size_t stringLength = 1 << 20;
  int errors = 20;                        ///< then parsing stops
  int nesting = 256;                      ///< depth of braces, parentheses and calls
  std::int64_t blocks = 2'000'000;        ///< copies included
  std::size_t arrayElements = 4'000'000;  ///< alive at one time
};

/// Source of the schemas of blocks. Each is requested when a text first names the block, so
/// expensive work such as opening a plugin library can be deferred. The schemas must outlive the
/// parsing.
class SchemaSource {
 public:
  virtual ~SchemaSource() = default;
  /// The schema of a block, or null. `name` is "" for a block that is no plugin.
  virtual const Schema* find(const std::string& kind, const std::string& name) const = 0;
  /// Whether such a block should exist. Must be fast: it is called for every word.
  virtual bool has(const std::string& kind, const std::string& name) const = 0;
  /// All kinds that have a schema.
  virtual std::vector<std::string> kinds() const = 0;
  /// Names of one kind, for messages.
  virtual std::vector<std::string> names(const std::string& kind) const = 0;
  /// The reason for the user why an existing block is not available, or "".
  virtual std::string whyMissing(const std::string& kind, const std::string& name) const = 0;
};

struct Options {
  std::vector<std::string> includePaths;  ///< -I, in order; the installed library last
  std::vector<std::pair<std::string, std::string>> definitions;  ///< -D name=expression
  bool sandbox = false;     ///< includes only from below the scene's folder and the include paths
  std::string writeFolder;  ///< --write-folder: #write makes files below it; "": nowhere
  bool writes = false;      ///< else what #write writes is only kept in memory for this run
  Limits limits;
  int imageWidth = 0, imageHeight = 0;  ///< of the picture in place of the film's; 0: not given
  std::function<void(const std::string&)> debug;  ///< receives #debug text; null: stderr
  /// Keeps tokens from one run to the next, and holds buffers that count in place of files. Null:
  /// every file is read and tokenised.
  TextStore* store = nullptr;
  Measure* measure = nullptr;    ///< answers trace(), inside(), ...; null: they are errors
  Observer* observer = nullptr;  ///< receives what the run finds; null: nothing does
};

struct Result {
  SceneDesc scene;
  Diagnostics diagnostics;
  Edits edits;  ///< that would mend some of the diagnostics
  std::shared_ptr<const Sources> sources;
};

/// Reads a scene file (or, second form, a text under a name) and checks it against the schemas. The
/// scene is usable only if diagnostics has no errors.
Result readScene(const std::string& file, const SchemaSource& schemas, const Options& options);
Result readSceneText(const std::string& name, const std::string& text, const SchemaSource& schemas,
                     const Options& options);

/// `file:line:column: error: ...`, the line, the caret, the notes, the chain of macros and
/// includes.
void print(std::ostream& out, const Diagnostic& diagnostic, const Sources& sources, bool colour);

/// The place of a span, for --json.
struct Place {
  std::string file;
  int line = 0, column = 0;                 ///< from 1, columns in characters; 0: no place
  int endLine = 0, endColumn = 0;           ///< one past the end
  int utf16Column = 0, endUtf16Column = 0;  ///< the columns in UTF-16 code units
};
Place locate(const Span& span, const Sources& sources);

}  // namespace vestige::lang
