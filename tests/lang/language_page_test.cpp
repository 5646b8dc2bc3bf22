// SPDX-License-Identifier: Apache-2.0
// What docs/language.md says about words, against the words that the language has.
#include "support/catch.h"

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "lang/vocabulary.h"

namespace vestige::lang {
namespace {

/// From a heading to the next one of its level.
std::string section(const std::string& heading) {
  std::stringstream stream;
  stream << std::ifstream(std::string(VESTIGE_SOURCE_DIR) + "/docs/language.md").rdbuf();
  const std::string page = stream.str();
  const std::size_t begin = page.find("\n" + heading + "\n");
  if (begin == std::string::npos) return "";
  const std::string level = heading.substr(0, heading.find(' ') + 1);
  return page.substr(begin, page.find("\n" + level, begin + 1) - begin);
}

/// The words between backticks in the first column of a section's table.
std::set<std::string> firstColumn(const std::string& text) {
  std::set<std::string> words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| `", 0) != 0) continue;
    const std::string cell = line.substr(1, line.find(" | ", 1));
    const std::regex word("#?[a-z_][a-z_0-9]*");
    for (std::sregex_iterator i(cell.begin(), cell.end(), word), end; i != end; ++i)
      words.insert(i->str());
  }
  return words;
}

}  // namespace

TEST_CASE("the page on the language has every word of POV-Ray's that a message replaces",
          "[lang]") {
  const std::set<std::string> words = firstColumn(section("## POV-Ray's words"));
  REQUIRE(words.count("texture") == 1);
  for (const std::string& word : replacedWords()) {
    INFO(word);
    CHECK(words.count(word) == 1);
  }
}

TEST_CASE("what the page on the language calls missing is missing", "[lang]") {
  std::istringstream lines(section("## POV-Ray's words"));
  int checked = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("| not yet |") == std::string::npos) continue;
    for (const std::string& word : firstColumn(line)) {
      INFO(word);
      const char* instead = insteadOf(word);
      REQUIRE(instead);
      CHECK(std::string(instead) == "Vestige does not have it yet");
      ++checked;
    }
  }
  CHECK(checked > 20);
}

}  // namespace vestige::lang
