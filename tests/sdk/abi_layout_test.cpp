// SPDX-License-Identifier: Apache-2.0
// The plain-C structs that cross a library's boundary, byte by byte. When one of these fails, every
// plugin built so far would be read wrongly: append instead, or raise kSdkMajor (docs/abi.md).
#include <vestige/abi.h>

#include <string>
#include <type_traits>

#include "support/catch.h"

namespace {

static_assert(sizeof(void*) != 8 || sizeof(VestigePlugin) == 96);
static_assert(alignof(VestigePlugin) == alignof(void*));
static_assert(std::is_standard_layout_v<VestigePlugin> && std::is_trivial_v<VestigePlugin>);
static_assert(sizeof(VestigeError) == 520 && offsetof(VestigeError, input) == 512);
static_assert(std::is_standard_layout_v<VestigeError> && std::is_trivial_v<VestigeError>);

// What must be readable of any library, however old: it decides whether the rest may be read.
static_assert(offsetof(VestigePlugin, magic) == 0);
static_assert(offsetof(VestigePlugin, size) == 8);
static_assert(offsetof(VestigePlugin, sdkMajor) == 12);
static_assert(offsetof(VestigePlugin, sdkMinor) == 16);
static_assert(offsetof(VestigePlugin, abiTag) == 24);

static_assert(offsetof(VestigePlugin, kind) == 32);
static_assert(offsetof(VestigePlugin, name) == 40);
static_assert(offsetof(VestigePlugin, version) == 48);
static_assert(offsetof(VestigePlugin, schema) == 56);
static_assert(offsetof(VestigePlugin, create) == 64);
static_assert(offsetof(VestigePlugin, destroy) == 72);
static_assert(offsetof(VestigePlugin, lacks) == 80);
static_assert(offsetof(VestigePlugin, batch) == 88);

}  // namespace

TEST_CASE("the magic number spells the engine's name", "[abi]") {
  const std::uint64_t magic = vestige::kPluginMagic;
  CHECK(std::string(reinterpret_cast<const char*>(&magic), 8) == "VESTIGE1");
}

TEST_CASE("the tag names all that must agree", "[abi]") {
  for (const char* part : {"real=", "pointer="}) CHECK_THAT(vestige::kAbiTag, containsText(part));
  CHECK_THAT(vestige::kAbiTag, containsText("libstdc++") || containsText("libc++"));
}
