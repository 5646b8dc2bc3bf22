// SPDX-License-Identifier: Apache-2.0
// Offsets, lines and columns. Expected counts follow from the encodings [RFC 3629, RFC 2781].
#include "support/catch.h"

#include "lang/source.h"

namespace vestige::lang {
namespace {

Position at(const std::string& text, std::uint32_t offset) {
  Sources sources;
  return sources.position(sources.add("a", text), offset);
}

TEST_CASE("a position counts characters and UTF-16 code units", "[lang]") {
  const std::string text = "ab\n\u00e9\u20ac\U0001F600x";  // 2, 3 and 4 bytes of UTF-8
  CHECK(at(text, 2).line == 0);
  CHECK(at(text, 2).column == 2);
  CHECK(at(text, 3).line == 1);
  CHECK(at(text, 3).utf16Column == 0);
  CHECK(at(text, 5).column == 1);
  CHECK(at(text, 5).utf16Column == 1);
  CHECK(at(text, 8).utf16Column == 2);
  CHECK(at(text, 12).column == 3);
  CHECK(at(text, 12).utf16Column == 4);
  CHECK(at(text, 1000).column == 4);
  CHECK(at(text, 1000).utf16Column == 5);
  CHECK(at("", 0).line == 0);
}

TEST_CASE("bytes that are no UTF-8 are one character each", "[lang]") {
  CHECK(at("\x80\x80x", 2).column == 2);        // continuations of nothing
  CHECK(at("\xF0\x9F", 2).utf16Column == 2);    // a character cut off by the end
  CHECK(at("\xE2\x82 x", 3).utf16Column == 3);  // and by another
  CHECK(at("\xFF\xFE", 2).column == 2);
}

TEST_CASE("line and UTF-16 column lead back to the offset", "[lang]") {
  Sources sources;
  const std::string text = "ab\r\n\u00e9\U0001F600x\n\n\xF0\x9Fy";
  const int file = sources.add("a", text);
  for (const std::uint32_t offset : {0u, 1u, 2u, 4u, 6u, 10u, 11u, 12u, 13u, 14u, 15u, 16u}) {
    const Position p = sources.position(file, offset);
    INFO(offset);
    CHECK(sources.offset(file, p.line, p.utf16Column) == offset);
  }
  CHECK(sources.offset(file, 0, 99) == 2);  // before the line's end, "\r\n"
  CHECK(sources.offset(file, 1, 2) == 6);   // between the two code units of one character
  CHECK(sources.offset(file, 99, 99) == 16);
  CHECK(sources.offset(file, -1, -1) == 0);
}

}  // namespace
}  // namespace vestige::lang
