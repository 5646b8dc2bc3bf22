// SPDX-License-Identifier: Apache-2.0
// libFuzzer's way into the reader, from the lexer to the builder of blocks: any text is read to its
// end, within its limits, and its diagnostics can be printed. Run by `./test fuzz`.
#include <cstdint>

#include "tests/lang/schemas.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vestige::lang;
  Options options;
  options.sandbox = true;
  options.limits.expandedTokens = 100'000;
  options.limits.loopIterations = 2000;
  options.limits.memory = 256 << 20;
  options.limits.macroDepth = 50;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const Result result = test::read(text, options);
  test::printed(result);
  for (const vestige::Diagnostic& d : result.diagnostics.list())
    if (d.message.empty()) __builtin_trap();
  return 0;
}
