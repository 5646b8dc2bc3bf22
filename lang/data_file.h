// SPDX-License-Identifier: Apache-2.0
// Files of data: what #fopen, #read, #write and #fclose work on.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "lang/include.h"

namespace vestige::lang {

/// A file that #fopen has opened and #fclose, or its end, has not closed.
struct DataFile {
  enum class Mode { read, write, append };
  Mode mode = Mode::read;
  std::string name;                   ///< as the scene wrote it
  const TokenList* tokens = nullptr;  ///< to read
  std::uint32_t at = 0;               ///< next token
  std::string text = {};              ///< written so far
  bool isOpen = true;                 ///< parameters of macros may still refer to it afterwards
  Share bytes = {};

  bool isWritten() const { return mode != Mode::read; }
};

/// Whether a value is a file that has been closed.
inline bool isClosed(const Datum& value) {
  const auto* file = std::get_if<DataFilePtr>(&value);
  return file && !(*file)->isOpen;
}

/// All files of one run. What is written is kept here, so that it can be read back; only if
/// Options::writes it also goes to files below Options::writeFolder.
class DataFiles {
 public:
  DataFiles(Context& context, Includes& includes) : context_(context), includes_(includes) {}

  /// Null if an error was reported at `span`. `asking`: the text with the #fopen.
  DataFilePtr open(const std::string& name, DataFile::Mode mode, int asking, const Span& span);
  void write(DataFile& file, const std::string& part, const Span& span);
  void close(DataFile& file, const Span& span);
  /// At the end of the run: of those that were not closed.
  void closeAll();
  /// Whether #fopen finds the file to read it.
  bool exists(const std::string& name) const;

 private:
  struct Written {
    std::string text;
    Share bytes;
  };
  bool mayWrite(const std::string& name, const Span& span);
  bool isBeingWritten(const std::string& key) const;
  bool openToWrite(DataFile& file, const Span& span);
  bool openToRead(DataFile& file, int asking, const Span& span);
  bool save(const std::string& key, const std::string& text, const Span& span);
  std::string below(const std::string& name) const;

  Context& context_;
  Includes& includes_;
  std::map<std::string, Written> written_;       ///< by key: the name made normal
  std::vector<DataFilePtr> open_;                ///< to write
  std::map<std::string, Includes::File> texts_;  ///< read before, by path
};

}  // namespace vestige::lang
